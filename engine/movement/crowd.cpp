#include "slipface/movement/crowd.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <tuple>
#include <vector>

#include "mover.h"
#include "slipface/base/parallel.h"

namespace slipface {

namespace {

// Each round leaves at most half of what a wall or a third body left of an overlap.
constexpr int rounds = 8;
// Distances at which bodies touch, in units of the summed radii: rounding is neither an overlap nor a gap.
constexpr double overlapping = 1.0 - 1e-9, touching = 1.0 + 1e-3;

struct Body {
    CrowdMember* member = nullptr;
    const MovementSettings* settings = nullptr;     // of the body that it has
    Vec3 begin = Vec3::Zero(), end = Vec3::Zero();  // of its centre in this step, the scene's coordinates
    double walkable = 1.0;                          // least N.y of what it stands on
    bool rides = false;                             // began on another body
    Vec3 velocity = Vec3::Zero();                   // of its motion in this step, m/s

    const Vec3& radii() const { return settings->radii; }
    bool held() const { return is_held(member->state) && !member->state.grounded; }
};

struct Touch {
    Vec3 normal = Vec3::Zero();  // unit, from the second body to the first
    double left = 1.0;           // fraction of the step that lies behind it
};

// The first body's position as seen from the second one, where the sum of both is the unit sphere.
Vec3 apart(const Body& a, const Vec3& at_a, const Body& b, const Vec3& at_b) {
    return (at_a - at_b).cwiseQuotient(a.radii() + b.radii());
}

Touch touch_at(const Body& a, const Body& b, const Vec3& apart, double left = 1.0) {
    const Vec3 normal = direction_of(apart.cwiseQuotient(a.radii() + b.radii()));
    return {.normal = normal.isZero(0.0) ? Vec3::UnitX() : normal, .left = left};
}

// The first touch on straight ways from the begins to the ends, if the bodies approach each other there.
std::optional<Touch> first_touch(const Body& a, const Body& b) {
    const Vec3 from = apart(a, a.begin, b, b.begin);
    const Vec3 move = apart(a, a.end, b, b.end) - from;
    const double approach = from.dot(move), gap = from.squaredNorm() - 1.0;
    if (!(approach < 0.0)) return std::nullopt;
    if (gap <= 0.0) return touch_at(a, b, from);
    const double inside = approach * approach - move.squaredNorm() * gap;
    if (!(inside >= 0.0)) return std::nullopt;
    const double t = gap / (std::sqrt(inside) - approach);
    if (!(t < 1.0)) return std::nullopt;
    return touch_at(a, b, from + t * move, 1.0 - t);
}

// Where the ends are no more than `distance` apart.
std::optional<Touch> end_touch(const Body& a, const Body& b, double distance) {
    const Vec3 q = apart(a, a.end, b, b.end);
    return q.squaredNorm() < distance * distance ? std::optional(touch_at(a, b, q)) : std::nullopt;
}

// How far the end of `a` has to go along `direction` (unit) to leave `b`, m; 0 if it is outside.
double way_out(const Body& a, const Body& b, const Vec3& direction) {
    const Vec3 q = apart(a, a.end, b, b.end), along = direction.cwiseQuotient(a.radii() + b.radii());
    const double square = along.squaredNorm(), half = q.dot(along);
    const double inside = half * half - square * (q.squaredNorm() - 1.0);
    return inside > 0.0 ? std::max(0.0, (std::sqrt(inside) - half) / square) : 0.0;
}

MovementScene seen_by(const MovementScene& scene, const CrowdMember& member) {
    MovementScene seen = scene;
    if (member.filter != nullptr) seen.filter = member.filter;
    return seen;
}

// Moves the end by `move`, as far as the scene lets it, and returns how far along `move` that is, m.
double shift(const MovementScene& whole, Body& body, const Vec3& move) {
    const MovementScene scene = seen_by(whole, *body.member);
    const double length = move.norm();
    if (length == 0.0 || body.held()) return 0.0;
    PlayerState here = body.member->state;
    here.position = body.end;
    const Surroundings around(scene, *body.settings, here.position, length);
    Mover mover({.scene = scene,
                 .settings = *body.settings,
                 .state = here,
                 .trace = nullptr,
                 .dt = 1.0,
                 .wish = Vec2::Zero(),
                 .jump_held = false,
                 .jump_pressed = false,
                 .walkable_cosine = body.walkable},
                around);
    mover.velocity = mover.velocity_before = move;
    collide_and_slide(mover, move.y() == 0.0 ? Pass::horizontal : Pass::slide, move);
    if (!clamp_to_terrain(mover, body.end) || !mover.position.allFinite()) return 0.0;
    if (overlaps_scene(mover, mover.position) && !overlaps_scene(mover, body.end)) return 0.0;
    const double moved = (mover.position - body.end).dot(move) / length;
    body.end = mover.position;
    return moved;
}

// The upper body, if it stands on the lower one.
Body* standing(Body& a, Body& b, const Vec3& normal) {
    Body& upper = normal.y() >= 0.0 ? a : b;
    return std::abs(normal.y()) >= upper.walkable && !upper.held() ? &upper : nullptr;
}

Vec3 sideways(const Vec3& normal) {
    const Vec3 flat = direction_of(horizontal(normal));
    return flat.isZero(0.0) ? Vec3::UnitX() : flat;
}

void take_apart(const MovementScene& scene, Body& a, Body& b, const Touch& touch) {
    if (Body* const upper = standing(a, b, touch.normal)) {
        Body& lower = upper == &a ? b : a;
        const double depth = way_out(*upper, lower, Vec3::UnitY());
        const double raised = shift(scene, *upper, depth * Vec3::UnitY());
        shift(scene, lower, (raised - depth) * Vec3::UnitY());  // under a ceiling
        return;
    }
    // After the touch only as far as they approached since: one that got past is not put back.
    const Vec3 away = sideways(touch.normal);
    double depth = way_out(a, b, away);
    if (touch.left < 1.0) {
        const Vec3 since = touch.left * (a.end - a.begin - b.end + b.begin);
        depth = std::min(depth, std::max(0.0, -since.dot(away)));
    }
    double done = shift(scene, b, -0.5 * depth * away);
    done += shift(scene, a, (depth - done) * away);
    shift(scene, b, (done - depth) * away);
}

// Bodies that may touch in this step, the lowest first.
std::vector<std::pair<std::size_t, std::size_t>> near_pairs(const std::vector<Body>& bodies) {
    struct Box {
        Aabb room;
        std::size_t body;
    };
    std::vector<Box> boxes;
    for (const Body& body : bodies) {
        const Vec3 reach = 1.25 * body.radii();  // also after some pushes
        boxes.push_back(
            {{body.begin.cwiseMin(body.end) - reach, body.begin.cwiseMax(body.end) + reach}, boxes.size()});
    }
    std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) {
        return std::tuple(a.room.min.x(), a.body) < std::tuple(b.room.min.x(), b.body);
    });
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t k = i + 1; k < boxes.size() && boxes[k].room.min.x() <= boxes[i].room.max.x(); ++k) {
            const Aabb &a = boxes[i].room, &b = boxes[k].room;
            if ((a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all() &&
                meet(bodies[boxes[i].body].member->filter, bodies[boxes[k].body].member->filter))
                pairs.push_back(std::minmax(boxes[i].body, boxes[k].body));
        }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

// A body that began on another one goes where that one goes, and takes its velocity along if it leaves it;
// stand() takes that off again. The lower one of a pair comes first, so towers are carried from below.
void carry_riders(const MovementScene& scene, std::vector<Body>& bodies, double dt) {
    std::vector<std::size_t> carrier(bodies.size(), bodies.size());
    std::vector<double> best(bodies.size(), 0.0);
    bool any = false;
    for (const auto& [i, k] : near_pairs(bodies)) {
        const Body &lower = bodies[i], &upper = bodies[k];
        const Vec3 q = apart(upper, upper.begin, lower, lower.begin);
        const double up = touch_at(upper, lower, q).normal.y();
        if (!upper.rides || !(q.norm() < touching) || up < upper.walkable || up <= best[k]) continue;
        carrier[k] = i;
        best[k] = up;
        any = true;
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        Body& body = bodies[i];
        if (any && carrier[i] < bodies.size()) {
            const Body& lower = bodies[carrier[i]];
            PlayerState& state = body.member->state;
            shift(scene, body, lower.end - lower.begin);
            const Vec3 kept = kept_on_leave(body.member->settings->leave_mode, lower.velocity);
            state.velocity += kept;
            if (!state.grounded && !body.held()) state.air_frame = kept;
        }
        body.velocity = (body.end - body.begin) / dt;
    }
}

void stand(Body& upper, const Body& lower, Vec3 normal) {
    normal *= normal.y() < 0.0 ? -1.0 : 1.0;
    PlayerState& state = upper.member->state;
    if (state.velocity.y() > std::max(lower.velocity.y(), 0.0)) return;  // it jumps off
    const double height = upper.radii().y();
    state.velocity = horizontal(state.velocity - lower.velocity);
    state.air_frame = Vec3::Zero();
    state.carrier = Carrier::character;
    state.grounded = true;
    state.jumping = false;
    state.ground_normal = normal;
    state.ground_face = no_id;
    state.ground_surface = default_surface;
    state.ground_platform = no_id;
    state.ground_rise = height - height * height * normal.y() / upper.radii().cwiseProduct(normal).norm();
}

void settle(Body& a, Body& b) {
    const std::optional<Touch> touch = end_touch(a, b, touching);
    if (!touch) return;
    if (Body* const upper = standing(a, b, touch->normal))
        return stand(*upper, upper == &a ? b : a, touch->normal);
    const Vec3 away = sideways(touch->normal);
    Vec3 &of_a = a.member->state.velocity, &of_b = b.member->state.velocity;
    const double approach = std::min(0.0, (of_a - of_b).dot(away));
    if (!a.held()) of_a -= 0.5 * approach * away;
    if (!b.held()) of_b += 0.5 * approach * away;
}

}  // namespace

