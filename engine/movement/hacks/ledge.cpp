// Problem: a jump that ends a hand below the edge of a wall slides down it. Hack: hands that come down past
// an edge hold it. The player hangs with its hands exactly at the edge, at every rate, and climbs up, jumps
// or lets go.
//
// Rays are the hands: level above the edge nothing may be in their way, from there down there must be ground
// to stand on, and just below it a wall. The climb leads up and then over the edge, each part swept.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

constexpr double meant = 0.5;  // a cosine: the stick points at it within 60 degrees
constexpr double shortest_s = 0.05;
constexpr int fingers = 4;  // rays down within the reach, nearest first

struct Ledge {
    double height = 0.0;  // of its edge, in the scene
    Support wall;         // below it
};

double hands_of(const Mover& mover) {
    return mover.position.y() + mover.settings.ledge_hands;
}
double radius_of(const Mover& mover) {
    return std::max(mover.settings.radii.x(), mover.settings.radii.z());
}
// Of the way that a climb leads up, beyond the edge, and forward.
double clearance(const Mover& mover) {
    return 2.0 * mover.settings.skin;
}
double forward_of(const Mover& mover) {
    return radius_of(mover) * 1.25 + mover.settings.ledge_reach;
}
double rise_of(const Mover& mover) {
    return mover.settings.radii.y() + mover.settings.ledge_hands + clearance(mover);
}

// The edge that the hands meet when they come down by `fall` metres. What only its kind forbids is said.
std::optional<Ledge> ledge_ahead(const Mover& mover, Vec3 ahead, double fall) {
    const MovementSettings& s = mover.settings;
    const double above = 4.0 * s.skin, depth = fall + 2.0 * above, radius = radius_of(mover);
    Vec3 hands(mover.position.x(), hands_of(mover) + above, mover.position.z());
    // The wall says which way its edge is.
    const Vec3 low = hands - Vec3(0.0, depth, 0.0);
    if (const auto wall = ray_in_scene(mover, low, ahead * ((radius + s.ledge_reach) / meant))) {
        const Vec3 in = -direction_of(horizontal(wall->normal));
        if (in.dot(ahead) > meant) ahead = in;
    }
    const double reach = radius + s.ledge_reach;
    const auto barrier = ray_in_scene(mover, hands, ahead * reach);
    const double open = barrier ? barrier->t * reach : 2.0 * reach;
    for (int i = 1; i <= fingers; ++i) {
        const double away = radius + s.ledge_reach * i / fingers;
        if (away >= open) break;
        const auto top = ray_in_scene(mover, hands + ahead * away, Vec3(0.0, -depth, 0.0));
        if (!top || top->back_face) continue;
        const double height = hands.y() - top->t * depth;
        const SurfaceType& surface = surface_of(mover, top->surface);
        if (height > hands_of(mover) + 0.5 * s.skin || !is_walkable(mover, top->normal, surface)) continue;
        const Vec3 below(hands.x(), height - clearance(mover), hands.z());
        const auto wall = ray_in_scene(mover, below, ahead * away);
        if (!wall || wall->back_face) continue;
        const double slope = std::abs(wall->normal.y()), least = slope_cosine(s.ledge_wall);
        if (slope > least) {
            if (s.ledge_grab)
                decide(mover, Decision::ledge_not_steep, {.value = slope, .limit = least}, wall->face);
            return std::nullopt;
        }
        if (!surface.grabbable || !surface_of(mover, wall->surface).grabbable) {
            if (s.ledge_grab) decide(mover, Decision::ledge_forbidden, wall->face);
            return std::nullopt;
        }
        return Ledge{.height = height, .wall = {wall->normal, wall->face, wall->surface, wall->platform}};
    }
    return std::nullopt;
}

Vec3 stick_of(const Mover& mover) {
    return direction_of(Vec3(mover.wish.x(), 0.0, mover.wish.y()));
}

void hang_from(Mover& mover, const Support& wall, double rise) {
    mover.hanging = true;
    mover.grounded = false;
    mover.support = wall;
    mover.support_rise = rise;
    mover.velocity = Vec3::Zero();
    mover.velocity_before = Vec3::Zero();
}

bool has_room_above(Mover& mover, const Vec3& ahead) {
    const Vec3 up(0.0, mover.support_rise + clearance(mover), 0.0), over = ahead * forward_of(mover);
    return !sweep_scene(mover, mover.position, up) && !sweep_scene(mover, mover.position + up, over);
}

Drive climb_on(Mover& mover, const Vec3& ahead, double left) {
    const double time = std::max(mover.settings.ledge_time, shortest_s);
    const double way = (rise_of(mover) + forward_of(mover)) / time * std::min(mover.dt, left);
    const double up = std::clamp(mover.support_rise + clearance(mover), 0.0, way);
    decide(mover, Decision::ledge_climbed, {.value = left}, mover.support.face);
    mover.move_s = left;
    return {.kind = Drive::Kind::hang, .move = ahead * (way - up) + Vec3(0.0, up, 0.0)};
}

}  // namespace

