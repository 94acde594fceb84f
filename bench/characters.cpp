// slipface_characters LEVEL.obj...: measures one full step of a walking character against Bullet's
// btKinematicCharacterController on the same level with the same inputs, in alternation, so that disturbances
// affect both; with and without a trace; and many characters on threads. Each figure is the median of
// processor time over the rounds, and each ratio the median of the ratios of the rounds.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#ifdef SLIPFACE_BULLET
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>
#include <btBulletCollisionCommon.h>
#endif

#include "slipface/base/parallel.h"
#include "slipface/level/level_file.h"
#include "slipface/level/level_scene.h"
#include "timing.h"

namespace slipface::bench {
namespace {

constexpr double dt = 1.0 / 60.0;
constexpr std::size_t ticks = 600;
constexpr int rounds = 5;

using Wishes = std::vector<std::vector<Vec2>>;  // [walker][tick]

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Headings that change twice per second; the same for every engine.
Wishes wishes_of(std::size_t walkers) {
    Wishes wishes;
    for (std::uint64_t walker = 0; walker < walkers; ++walker) {
        std::vector<Vec2>& list = wishes.emplace_back();
        for (std::uint64_t tick = 0; tick < ticks; ++tick) {
            std::uint64_t state = (walker + 1) * 0x9e3779b97f4a7c15ULL + tick / 30 * 0xbf58476d1ce4e5b9ULL;
            state ^= state >> 31;
            state *= 0x94d049bb133111ebULL;
            const double angle =
                static_cast<double>(state >> 40) / static_cast<double>(1 << 24) * 6.283185307179586;
            list.emplace_back(std::cos(angle), std::sin(angle));
        }
    }
    return wishes;
}

MovementSettings every_hack() {
    MovementSettings s = basic_settings();
    s.push_out = PushOut::analytic;
    set_switches(s, true);
    return s;
}

// Positions where a walker can stand, found by dropping one at random points.
std::vector<Vec3> spawns(LevelScene& scene, const MovementSettings& s, std::size_t count) {
    const MovementScene world = scene.at(0.0, dt);
    const Aabb box = world.collision.bounds();
    std::vector<Vec3> found;
    for (std::uint64_t i = 0; found.size() < count && i < 100000; ++i) {
        const auto fraction = [&](std::uint64_t salt) {
            std::uint64_t x = (i * 3 + salt) * 0x9e3779b97f4a7c15ULL;
            x ^= x >> 29;
            x *= 0xbf58476d1ce4e5b9ULL;
            return static_cast<double>(x >> 11) * 0x1.0p-53;
        };
        const Vec3 from = box.min + Vec3(fraction(0), fraction(1), fraction(2)).cwiseProduct(box.size());
        if (overlaps_any(world.collision, s.radii, from)) continue;
        const auto ground = sweep_ellipsoid(world.collision, s.radii, from, Vec3(0, -3, 0));
        if (!ground || ground->normal.y() < 0.9) continue;
        found.push_back(from + Vec3(0, -3 * ground->t + s.skin, 0));
    }
    return found;
}

struct Timing {
    double step_us = 0.0;
    double falls = 0.0;   // per walker: it fell out of the level and restarted
    double sweeps = 0.0;  // per step
};

// `sink` may be null.
Timing time_steps(const MovementScene& scene, const MovementSettings& s, const std::vector<Vec3>& starts,
                  const Wishes& wishes, TraceRecorder* sink) {
    const double floor = scene.collision.bounds().min.y() - 5.0;
    std::size_t falls = 0;
    double sweeps = 0.0;
    const double begin = seconds();
    for (std::size_t w = 0; w < starts.size(); ++w) {
        PlayerState state;
        state.position = starts[w];
        for (const Vec2& wish : wishes[w]) {
            if (sink) sink->records.clear();
            const StepResult result = step(scene, s, state, {.wish = wish}, dt, sink);
            state = result.state;
            sweeps += result.sweeps;
            if (state.position.y() < floor) {
                ++falls;
                state = {};
                state.position = starts[w];
            }
        }
    }
    const auto walkers = static_cast<double>(starts.size());
    const double count = walkers * ticks;
    return {(seconds() - begin) / count * 1e6, static_cast<double>(falls) / walkers, sweeps / count};
}

#ifdef SLIPFACE_BULLET
Timing time_bullet(const Mesh& mesh, const MovementSettings& s, const std::vector<Vec3>& starts,
                   const Wishes& wishes, bool capsule) {
    std::vector<int> indices;
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle)
            indices.push_back(static_cast<int>(mesh.corner_vertex[corner]));
    }
    std::vector<Vec3f> positions = mesh.positions;
    btTriangleIndexVertexArray array(static_cast<int>(mesh.triangle_count()), indices.data(), 3 * sizeof(int),
                                     static_cast<int>(positions.size()), positions[0].data(), sizeof(Vec3f));
    btBvhTriangleMeshShape shape(&array, true);
    btCollisionObject level;
    level.setCollisionShape(&shape);
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btGhostPairCallback callback;
    broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&callback);
    btCollisionWorld world(&dispatcher, &broadphase, &configuration);
    world.addCollisionObject(&level, btBroadphaseProxy::StaticFilter,
                             btBroadphaseProxy::CharacterFilter | btBroadphaseProxy::DefaultFilter);
    std::unique_ptr<btConvexShape> body;
    const auto r = static_cast<btScalar>(s.radii.x());
    if (capsule) {
        body = std::make_unique<btCapsuleShape>(r, static_cast<btScalar>(2 * (s.radii.y() - s.radii.x())));
    } else {
        body = std::make_unique<btSphereShape>(r);
    }
    btPairCachingGhostObject ghost;
    ghost.setCollisionShape(body.get());
    ghost.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
    world.addCollisionObject(&ghost, btBroadphaseProxy::CharacterFilter,
                             btBroadphaseProxy::StaticFilter | btBroadphaseProxy::DefaultFilter);
    const double floor = mesh.bounds.min.y() - 5.0;
    std::size_t falls = 0;
    double time = 0.0;
    for (std::size_t w = 0; w < starts.size(); ++w) {
        btKinematicCharacterController controller(&ghost, body.get(), static_cast<btScalar>(s.step_height),
                                                  btVector3(0, 1, 0));
        controller.setGravity(btVector3(0, static_cast<btScalar>(-s.gravity), 0));
        controller.setMaxSlope(static_cast<btScalar>(s.max_slope));
        const Vec3 p = starts[w];
        const btVector3 start(static_cast<btScalar>(p.x()), static_cast<btScalar>(p.y()),
                              static_cast<btScalar>(p.z()));
        controller.warp(start);
        const double begin = seconds();
        for (const Vec2& wish : wishes[w]) {
            const Vec2 motion = wish * s.walk_speed * dt;
            controller.setWalkDirection(
                btVector3(static_cast<btScalar>(motion.x()), 0, static_cast<btScalar>(motion.y())));
            controller.preStep(&world);
            controller.playerStep(&world, static_cast<btScalar>(dt));
            if (static_cast<double>(ghost.getWorldTransform().getOrigin().y()) < floor) {
                ++falls;
                controller.reset(&world);
                controller.warp(start);
            }
        }
        time += seconds() - begin;
    }
    world.removeCollisionObject(&ghost);
    world.removeCollisionObject(&level);
    const double count = static_cast<double>(starts.size()) * ticks;
    return {time / count * 1e6, static_cast<double>(falls) / static_cast<double>(starts.size()), 0.0};
}
#endif

