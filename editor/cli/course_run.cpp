#include "cli/course_run.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "slipface/level/preset.h"

namespace slipface::cli {
namespace {

constexpr std::size_t no_body = static_cast<std::size_t>(-1);
constexpr std::size_t max_triangles = 2'000'000;  // of a run
constexpr double shortest_dt = 1e-4, longest_dt = 60.0;

struct Soup {
    std::vector<Vec3f> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    void add(const Placed& mesh) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        const Placed points = mesh.member("positions"), faces = mesh.member("triangles");
        const std::size_t count = points.need_array(3 * max_triangles);
        for (std::size_t i = 0; i < count; ++i)
            positions.push_back(points.item(i).vector().cast<float>());
        const std::size_t face_count = faces.need_array(max_triangles - triangles.size());
        for (std::size_t i = 0; i < face_count; ++i) {
            const Placed face = faces.item(i);
            if (face.need_array(3) != 3 || count == 0) face.refuse("three indices of positions");
            std::array<std::uint32_t, 3>& corners = triangles.emplace_back();
            for (std::size_t k = 0; k < 3; ++k)
                corners[k] = first + static_cast<std::uint32_t>(face.item(k).whole(0, count - 1));
        }
    }
    CollisionWorld world(bool moves, const std::string& place) const {
        std::vector<FaceId> faces(triangles.size());
        std::iota(faces.begin(), faces.end(), FaceId{0});
        const TriangleSoup soup{positions, triangles, faces};
        Result<CollisionWorld> built =
            moves ? CollisionWorld::build_movable(soup) : CollisionWorld::build(soup);
        if (!built) throw Refused{place, built.error().message, "triangles"};
        return std::move(*built);
    }
};

Pose read_pose(const Placed& from) {
    Pose pose;
    pose.offset = from.member("position").vector();
    from.if_member("rotation", [&](const Placed& rotation) {
        if (rotation.need_array(4) != 4) rotation.refuse("a quaternion x, y, z, w");
        std::array<double, 4> q{};
        double square = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            q[i] = rotation.item(i).number(-1e3, 1e3);
            square += q[i] * q[i];
        }
        if (!(square > 1e-6)) rotation.refuse("a quaternion x, y, z, w");
        const double s = 2.0 / square;
        const auto [x, y, z, w] = q;
        pose.columns[0] = {1.0 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)};
        pose.columns[1] = {s * (x * y - w * z), 1.0 - s * (x * x + z * z), s * (y * z + w * x)};
        pose.columns[2] = {s * (x * z + w * y), s * (y * z - w * x), 1.0 - s * (x * x + y * y)};
    });
    return pose;
}

// The turn from one pose to another: its axis times its angle, below half a turn.
Vec3 turn_of(const Pose& begin, const Pose& end) {
    Vec3 sine = Vec3::Zero();
    double trace = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        sine += 0.5 * begin.columns[k].cross(end.columns[k]);
        trace += begin.columns[k].dot(end.columns[k]);
    }
    const double length = sine.norm();
    return length > 1e-12 ? Vec3(sine * (std::atan2(length, 0.5 * (trace - 1.0)) / length)) : Vec3::Zero();
}

void read_settings(const Placed& from, MovementSettings& settings) {
    from.need_object_of(
        {"gravity", "walk_speed", "jump_speed", "step_height", "snap_distance", "max_slope_deg", "own"});
    const auto set = [](const Placed& value, const std::string& assignment, MovementSettings& changed) {
        if (const Status status = set_setting(changed, assignment); !status.ok())
            value.refuse(status.error().message);
    };
    for (const char* name : {"gravity", "walk_speed", "jump_speed", "step_height", "snap_distance"})
        from.if_member(name, [&](const Placed& value) {
            set(value, fmt::format("{}={}", name, value.number(0.0, 1e4)), settings);
        });
    from.if_member("max_slope_deg", [&](const Placed& value) {
        set(value, fmt::format("max_slope={}deg", value.number(0.0, 90.0)), settings);
    });
    if (settings.step_height == 0.0) settings.step_up = false;
    if (settings.snap_distance == 0.0) settings.snap_down = false;
    from.if_member("own", [&](const Placed& own) {
        if (!own.value.is_object()) own.refuse("an object of settings of docs/settings.md");
        for (const auto& entry : own.value.items()) {
            const Placed value{entry.value(), own.place + "/" + entry.key()};
            if (value.value.is_structured()) value.refuse("a number, true, false or a string");
            const std::string text = value.value.is_string() ? value.text() : value.value.dump();
            set(value, entry.key() + "=" + text, settings);
        }
    });
}

}  // namespace