std::optional<Drive> grab_ledge(Mover& mover, const Vec3& move) {
    const MovementSettings& s = mover.settings;
    // Off, only a trace asks for what could have been.
    if ((!s.ledge_grab && mover.trace == nullptr) || mover.was_grounded || mover.jumped || !(move.y() < 0.0))
        return std::nullopt;
    Vec3 ahead = stick_of(mover);
    if (s.ledge_form == LedgeForm::button) {
        if (!mover.buttons.has(Button::grab)) return std::nullopt;
        if (ahead.isZero(0.0) && touches_wall(mover.state))
            ahead = -direction_of(horizontal(mover.state.ground_normal));
    }
    if (ahead.isZero(0.0) || mover.buttons.has(Button::drop)) return std::nullopt;
    const std::optional<Ledge> ledge = ledge_ahead(mover, ahead, -move.y());
    if (!ledge) return std::nullopt;
    const double down = ledge->height - hands_of(mover);
    const double rise = ledge->height - (mover.position.y() - s.radii.y());
    if (down < move.y()) return std::nullopt;
    decide(mover, s.ledge_grab ? Decision::ledge_grabbed : Decision::ledge_grab_off, {.value = rise},
           ledge->wall.face);
    if (!s.ledge_grab) return std::nullopt;
    hang_from(mover, ledge->wall, rise);
    mover.move_s = 0.0;
    return Drive{.kind = Drive::Kind::hang, .move = {0.0, std::min(0.0, down), 0.0}};
}

std::optional<Drive> hang_on(Mover& mover, bool& jump) {
    const MovementSettings& s = mover.settings;
    const PlayerState& state = mover.state;
    const Vec3 ahead = -direction_of(horizontal(state.ground_normal));
    hang_from(mover, support_before(mover), state.ground_rise);
    if (is_open(state.move_s, mover.dt)) {
        jump = false;
        return climb_on(mover, ahead, state.move_s);
    }
    const double into = stick_of(mover).dot(ahead);
    const bool released = s.ledge_form == LedgeForm::button && !mover.buttons.has(Button::grab);
    const bool leaps = jump && s.ledge_climb == LedgeClimb::stick;
    const bool lets_go = !s.ledge_grab || released || mover.buttons.has(Button::drop) || into < -meant;
    // Where a wall that leans stopped the grab, the hands are above the edge.
    const double above = std::max(0.0, s.radii.y() + s.ledge_hands - state.ground_rise);
    const std::optional<Ledge> ledge = leaps || lets_go ? std::nullopt : ledge_ahead(mover, ahead, above);
    if (!ledge) {
        mover.hanging = false;
        mover.support = {};
        if (!leaps) decide(mover, lets_go ? Decision::ledge_let_go : Decision::ledge_lost, state.ground_face);
        return std::nullopt;
    }
    hang_from(mover, ledge->wall, ledge->height - (mover.position.y() - s.radii.y()));
    const bool climbs = s.ledge_climb == LedgeClimb::jump ? jump : into > meant;
    jump = false;
    if (climbs && has_room_above(mover, ahead)) {
        const double time = std::max(s.ledge_time, shortest_s);
        if (time != s.ledge_time)
            decide(mover, Decision::ledge_quickened, {.value = s.ledge_time, .limit = shortest_s});
        return climb_on(mover, ahead, time);
    }
    if (climbs)
        decide(mover, Decision::ledge_no_room, {.value = forward_of(mover)}, mover.support.face);
    else
        decide(mover, Decision::ledge_held, {.value = mover.support_rise}, mover.support.face);
    return Drive{.kind = Drive::Kind::hang};
}

void hang(Mover& mover, const Vec3& move) {
    const Vec3 up(0.0, move.y(), 0.0), over = horizontal(move), begin = mover.position;
    if (!up.isZero(0.0)) mover.position = sweep_with_skin(mover, Pass::vertical, 0, up).reached;
    mover.support_rise -= mover.position.y() - begin.y();
    if (!over.isZero(0.0)) mover.position = sweep_with_skin(mover, Pass::horizontal, 0, over).reached;
    mover.hazard = mover.hazard || surface_of(mover, mover.support.surface).hazardous;
    if (!(mover.move_s > 0.0)) return;
    const bool blocked = (mover.position - begin).norm() < 0.5 * move.norm();
    mover.move_s = blocked ? 0.0 : mover.move_s - mover.dt;
    if (is_open(mover.move_s, mover.dt)) return;
    mover.move_s = 0.0;
    if (mover.support_rise > 0.0) return;  // it hangs on
    mover.hanging = false;
    mover.support = {};
    const Swept swept = sweep_with_skin(mover, Pass::snap, 0, Vec3(0.0, -2.0 * clearance(mover), 0.0));
    if (!swept.contact ||
        !is_walkable(mover, swept.contact->normal, surface_of(mover, swept.contact->surface)))
        return;
    mover.position = swept.reached;
    stand_on(mover, *swept.contact, swept.platform);
}

}  // namespace slipface
