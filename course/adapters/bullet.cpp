// Bullet's btKinematicCharacterController behind the stepping protocol (docs/course.md), set up as its
// CharacterDemo does: a ghost object with a capsule in a discrete dynamics world, the controller added as an
// action; gravity, step height, slope limit and jump speed as given. Its mesh is a btBvhTriangleMeshShape
// whose inner edges are smoothed as Bullet's manual recommends. Nothing carries the player.
//     c++ -O2 bullet.cpp $(pkg-config --cflags --libs bullet) -o bullet
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

using Json = nlohmann::json;

struct Refused {
    std::string place, found, expected;
};

double number(const Json& value, const std::string& place, double low = -1e6, double high = 1e6) {
    if (!value.is_number() || !(value.get<double>() >= low && value.get<double>() <= high))
        throw Refused{place, value.is_structured() ? "a list" : value.dump(),
                      "a number from " + std::to_string(low) + " to " + std::to_string(high)};
    return value.get<double>();
}
const Json& member(const Json& object, const char* key, const std::string& place = "") {
    if (!object.is_object() || !object.contains(key))
        throw Refused{place.empty() ? "/" : place, "nothing", std::string("a member ") + key};
    return object[key];
}
template <std::size_t N>
std::array<double, N> numbers(const Json& value, const std::string& place) {
    if (!value.is_array() || value.size() != N)
        throw Refused{place, "something else", std::to_string(N) + " numbers"};
    std::array<double, N> made{};
    for (std::size_t i = 0; i < N; ++i)
        made[i] = number(value[i], place + "/" + std::to_string(i));
    return made;
}
btVector3 vector(const Json& value, const std::string& place) {
    const auto n = numbers<3>(value, place);
    return {btScalar(n[0]), btScalar(n[1]), btScalar(n[2])};
}
btTransform pose(const Json& value, const std::string& place) {
    btTransform made = btTransform::getIdentity();
    made.setOrigin(vector(member(value, "position", place), place + "/position"));
    if (value.contains("rotation")) {
        const auto q = numbers<4>(value["rotation"], place + "/rotation");
        made.setRotation(
            btQuaternion(btScalar(q[0]), btScalar(q[1]), btScalar(q[2]), btScalar(q[3])).normalized());
    }
    return made;
}

struct Part {
    std::vector<btVector3> positions;
    std::vector<int> indices;
    std::unique_ptr<btTriangleIndexVertexArray> array;
    std::unique_ptr<btBvhTriangleMeshShape> shape;
    std::unique_ptr<btTriangleInfoMap> edges;
    std::unique_ptr<btRigidBody> body;
    bool moves = false;
};

bool smooth_edges(btManifoldPoint& point, const btCollisionObjectWrapper* a, int part_a, int index_a,
                  const btCollisionObjectWrapper* b, int part_b, int index_b) {
    (void)part_a, (void)index_a;
    btAdjustInternalEdgeContacts(point, b, a, part_b, index_b);
    return true;
}

struct Run {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btGhostPairCallback ghosts;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    std::vector<Part> parts;
    std::unique_ptr<btCapsuleShape> capsule;
    btPairCachingGhostObject ghost;
    std::unique_ptr<btKinematicCharacterController> controller;
    double half = 0.9, walk_speed = 6.0, jump_speed = 8.0;
    bool held = false;

