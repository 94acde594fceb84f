// slipface_many [SECTION...]: many characters and many platforms in one frame (docs/performance.md).
// Sections: queues, piles, markets, city, rollback, single, platforms, growth; all if none is named.
// Processor time of one thread, medians; what is compared is taken in turns.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string_view>

#include "bench_scenes.h"
#include "slipface/base/parallel.h"
#include "slipface/movement/crowd.h"
#include "timing.h"

namespace slipface::bench {
namespace {

constexpr double dt = 1.0 / 60.0;

using Crowd = std::vector<CrowdMember>;

double between(scenes::Random& random, double low, double high) {
    return random.uniform(low, high);
}

// A square of level ground in tiles of `tile` metres.
scenes::Soup ground(double edge, double tile) {
    scenes::Soup soup;
    const int count = static_cast<int>(edge / tile);
    for (int z = 0; z < count; ++z)
        for (int x = 0; x < count; ++x) {
            const Vec3 at(tile * x, 0, tile * z);
            soup.add_quad(at, at + Vec3(0, 0, tile), at + Vec3(tile, 0, tile), at + Vec3(tile, 0, 0));
        }
    return soup;
}

// Ground in tiles of a metre and a house in every square of eight: 1.4 million triangles.
scenes::Soup city() {
    constexpr double edge = 824.0;
    scenes::Soup soup = ground(edge, 1.0);
    for (double z = 0; z + 8 <= edge; z += 8)
        for (double x = 0; x + 8 <= edge; x += 8) {
            const Vec3 a(x + 4, 0, z + 4), b = a + Vec3(3, 5, 3);
            const auto at = [&](bool far_x, bool far_y, bool far_z) {
                return Vec3((far_x ? b : a).x(), (far_y ? b : a).y(), (far_z ? b : a).z());
            };
            soup.add_quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
            soup.add_quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
            soup.add_quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
            soup.add_quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
            soup.add_quad(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
        }
    return soup;
}

CrowdMember member(const MovementSettings& settings, const Vec3& foot, const Vec2& wish = Vec2::Zero()) {
    CrowdMember made{.settings = &settings, .state = {}, .input = {.wish = wish}};
    made.state.position = foot + Vec3(0, settings.radii.y() + settings.skin, 0);
    return made;
}

Vec2 heading(scenes::Random& random) {
    const double angle = between(random, 0, 6.283185307179586);
    return {std::cos(angle), std::sin(angle)};
}

struct Frames {
    double median_ms = 0.0, worst_ms = 0.0;
};

Frames frames_of(int count, const std::function<void()>& frame) {
    std::vector<double> times;
    for (int i = 0; i < count; ++i) {
        const double begin = seconds();
        frame();
        times.push_back(1e3 * (seconds() - begin));
    }
    return {median(times), *std::max_element(times.begin(), times.end())};
}

MovementScene scene_of(const CollisionWorld& world) {
    static const std::vector<SurfaceType> types{SurfaceType{}};
    return {.collision = world, .surfaces = types};
}

// ---- crowds

Crowd queue(const MovementSettings& settings, int count, bool along_x, double pace) {
    Crowd crowd;
    for (int i = 0; i < count; ++i) {
        const double way = 50.0 + 0.82 * i;
        crowd.push_back(member(settings, along_x ? Vec3(way, 0, 50) : Vec3(50, 0, way),
                               pace * (along_x ? Vec2(1, 0) : Vec2(0, 1))));
    }
    return crowd;
}

// Walkers that meet: two square metres for each.
Crowd market(const MovementSettings& settings, std::size_t count) {
    scenes::Random random(3);
    const double edge = std::sqrt(2.0 * static_cast<double>(count));
    Crowd crowd;
    for (std::size_t i = 0; i < count; ++i)
        crowd.push_back(member(settings, {50 + between(random, 0, edge), 0, 50 + between(random, 0, edge)},
                               heading(random)));
    return crowd;
}

const CollisionWorld& plaza() {
    static const CollisionWorld world = ground(2600, 4).world();
    return world;
}

void queues() {
    const ThreadLimit one_thread(1);
    const MovementSettings settings;
    const MovementScene scene = scene_of(plaza());
    for (const double pace : {0.0, 1.0})
        for (const bool along_x : {true, false}) {
            Crowd crowd = queue(settings, 3000, along_x, pace);
            std::vector<Rest> rests(crowd.size());
            for (std::size_t i = 0; i < crowd.size(); ++i)
                crowd[i].rest = &rests[i];
            const Frames frames = frames_of(60, [&] { step_crowd(scene, crowd, dt); });
            fmt::print("queue of 3000 along {}, {}: {:.2f} ms a frame, worst {:.2f}\n", along_x ? "X" : "Z",
                       pace > 0.0 ? "walking" : "idle", frames.median_ms, frames.worst_ms);
        }
}

void piles() {
    const ThreadLimit one_thread(1);
    const MovementSettings settings;
    const MovementScene scene = scene_of(plaza());
    for (const double spread : {0.0, 0.5, 2.0}) {
        scenes::Random random(5);
        Crowd crowd;
        for (int i = 0; i < 1000; ++i)
            crowd.push_back(member(settings, {500 + between(random, -spread, spread), 0,
                                              500 + between(random, -spread, spread)}));
        int frame = 0, apart = -1;
        double closest = 0.0;
        const Frames frames = frames_of(240, [&] {
            step_crowd(scene, crowd, dt);
            ++frame;
            if (apart >= 0 || frame % 10 != 0) return;
            double least = 1e9;  // squared
            for (std::size_t i = 0; i < crowd.size(); ++i)
                for (std::size_t k = 0; k < i; ++k)
                    least = std::min(least, (crowd[i].state.position - crowd[k].state.position)
                                                .cwiseQuotient(2.0 * settings.radii)
                                                .squaredNorm());
            closest = std::sqrt(least);
            if (closest > 0.98) apart = frame;
        });
        Aabb box;
        for (const CrowdMember& each : crowd)
            box.add(each.state.position);
        fmt::print(
            "pile of 1000 within {} m: worst frame {:.2f} ms, median {:.2f}; the closest at {:.3f} of their "
            "distance after {} frames, then {:.0f} x {:.0f} x {:.0f} m\n",
            spread, frames.worst_ms, frames.median_ms, closest, apart < 0 ? frame : apart, box.size().x(),
            box.size().y(), box.size().z());
    }
}

void markets() {
    const MovementSettings settings;
    const MovementScene scene = scene_of(plaza());
    double one = 0.0;
    for (const int threads : {1, 2, 4, 8}) {
        const ThreadLimit limit(threads);
        Crowd crowd = market(settings, 5000);
        std::vector<double> times, own;
        for (int i = 0; i < 60; ++i) {
            const double begin = wall_seconds(), mine = seconds();
            step_crowd(scene, crowd, dt);
            times.push_back(1e3 * (wall_seconds() - begin));
            own.push_back(1e3 * (seconds() - mine));
        }
        const double time = median(times);
        if (threads == 1) one = time;
        fmt::print(
            "market of 5000, {} threads: {:.2f} ms a frame, {:.2f} times as fast; {:.2f} ms of the caller's "
            "time\n",
            threads, time, one / time, median(own));
        std::fflush(stdout);
    }
}

// ---- characters in a city

void characters_in_city() {
    const ThreadLimit one_thread(1);
    const MovementSettings settings;
    const CollisionWorld world = city().world();
    const MovementScene scene = scene_of(world);
    fmt::print("city of {} triangles, 10,000 characters\n", world.triangle_count());
    for (const double idle : {0.0, 0.7}) {
        scenes::Random random(7);
        Crowd crowd;
        while (crowd.size() < 10000) {
            CrowdMember next = member(settings, {between(random, 2, 820), 0, between(random, 2, 820)});
            if (overlaps_any(world, settings.radii, next.state.position)) continue;
            if (between(random, 0, 1) >= idle) next.input.wish = heading(random);
            crowd.push_back(next);
        }
        std::vector<Rest> rests(crowd.size());
        Crowd alone = crowd, many = crowd;
        for (std::size_t i = 0; i < crowd.size(); ++i)
            crowd[i].rest = &rests[i];
        for (int i = 0; i < 30; ++i) {
            step_crowd(scene, crowd, dt);
            step_many(scene, alone, dt);
        }
        many = alone;
        std::vector<Rest> more(crowd.size());
        for (std::size_t i = 0; i < crowd.size(); ++i)
            many[i].rest = &more[i];
        std::vector<double> together, each, resting;
        for (int i = 0; i < 60; ++i) {
            double begin = seconds();
            step_crowd(scene, crowd, dt);
            together.push_back(1e3 * (seconds() - begin));
            begin = seconds();
            for (CrowdMember& one : alone)
                one.state = step(scene, settings, one.state, one.input, dt).state;
            each.push_back(1e3 * (seconds() - begin));
            begin = seconds();
            step_many(scene, many, dt);
            resting.push_back(1e3 * (seconds() - begin));
        }
        fmt::print(
            "  {:.0f} % idle: step_crowd {:.2f} ms a frame, step_many {:.2f}; step for each, without Rest, "
            "{:.2f}\n",
            100 * idle, median(together), median(resting), median(each));
    }
}

// ---- 16 players, 8 ticks again

void rollback() {
    const ThreadLimit one_thread(1);
    const MovementSettings settings;
    const Level& level = bench::level(121000);
    const MovementScene scene = scene_of(level.world);
    std::vector<PlayerState> starts;
    std::vector<PlayerInput> inputs;
    scenes::Random random(9);
    for (const Query& query : queries(level, settings.radii, 1.0)) {
        if (starts.size() == 16) break;
        PlayerState state;
        state.position = query.from;
        const Vec2 wish = heading(random);
        for (int i = 0; i < 60; ++i)
            state = step(scene, settings, state, {.wish = wish}, dt).state;
        if (!state.grounded) continue;
        starts.push_back(state);
        inputs.push_back({.wish = heading(random)});
    }
    const Frames frames = frames_of(200, [&] {
        for (std::size_t i = 0; i < starts.size(); ++i) {
            PlayerState state = starts[i];
            for (int tick = 0; tick < 8; ++tick)
                state = step(scene, settings, state, inputs[i], dt).state;
        }
    });
    fmt::print("rollback of {} players by 8 ticks: {:.1f} us\n", starts.size(), 1e3 * frames.median_ms);
}

// ---- a single character: air, level ground of large tiles, idle

void single() {
    const ThreadLimit one_thread(1);
    const MovementSettings settings;
    const CollisionWorld world = ground(2000, 20).world();
    const MovementScene scene = scene_of(world);
    struct Case {
        const char* name;
        double height;
        Vec2 wish;
    };
    for (const Case& of :
         {Case{"free fall", 5000.0, {0, 0}}, Case{"free fall, stick held", 5000.0, {1, 0}},
          Case{"level ground, walking", 0.0, {0.6, 0.8}}, Case{"level ground, idle", 0.0, {0, 0}}}) {
        std::vector<double> times;
        for (int round = 0; round < 20; ++round) {
            PlayerState state = member(settings, {1000, of.height, 1000}).state;
            state = step(scene, settings, state, {.wish = of.wish}, dt).state;
            constexpr int steps = 500;
            const double begin = seconds();
            for (int i = 0; i < steps; ++i)
                state = step(scene, settings, state, {.wish = of.wish}, dt).state;
            times.push_back(1e9 * (seconds() - begin) / steps);
        }
        fmt::print("{}: {:.0f} ns a step\n", of.name, median(times));
    }
}

// ---- platforms

// Far from the origin, each on its way.
struct Fleet {
    CollisionWorld rest;
    std::vector<MovingPart> parts;
    std::vector<Aabb> rooms;
    PlatformTree tree;

    explicit Fleet(std::size_t count) {
        scenes::Soup box = ground(4, 4);
        if (auto made = CollisionWorld::build_movable(box.view())) rest = std::move(*made);
        for (std::size_t i = 0; i < count; ++i) {
            MovingPart part;
            part.rest = &rest;
            part.begin.offset =
                Vec3(2000 + 10.0 * static_cast<double>(i % 50), 5, 2000 + 10.0 * static_cast<double>(i / 50));
            part.end = part.begin;
            part.end.offset.x() += 0.1;
            part.velocity = Vec3(6, 0, 0);
            parts.push_back(part);
            rooms.push_back(room_of(part));
        }
        tree.build(rooms);
        tree.refit(rooms);
    }
    double move_ms() {
        const double begin = seconds();
        for (std::size_t i = 0; i < parts.size(); ++i)
            rooms[i] = room_of(parts[i]);
        tree.refit(rooms);
        return 1e3 * (seconds() - begin);
    }
};

double walk_s(const MovementScene& scene, int ticks) {
    const MovementSettings settings;
    PlayerState state = member(settings, {100, 0, 100}).state;
    const double begin = seconds();
    for (int i = 0; i < ticks; ++i) {
        const Vec2 wish = i % 120 < 60 ? Vec2(0.6, 0.8) : Vec2(-0.6, -0.8);
        state = step(scene, settings, state, {.wish = wish}, dt).state;
    }
    return seconds() - begin;
}

void platforms() {
    const ThreadLimit one_thread(1);
    const CollisionWorld world = ground(200, 4).world();
    Fleet fleet(2000);
    MovementScene without = scene_of(world), with = without, listed = without;
    with.platforms = listed.platforms = fleet.parts;
    with.tree = &fleet.tree;
    std::vector<double> ratios, unlisted, moves;
    for (int round = 0; round < 41; ++round) {
        const double plain = walk_s(without, 600);
        ratios.push_back(walk_s(with, 600) / plain);
        if (round < 5) unlisted.push_back(walk_s(listed, 600) / plain);
        moves.push_back(fleet.move_ms());
    }
    fmt::print(
        "2000 platforms far away: a step takes {:.3f} times as long, {:.1f} times without a tree; moving "
        "them {:.3f} "
        "ms a tick\n",
        median(ratios), median(unlisted), median(moves));
}

// ---- growth, over two decades

void print_growth(const char* what, const std::array<double, 3>& ms) {
    fmt::print("{}: {:.4f} / {:.4f} / {:.4f} ms, exponents {:.2f} and {:.2f}\n", what, ms[0], ms[1], ms[2],
               std::log10(ms[1] / ms[0]), std::log10(ms[2] / ms[1]));
}

void growth() {
    const ThreadLimit one_thread(1);
    const MovementSettings settings;
    const CollisionWorld world = ground(1000, 4).world();
    const MovementScene scene = scene_of(world);
    std::array<double, 3> crowds{}, waiting{}, ticks{}, fleets{};
    std::size_t count = 100;
    for (std::size_t i = 0; i < 3; ++i, count *= 10) {
        // Groups of a hundred, so that as many meet in each.
        Crowd crowd;
        for (std::size_t group = 0; group < count / 100; ++group)
            for (CrowdMember each : market(settings, 100)) {
                each.state.position +=
                    Vec3(60.0 * static_cast<double>(group % 10), 0, 60.0 * static_cast<double>(group / 10));
                crowd.push_back(each);
            }
        crowds[i] = frames_of(count > 1000 ? 30 : 100, [&] { step_crowd(scene, crowd, dt); }).median_ms;
        std::vector<Rest> rests(count);
        for (std::size_t k = 0; k < count; ++k) {
            crowd[k].input = {};
            crowd[k].rest = &rests[k];
        }
        for (int frame = 0; frame < 60; ++frame)
            step_crowd(scene, crowd, dt);
        waiting[i] = frames_of(30, [&] { step_crowd(scene, crowd, dt); }).median_ms;
        std::vector<double> walks, moves;
        Fleet fleet(count / 5);
        for (int round = 0; round < 9; ++round) {
            walks.push_back(1e3 * walk_s(scene, static_cast<int>(count)));
            moves.push_back(fleet.move_ms());
        }
        ticks[i] = median(walks);
        fleets[i] = median(moves);
    }
    print_growth("characters that meet, 100 / 1000 / 10,000", crowds);
    print_growth("the same at rest", waiting);
    print_growth("ticks of one character, 100 / 1000 / 10,000", ticks);
    print_growth("platforms, 20 / 200 / 2000", fleets);
}

int run(int count, char** names) {
    const std::vector<std::string_view> wanted(names, names + count);
    const auto section = [&](std::string_view name, void (*of)()) {
        if (wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end()) of();
        std::fflush(stdout);
    };
    section("queues", queues);
    section("piles", piles);
    section("markets", markets);
    section("city", characters_in_city);
    section("rollback", rollback);
    section("single", single);
    section("platforms", platforms);
    section("growth", growth);
    return 0;
}

}  // namespace
}  // namespace slipface::bench

int main(int count, char** arguments) {
    return slipface::bench::run(count - 1, arguments + 1);
}
