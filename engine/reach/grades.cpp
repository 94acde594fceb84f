#include "slipface/reach/grades.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rim.h"
#include "slipface/base/parallel.h"
#include "slipface/collision/collision_world.h"

namespace slipface {
namespace {

constexpr double tenth = 1.1, nearly = 0.95;
constexpr double grade_dt = 1.0 / 60.0;
constexpr int run_up_ticks = 240, flight_ticks = 300, branch_ticks = 60;

// A floor that ends at x = 0, and beyond a gap another one, so much higher.
struct TrialScene {
    TrialScene(double gap, double rise) {
        const auto g = static_cast<float>(gap), r = static_cast<float>(rise);
        const std::vector<Vec3f> corners{{-90, 0, -9}, {-90, 0, 9}, {0, 0, 9},      {0, 0, -9},
                                         {g, r, -9},   {g, r, 9},   {g + 50, r, 9}, {g + 50, r, -9},
                                         {g, -9, -9},  {g, -9, 9}};
        const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}, {4, 5, 6},
                                                                  {4, 6, 7}, {8, 9, 5}, {8, 5, 4}};
        const std::vector<FaceId> faces{0, 0, 1, 1, 2, 2};
        if (Result<CollisionWorld> built = CollisionWorld::build({corners, triangles, faces, {}}))
            world = std::move(*built);
    }
    std::vector<SurfaceType> surfaces{SurfaceType{}};
    CollisionWorld world;
};

// When a flight presses a button again: before it leaves the ground, at its top, which leads highest, back at
// the height where it began, which leads farthest, or falling along a wall.
enum class When { never, before, at_top, at_height, at_wall };

struct Plan {
    When jump = When::never, dash = When::never;
    bool everywhere = false;  // tried long before the edge, too
};

// Those that the settings allow.
std::vector<Plan> plans_of(const MovementSettings& settings) {
    std::vector<When> jumps{When::never}, dashes;
    if (settings.air_jump) jumps.insert(jumps.end(), {When::at_top, When::at_height});
    std::vector<Plan> plans;
    for (const When jump : jumps)
        plans.push_back({.jump = jump, .everywhere = true});
    if (settings.wall_jump) {
        jumps.push_back(When::at_wall);
        plans.push_back({.jump = When::at_wall});
    }
    if (settings.dash) dashes = {When::before, When::at_top, When::at_height};
    for (const When jump : jumps)
        for (const When dash : dashes)
            plans.push_back({.jump = jump, .dash = dash});
    return plans;
}

bool is_due(When when, const PlayerState& state, double dt, double height) {
    const double falls = -state.velocity.y();
    if (when == When::never || when == When::before || is_held(state) || !(falls >= 0.0)) return false;
    if (when == When::at_wall) return state.ground_face != no_id;
    return when == When::at_top || state.position.y() - 2.0 * dt * falls <= height;
}

// The buttons in the tick of that number of a flight that began at that height. To press one again it is let
// go for a tick.
ButtonSet presses(const MovementSettings& settings, const PlayerState& state, double dt, const Plan& plan,
                  int tick, double height) {
    const bool dashes_first = plan.dash == When::before && (tick + 1) * dt < settings.dash_time;
    const bool again = (plan.jump == When::at_wall || state.air_jumps < settings.air_jumps) &&
                       is_due(plan.jump, state, dt, height);
    ButtonSet held{Button::jump, !dashes_first && !(again && state.jump_held)};
    held.set(Button::dash, (plan.dash == When::before && tick == 0) ||
                               (!state.dash_held && is_due(plan.dash, state, dt, height)));
    return held;
}

// Whether a straight run, with a jump in one of its last ticks before the edge or wall or after it, ends on
// the floor beyond; without `jumps`, whether the run alone does.
bool masters(const MovementSettings& settings, double dt, double gap, double rise, bool jumps) {
    const TrialScene trial(gap, rise);
    const MovementScene scene{trial.world, trial.surfaces};
    const auto beyond = [](const PlayerState& state) { return state.grounded && state.ground_face == 1; };
    PlayerState state;
    // Full speed at the edge.
    const double run_up = std::min(60.0, 0.5 * settings.walk_speed * run_up_ticks * dt);
    state.position = Vec3(-run_up, settings.radii.y() + 2.0 * settings.skin, 0.0);
    std::vector<PlayerState> trail;
    int past = 0;
    for (int i = 0; i < 2 * run_up_ticks && past < branch_ticks; ++i) {
        trail.push_back(state);
        const double before = state.position.x();
        state = step(scene, settings, state, {Vec2(1, 0), {}}, dt).state;
        if (!state.grounded || state.position.x() - before < 0.1 * settings.walk_speed * dt) ++past;
        if (beyond(state)) return true;
        if (state.position.y() < -3.0) break;
    }
    if (!jumps) return false;
    const std::size_t edge = trail.size() - static_cast<std::size_t>(past);
    for (const Plan& plan : plans_of(settings)) {
        const std::size_t before = plan.everywhere ? 2 * branch_ticks - static_cast<std::size_t>(past) : 20;
        const std::size_t last = plan.everywhere ? trail.size() : std::min(trail.size(), edge + 10);
        for (std::size_t from = edge - std::min(edge, before); from < last; ++from) {
            state = trail[from];
            for (int i = 0; i < flight_ticks && state.position.y() > -3.0; ++i) {
                const ButtonSet held = presses(settings, state, dt, plan, i, trail[from].position.y());
                state = step(scene, settings, state, {Vec2(1, 0), held}, dt).state;
                if (beyond(state)) return true;
                if (i > 2 && state.grounded && state.move_s == 0.0) break;
            }
        }
    }
    return false;
}