    explicit Run(const Json& request) {
        const Json& body = member(request, "body");
        const double radius = number(member(body, "radius", "/body"), "/body/radius", 0.01, 100),
                     height = number(member(body, "height", "/body"), "/body/height", 0.02, 1000);
        const Json settings = request.value("settings", Json::object());
        const auto setting = [&](const char* key, double usual) {
            return settings.contains(key) ? number(settings[key], std::string("/settings/") + key, 0, 1e4)
                                          : usual;
        };
        half = height / 2;
        walk_speed = setting("walk_speed", 6);
        jump_speed = setting("jump_speed", 8);
        const btScalar gravity = btScalar(setting("gravity", 20));
        world.setGravity({0, -gravity, 0});
        broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&ghosts);
        const Json& meshes = member(request, "meshes");
        parts.resize(meshes.size());
        for (std::size_t i = 0; i < meshes.size(); ++i)
            add(parts[i], meshes[i], "/meshes/" + std::to_string(i));
        btTransform start = btTransform::getIdentity();
        start.setOrigin(vector(member(request, "feet"), "/feet") + btVector3(0, btScalar(half), 0));
        ghost.setWorldTransform(start);
        capsule = std::make_unique<btCapsuleShape>(btScalar(radius), btScalar(height - 2 * radius));
        ghost.setCollisionShape(capsule.get());
        ghost.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
        controller = std::make_unique<btKinematicCharacterController>(
            &ghost, capsule.get(), btScalar(setting("step_height", 0.4)), btVector3(0, 1, 0));
        controller->setGravity({0, -gravity, 0});
        controller->setMaxSlope(btScalar(setting("max_slope_deg", 50) * std::numbers::pi / 180));
        controller->setJumpSpeed(btScalar(jump_speed));
        controller->setFallSpeed(55);
        controller->warp(start.getOrigin());  // setting the up axis has turned the capsule
        world.addCollisionObject(&ghost, btBroadphaseProxy::CharacterFilter,
                                 btBroadphaseProxy::StaticFilter | btBroadphaseProxy::DefaultFilter |
                                     btBroadphaseProxy::KinematicFilter);
        world.addAction(controller.get());
    }
    ~Run() {
        world.removeAction(controller.get());
        world.removeCollisionObject(&ghost);
        for (Part& part : parts)
            if (part.body) world.removeRigidBody(part.body.get());
    }

    void add(Part& part, const Json& mesh, const std::string& place) {
        for (const Json& position : member(mesh, "positions", place))
            part.positions.push_back(vector(position, place + "/positions"));
        for (const Json& triangle : member(mesh, "triangles", place))
            for (const double index : numbers<3>(triangle, place + "/triangles")) {
                if (!(index >= 0 && index < double(part.positions.size())))
                    throw Refused{place + "/triangles", std::to_string(index), "an index of a position"};
                part.indices.push_back(int(index));
            }
        part.moves = mesh.value("moves", false);
        if (part.indices.empty()) return;
        part.array = std::make_unique<btTriangleIndexVertexArray>(
            int(part.indices.size() / 3), part.indices.data(), int(3 * sizeof(int)),
            int(part.positions.size()), &part.positions[0][0], int(sizeof(btVector3)));
        part.shape = std::make_unique<btBvhTriangleMeshShape>(part.array.get(), true);
        part.edges = std::make_unique<btTriangleInfoMap>();
        btGenerateInternalEdgeInfo(part.shape.get(), part.edges.get());
        part.body = std::make_unique<btRigidBody>(
            btRigidBody::btRigidBodyConstructionInfo(0, nullptr, part.shape.get()));
        part.body->setCollisionFlags(
            part.body->getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK |
            (part.moves ? btCollisionObject::CF_KINEMATIC_OBJECT : btCollisionObject::CF_STATIC_OBJECT));
        if (part.moves && mesh.contains("position")) part.body->setWorldTransform(pose(mesh, place));
        if (part.moves) part.body->setActivationState(DISABLE_DEACTIVATION);
        world.addRigidBody(part.body.get());
    }

    Json step(const Json& request) {
        const double dt = number(member(request, "dt"), "/dt", 1e-4, 60);
        const auto wish =
            request.contains("wish") ? numbers<2>(request["wish"], "/wish") : std::array<double, 2>{};
        const double length = std::max(1.0, std::hypot(wish[0], wish[1]));
        std::vector<std::pair<std::size_t, btTransform>> moves;
        for (const Json& one : request.value("poses", Json::array())) {
            const double index =
                number(member(one, "mesh", "/poses"), "/poses/mesh", 0, double(parts.size()) - 1);
            if (!parts[std::size_t(index)].moves)
                throw Refused{"/poses/mesh", std::to_string(index), "the number of a mesh that moves"};
            moves.emplace_back(std::size_t(index), pose(one, "/poses"));
        }
        bool jump = false;
        for (const Json& button : request.value("buttons", Json::array()))
            jump = jump || button == "jump";
        for (const auto& [index, transform] : moves)
            if (parts[index].body) parts[index].body->setWorldTransform(transform);
        controller->setWalkDirection(
            {btScalar(wish[0] / length * walk_speed * dt), 0, btScalar(wish[1] / length * walk_speed * dt)});
        if (jump && !held && controller->onGround()) controller->jump(btVector3(0, btScalar(jump_speed), 0));
        held = jump;
        const btVector3 before = ghost.getWorldTransform().getOrigin();
        world.stepSimulation(btScalar(dt), 0);
        const btVector3 now = ghost.getWorldTransform().getOrigin(), v = (now - before) / btScalar(dt);
        return {{"feet", {now.x(), now.y() - half, now.z()}},
                {"velocity", {v.x(), v.y(), v.z()}},
                {"grounded", controller->onGround()}};
    }
};

int main() {
    gContactAddedCallback = smooth_edges;
    std::map<std::string, std::unique_ptr<Run>> runs;
    std::string line;
    for (int lines = 1; std::getline(std::cin, line); ++lines) {
        Json request, answer;
        try {
            request = Json::parse(line);
            const std::string verb = member(request, "do").get<std::string>();
            answer["ok"] = verb;
            if (verb == "hello") {
                answer.update({{"protocol", 1},
                               {"engine", "bullet"},
                               {"version", std::to_string(btGetVersion())},
                               {"body", "capsule"},
                               {"features", {"slope_limit", "steps", "moving", "jump"}}});
            } else {
                const std::string name = member(request, "run").get<std::string>();
                answer["run"] = name;
                const auto run = runs.find(name);
                if (verb == "load") {
                    runs.insert_or_assign(name, std::make_unique<Run>(request));
                } else if (run == runs.end()) {
                    throw Refused{"/run", name, "the name of a loaded run"};
                } else if (verb == "step") {
                    answer.update(run->second->step(request));
                } else if (verb == "free") {
                    runs.erase(run);
                } else {
                    throw Refused{"/do", verb, "hello, load, step or free"};
                }
            }
        } catch (const Refused& refused) {
            answer = {{"line", lines},
                      {"error",
                       {{"place", refused.place}, {"found", refused.found}, {"expected", refused.expected}}}};
        } catch (const std::exception& error) {
            answer = {{"line", lines},
                      {"error", {{"place", "/"}, {"found", error.what()}, {"expected", "a request"}}}};
        }
        std::cout << answer.dump() << std::endl;
    }
}
