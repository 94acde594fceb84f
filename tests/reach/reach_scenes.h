// Scenes whose answer is known, drawn from seeds: what a search must find, and what it must never claim.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "shapes.h"
#include "slipface/level/level_scene.h"
#include "slipface/reach/report.h"

namespace slipface::test {

constexpr double tick_s = 1.0 / 60.0;

struct ReachScene {
    Level level;
    Vec3 start = Vec3::Zero();
    Vec3 target = Vec3::Zero();  // a point of the face that is asked for
};

// The face that looks up and lies nearest to `point`.
inline FaceId face_at(const Level& level, const Vec3& point) {
    FaceId nearest = no_id;
    double least = 1e9;
    for (FaceId face = 0; face < level.mesh->face_count(); ++face) {
        if (face_normal(*level.mesh, face).y() < 0.9) continue;
        const double apart = (face_centroid(*level.mesh, face) - point).norm();
        if (apart < least) least = apart, nearest = face;
    }
    return nearest;
}

inline MovementSettings random_settings(std::mt19937_64& random) {
    const auto in = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    MovementSettings settings;
    settings.walk_speed = in(3.0, 9.0);
    settings.gravity = in(12.0, 30.0);
    settings.jump_speed = in(5.0, 9.0);
    settings.ground_acceleration = in(30.0, 90.0);
    settings.air_acceleration = in(8.0, 40.0);
    settings.coyote = in(0.0, 1.0) < 0.7;
    settings.coyote_time = in(0.03, 0.15);
    settings.step_up = in(0.0, 1.0) < 0.7;
    settings.radii = Vec3(in(0.3, 0.5), in(0.6, 1.0), 0.0);
    settings.radii.z() = settings.radii.x();
    return settings;
}

// A box with its upper face at `high.y`, turned by `yaw` about the origin.
inline void turned_box(Shapes& shapes, const Vec3& low, const Vec3& high, double yaw) {
    const double c = std::cos(yaw), s = std::sin(yaw);
    const auto at = [&](double x, double y, double z) { return Vec3(c * x + s * z, y, c * z - s * x); };
    const Vec3 &a = low, &b = high;
    shapes.polygon(
        {at(a.x(), b.y(), a.z()), at(a.x(), b.y(), b.z()), at(b.x(), b.y(), b.z()), at(b.x(), b.y(), a.z())});
    shapes.polygon(
        {at(a.x(), a.y(), b.z()), at(b.x(), a.y(), b.z()), at(b.x(), b.y(), b.z()), at(a.x(), b.y(), b.z())});
    shapes.polygon(
        {at(b.x(), a.y(), a.z()), at(a.x(), a.y(), a.z()), at(a.x(), b.y(), a.z()), at(b.x(), b.y(), a.z())});
    shapes.polygon(
        {at(b.x(), a.y(), b.z()), at(b.x(), a.y(), a.z()), at(b.x(), b.y(), a.z()), at(b.x(), b.y(), b.z())});
    shapes.polygon(
        {at(a.x(), a.y(), a.z()), at(a.x(), a.y(), b.z()), at(a.x(), b.y(), b.z()), at(a.x(), b.y(), a.z())});
}

inline Vec3 turned(const Vec3& point, double yaw) {
    const double c = std::cos(yaw), s = std::sin(yaw);
    return {c * point.x() + s * point.z(), point.y(), c * point.z() - s * point.x()};
}

// Two ledges along -Z, `width` metres apart, the far one `rise` higher; below is nothing.
inline ReachScene gap_scene(const MovementSettings& settings, double width, double rise, double yaw) {
    Shapes shapes;
    turned_box(shapes, {-2, -1, 0}, {2, 0, 7}, yaw);
    turned_box(shapes, {-2, -1 + std::min(0.0, rise), -width - 4}, {2, rise, -width}, yaw);
    ReachScene scene{shapes.level(), turned({0, settings.radii.y() + settings.skin, 6}, yaw),
                     turned({0, rise, -width - 2}, yaw)};
    scene.level.movement = settings;
    scene.level.spawn = scene.start;
    return scene;
}

// Whether any straight run with one jump crosses, from many starts: every tick of take-off before the edge
// or the wall, and all of coyote time.
inline bool any_straight_jump(const ReachScene& scene, int starts) {
    LevelScene built = LevelScene::build(scene.level).value();
    const MovementScene now = built.at(0.0);
    const MovementSettings& settings = scene.level.movement;
    const FaceId target = face_at(scene.level, scene.target);
    const double stride = settings.walk_speed * tick_s;
    const double lowest = scene.level.mesh->bounds.min.y() - 2.0;
    for (int s = 0; s < starts; ++s) {
        std::vector<PlayerState> trail;
        int in_air = 0;
        PlayerState state = built.player_at(scene.start + Vec3(0, 0, -stride * s / starts));
        for (int i = 0; i < 30; ++i)
            state = step(now, settings, state, {}, tick_s).state;
        for (int i = 0; i < 400; ++i) {
            trail.push_back(state);
            state = step(now, settings, state, {Vec2(0, -1), {}}, tick_s).state;
            in_air = state.grounded ? 0 : in_air + 1;
            if (in_air > 20 || state.position.y() < lowest) break;  // coyote time is over
        }
        for (const PlayerState& from : trail) {
            state = from;
            for (int i = 0; i < 240; ++i) {
                state = step(now, settings, state, {Vec2(0, -1), Button::jump}, tick_s).state;
                if (state.grounded && state.ground_face == target) return true;
                if (state.position.y() < lowest || (i > 2 && state.grounded)) break;
            }
        }
    }
    return false;
}

// The largest size at which a straight run with one jump comes to the target of `make(size)`.
template <class Make>
double largest_possible(const Make& make, double high, int starts) {
    double good = 0.0, bad = high;
    for (int i = 0; i < 12; ++i) {
        const double middle = 0.5 * (good + bad);
        (any_straight_jump(make(middle), starts) ? good : bad) = middle;
    }
    return good;
}

// The widest gap, or the highest ledge 0.5 m away, that a straight jump masters.
inline double max_possible(const MovementSettings& settings, bool ledge, int starts) {
    if (ledge)
        return largest_possible([&](double size) { return gap_scene(settings, 0.5, size, 0.0); }, 8.0,
                                starts);
    return largest_possible([&](double size) { return gap_scene(settings, size, 0.0, 0.0); }, 20.0, starts);
}

inline ReachSearch search_of(const ReachScene& scene, std::uint64_t rounds, std::uint64_t seed = 1) {
    ReachOptions options;
    options.seed = seed;
    Result<ReachSearch> search = ReachSearch::begin(scene.level, scene.start, options);
    ReachLimits limits;
    limits.rounds = rounds;
    search->run(limits);
    return std::move(*search);
}

// Rounds one after another until the face is reached; how many, or nothing.
inline std::optional<std::uint64_t> rounds_until(ReachSearch& search, FaceId face, std::uint64_t maximum) {
    ReachLimits limits;
    for (std::uint64_t round = search.rounds().size(); round <= maximum && !search.exhausted(); ++round) {
        if (search.faces()[face].found()) return round;
        limits.rounds = round + 1;
        search.run(limits);
    }
    if (search.faces()[face].found()) return search.rounds().size();
    return std::nullopt;
}

// The tape of every face that the search claims, run anew: empty if each ends standing on its face.
inline std::string false_claims(const ReachSearch& search) {
    LevelScene built = LevelScene::build(search.level()).value();
    const TickScene ticks(built);
    for (FaceId face = 0; face < search.faces().size(); ++face) {
        if (!search.faces()[face].found()) continue;
        const std::optional<Tape> tape = search.tape_to(search.faces()[face].node);
        if (!tape) return "face " + std::to_string(face) + ": the tape does not repeat";
        // Through its text, as a file would go.
        const Result<Tape> read = parse_tape(tape_to_text(*tape), "tape");
        if (!read) return read.error().text();
        MovementSettings settings;
        if (!apply_tape_settings(settings, *read, "tape")) return "the tape's settings";
        const SimulationReport report = simulate(ticks, settings, *read->start, *read);
        const PlayerState& end = report.final_state;
        if (!(end.grounded || end.climbing || end.stuck) || end.ground_face != face)
            return "face " + std::to_string(face) + ": the tape ends on face " +
                   std::to_string(end.ground_face);
        if (read->end_hash && *read->end_hash != report.end_hash) return "another hash";
    }
    return {};
}

}  // namespace slipface::test