// How a region is come to, from below or across.
struct Approach {
    double size_m = 0.0, ratio = 1e9;  // to the limit
    bool ledge = true;
    FaceId face = no_id;
    Vec3 position = Vec3::Zero();
};

}  // namespace

JumpLimits measure_limits(const MovementSettings& settings, double dt) {
    // Steps, ledges, gaps: where each is mastered and where it is not, halved.
    std::array<double, 3> most{};
    parallel_for(most.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t kind = begin; kind < end; ++kind) {
            double bad = kind == 2 ? 40.0 : 8.0;
            for (int i = 0; i < 12; ++i) {
                const double middle = 0.5 * (most[kind] + bad);
                const bool good =
                    masters(settings, dt, kind == 2 ? middle : 0.0, kind == 2 ? 0.0 : middle, kind != 0);
                (good ? most[kind] : bad) = middle;
            }
        }
    });
    return {most[0], most[1], most[2]};
}

Grades grade(const Level& level) {
    const Mesh& mesh = *level.mesh;
    const WalkRegions regions = walk_regions(level);
    const double radius = std::min(level.movement.radii.x(), level.movement.radii.z());
    Grades grades;
    grades.limits = measure_limits(level.movement, grade_dt);
    const Result<CollisionWorld> world = build_collision_world(level);
    if (!world) return grades;
    std::vector<Approach> best(regions.regions.size());
    std::vector<bool> dropped(best.size());
    const auto offer = [&](std::uint32_t region, const Approach& one) {
        if (one.ratio < best[region].ratio) best[region] = one;
    };
    const Vec3 down(0.0, -1.0, 0.0);
    const double highest = tenth * grades.limits.ledge_m, widest = tenth * grades.limits.gap_m;
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        const std::uint32_t region = regions.of_face[face];
        if (region == no_id) continue;
        for_each_rim(mesh, face, [&](const Vec3& from, const Vec3& along, const Vec3& out) {
            if (along.norm() < radius) return;
            const Vec3 rim = from + 0.5 * along;
            const auto below = [&](double away) -> std::optional<std::pair<std::uint32_t, double>> {
                const Vec3 at = rim + away * out + Vec3(0.0, grades.limits.step_m + 0.01, 0.0);
                const auto hit = cast_ray(*world, at, down);
                if (!hit || regions.of_face[hit->face] == no_id) return std::nullopt;
                return std::pair(regions.of_face[hit->face], rim.y() - hit->point.y());
            };
            // A rim above other ground: a drop for those up here, a ledge for those down there.
            const auto ground = below(radius);
            if (ground && ground->first == region) return;
            if (ground && ground->second > grades.limits.step_m) {
                dropped[ground->first] = true;
                if (ground->second <= highest)
                    offer(region, {ground->second, ground->second / grades.limits.ledge_m, true, face, rim});
            }
            // Across a gap: the first ground as high, with nothing between.
            const Vec3 eye = rim + Vec3(0.0, level.movement.radii.y(), 0.0);
            for (double away = 1.5 * radius; away <= widest; away += 0.5 * radius) {
                const auto there = below(away);
                if (!there || std::abs(there->second) > grades.limits.step_m) continue;
                if (there->first == region || cast_ray(*world, eye, out, away)) break;
                double near = away - 0.5 * radius, far = away;
                for (int k = 0; k < 8; ++k) {
                    const double middle = 0.5 * (near + far);
                    const auto ahead = below(middle);
                    (ahead && ahead->first == there->first ? far : near) = middle;
                }
                offer(there->first, {far, far / grades.limits.gap_m, false, face, rim});
                break;
            }
        });
    }
    for (std::size_t region = 0; region < best.size(); ++region) {
        const Approach& one = best[region];
        // What no foot has room on is no place to get to.
        if (regions.regions[region].area_m2 < radius * radius) continue;
        if (dropped[region]) {
            ++grades.dropped;
            continue;
        }
        if (one.face == no_id) continue;
        const bool reached = one.ratio <= 1.0;
        ++(reached ? grades.jumped : grades.missed);
        if (one.ratio < nearly) continue;
        const double limit = one.ledge ? grades.limits.ledge_m : grades.limits.gap_m;
        const std::string text =
            reached ? fmt::format("{:.2f} m {} is {:.2f} m below the limit of {:.2f} m", one.size_m,
                                  one.ledge ? "high" : "wide", limit - one.size_m, limit)
                    : fmt::format("{:.2f} m too {} for the jump of {:.2f} m", one.size_m - limit,
                                  one.ledge ? "high" : "wide", limit);
        grades.notes.push_back({one.face, one.position, reached, text});
    }
    return grades;
}

}  // namespace slipface