CourseRun::CourseRun(const Placed& load) : settings_(find_preset("platformer")->settings) {
    const Placed body = load.member("body");
    body.need_object_of({"radius", "height"});
    const double radius = body.member("radius").number(0.01, 100.0);
    const double height = body.member("height").number(2.0 * radius, 1000.0);
    settings_.radii = {radius, 0.5 * height, radius};
    load.if_member("settings", [&](const Placed& settings) { read_settings(settings, settings_); });
    state_.position = load.member("feet").vector() + Vec3(0.0, settings_.radii.y(), 0.0);

    const Placed meshes = load.member("meshes");
    const std::size_t count = meshes.need_array(10'000);
    Soup still;
    for (std::size_t i = 0; i < count; ++i) {
        const Placed mesh = meshes.item(i);
        mesh.need_object_of({"positions", "triangles", "moves", "position", "rotation"});
        bool moves = false;
        mesh.if_member("moves", [&](const Placed& value) { moves = value.truth(); });
        body_of_mesh_.push_back(moves ? parts_.size() : no_body);
        if (!moves) {
            still.add(mesh);
            continue;
        }
        Soup soup;
        soup.add(mesh);
        triangles_ += soup.triangles.size();
        bodies_.push_back(std::make_unique<CollisionWorld>(soup.world(true, mesh.place)));
        apply_surface_rules(*bodies_.back(), types_);
        MovingPart& part = parts_.emplace_back();
        part.rest = bodies_.back().get();
        if (mesh.value.contains("position")) part.begin = part.end = read_pose(mesh);
        part.pivot = part.end.offset;
    }
    triangles_ += still.triangles.size();
    if (triangles_ > max_triangles)
        throw Refused{meshes.place, fmt::format("{} triangles", triangles_),
                      fmt::format("at most {}", max_triangles)};
    still_ = still.world(false, meshes.place);
    apply_surface_rules(still_, types_);
    std::vector<Aabb> rooms;
    for (const MovingPart& part : parts_)
        rooms.push_back(room_of(part));
    tree_.build(rooms);
    tree_.refit(rooms);
}

CourseRun::Answer CourseRun::step(const Placed& request) {
    const double dt = request.member("dt").number(shortest_dt, longest_dt);
    PlayerInput input;
    request.if_member("wish", [&](const Placed& wish) {
        if (wish.need_array(2) != 2) wish.refuse("two numbers");
        input.wish = {wish.item(0).number(-1e3, 1e3), wish.item(1).number(-1e3, 1e3)};
    });
    request.if_member("buttons", [&](const Placed& buttons) {
        const std::size_t count = buttons.need_array(32);
        for (std::size_t i = 0; i < count; ++i) {
            const ButtonInfo* const button = find_button(buttons.item(i).text());
            if (button == nullptr) buttons.item(i).refuse("the name of a button");
            input.buttons.set(button->button);
        }
    });
    std::vector<Pose> ends;  // [moving body]
    for (const MovingPart& part : parts_)
        ends.push_back(part.end);
    request.if_member("poses", [&](const Placed& poses) {
        const std::size_t count = poses.need_array(10'000);
        for (std::size_t i = 0; i < count; ++i) {
            const Placed pose = poses.item(i);
            pose.need_object_of({"mesh", "position", "rotation"});
            const Placed mesh = pose.member("mesh");
            const std::size_t index =
                body_of_mesh_.empty() ? no_body : body_of_mesh_[mesh.whole(0, body_of_mesh_.size() - 1)];
            if (index == no_body) mesh.refuse("the number of a mesh that moves");
            ends[index] = read_pose(pose);
        }
    });

    for (std::size_t i = 0; i < parts_.size(); ++i) {
        MovingPart& part = parts_[i];
        part.begin = part.end;
        part.end = ends[i];
        part.pivot = part.end.offset;
        part.velocity = (part.end.offset - part.begin.offset) / dt;
        part.angular_velocity = turn_of(part.begin, part.end) / dt;
        tree_.move(static_cast<std::uint32_t>(i), room_of(part));
    }
    const MovementScene scene{.collision = still_, .surfaces = types_, .platforms = parts_, .tree = &tree_};
    state_ = slipface::step(scene, settings_, state_, input, dt).state;
    return {.feet = state_.position - Vec3(0.0, settings_.radii.y(), 0.0),
            .velocity = velocity_in_level(scene, settings_, state_),
            .grounded = state_.grounded};
}

}  // namespace slipface::cli