void step_crowd(const MovementScene& scene, std::span<CrowdMember> members, double dt) {
    std::vector<Body> bodies;
    for (CrowdMember& member : members) {
        const PlayerState& state = member.state;
        Body body{.member = &member,
                  .settings = member.settings,
                  .begin = position_in_scene(scene, state),
                  .walkable = slope_cosine(member.settings->max_slope),
                  .rides = state.grounded && state.carrier == Carrier::character};
        if (body.begin.allFinite() && is_finite(*member.settings) && body.radii().minCoeff() > 0.0)
            bodies.push_back(body);
    }
    // All that follows goes in this order, whatever that of the members is.
    std::sort(bodies.begin(), bodies.end(), [](const Body& a, const Body& b) {
        const auto key = [](const Body& body) {
            return std::tuple(body.begin.y(), body.begin.x(), body.begin.z(), body.member);
        };
        return key(a) < key(b);
    });
    parallel_for(bodies.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            CrowdMember& member = *bodies[i].member;
            member.state = step(seen_by(scene, member), *member.settings, member.state, member.input, dt,
                                nullptr, member.contacts)
                               .state;
            bodies[i].end = position_in_scene(scene, member.state);
        }
    });
    std::deque<MovementSettings> crouched;
    for (Body& body : bodies)
        if (body.member->state.crouched)
            body.settings =
                &crouched.emplace_back(settings_of_body(*body.member->settings, body.member->state));
    carry_riders(scene, bodies, dt);
    const auto pairs = near_pairs(bodies);
    for (const auto& [i, k] : pairs)
        if (const auto touch = first_touch(bodies[i], bodies[k]))
            take_apart(scene, bodies[i], bodies[k], *touch);
    for (int round = 0; round < rounds; ++round)
        for (const auto& [i, k] : pairs)
            if (const auto touch = end_touch(bodies[i], bodies[k], overlapping))
                take_apart(scene, bodies[i], bodies[k], *touch);
    for (const auto& [i, k] : pairs)
        settle(bodies[i], bodies[k]);
    for (const Body& body : bodies)
        put_in_scene(scene, body.end, body.member->state);
}

}  // namespace slipface