void time_threads(const MovementScene& scene, const MovementSettings& s, const std::vector<Vec3>& starts,
                  const Wishes& wishes) {
    double one = 0.0;
    for (const int threads : {1, 2, 4, 8}) {
        const ThreadLimit limit(threads);
        std::vector<PlayerState> states(starts.size());
        const double begin = seconds_now();
        parallel_for(starts.size(), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t w = first; w < last; ++w) {
                PlayerState state;
                state.position = starts[w];
                for (const Vec2& wish : wishes[w])
                    state = step(scene, s, state, {.wish = wish}, dt).state;
                states[w] = state;
            }
        });
        const double rate = static_cast<double>(starts.size()) * ticks / (seconds_now() - begin);
        if (threads == 1) one = rate;
        fmt::print("  {} thread{}: {:.2f} million steps a second, {:.2f} times one\n", threads,
                   threads == 1 ? "" : "s", rate * 1e-6, rate / one);
    }
}

int run(const char* path) {
    const Result<LoadedLevel> loaded = load_level(path);
    if (!loaded) {
        fmt::print("{}\n", loaded.error().text());
        return 1;
    }
    MovementSettings all = every_hack();
    Result<LevelScene> built = LevelScene::build(loaded->level, all);
    if (!built) return 1;
    const MovementScene scene = built->at(0.0, dt);
    fmt::print("{}: {} triangles\n", std::filesystem::path(path).filename().string(),
               loaded->level.mesh.triangle_count());
    for (const bool sphere : {true, false}) {
        MovementSettings plain = loaded->level.movement;
        all.radii = plain.radii = sphere ? Vec3(0.5, 0.5, 0.5) : Vec3(0.4, 0.9, 0.4);
        const std::vector<Vec3> starts = spawns(*built, all, 60);
        const Wishes wishes = wishes_of(starts.size());
        fmt::print("  {}, {} walkers, {} ticks\n", sphere ? "sphere 0.5" : "ellipsoid 0.4 0.9 0.4",
                   starts.size(), ticks);
        TraceRecorder recorder;
        MovementSettings fine = all, fine_plain = plain;
        fine.sub_step = fine_plain.sub_step = 1.0 / 720.0;
        Timing full, bullet;
        std::vector<double> fulls, traces, fews, bullets, trace_costs, ratios, fine_costs, fine_few_costs;
        for (int round = 0; round <= rounds; ++round) {
            full = time_steps(scene, all, starts, wishes, nullptr);
            const Timing traced = time_steps(scene, all, starts, wishes, &recorder);
            const Timing few = time_steps(scene, plain, starts, wishes, nullptr);
            const Timing parts = time_steps(scene, fine, starts, wishes, nullptr);
            const Timing few_parts = time_steps(scene, fine_plain, starts, wishes, nullptr);
#ifdef SLIPFACE_BULLET
            const std::size_t some = std::min<std::size_t>(starts.size(), 20);
            bullet =
                time_bullet(*loaded->level.mesh, all, {starts.data(), starts.data() + some}, wishes, !sphere);
#endif
            if (round == 0) continue;  // warms the caches
            fulls.push_back(full.step_us);
            traces.push_back(traced.step_us);
            fews.push_back(few.step_us);
            bullets.push_back(bullet.step_us);
            fine_costs.push_back(parts.step_us / full.step_us);
            fine_few_costs.push_back(few_parts.step_us / few.step_us);
            trace_costs.push_back(traced.step_us / full.step_us);
            ratios.push_back(bullet.step_us / full.step_us);
        }
        fmt::print(
            "    every hack {:.2f} us a step ({:.2f} M/s) of {:.2f} sweeps, with a trace {:.2f} "
            "({:.2f} times), the level's settings {:.2f}; {:.1f} falls a walker\n",
            median(fulls), 1.0 / median(fulls), full.sweeps, median(traces), median(trace_costs),
            median(fews), full.falls);
        fmt::print(
            "    sub_step=1/720: {:.2f} times every hack's step, {:.2f} times that of the level's settings\n",
            median(fine_costs), median(fine_few_costs));
#ifdef SLIPFACE_BULLET
        fmt::print("    Bullet, {} {:.2f} us a step, {:.1f} falls a walker: {:.1f} times\n",
                   sphere ? "sphere" : "capsule", median(bullets), bullet.falls, median(ratios));
#endif
        if (!sphere) time_threads(scene, all, starts, wishes);
        std::fflush(stdout);
    }
    return 0;
}

}  // namespace
}  // namespace slipface::bench

int main(int count, char** arguments) {
    int failed = 0;
    for (int i = 1; i < count; ++i)
        failed |= slipface::bench::run(arguments[i]);
    return failed;
}
