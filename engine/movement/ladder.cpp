// Ladders: no gravity, the player moves in the plane of the surface. The stick into the wall climbs up, away
// from it climbs down, sideways moves along. The player leaves at the bottom by touching ground, at the top
// where the surface becomes flat enough to walk on, and anywhere by a jump.
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

// Overhangs up to 30 degrees beyond the vertical are climbed.
constexpr double overhang = -0.5;
// A player on the ground passes a ladder unless the stick points into it within 60 degrees.
constexpr double meant = 0.5;

Vec3 as_vector(const Vec2& wish) {
    return {wish.x(), 0.0, wish.y()};
}

void leave(Mover& mover, const Vec3& velocity, Decision why) {
    mover.climbing = false;
    mover.velocity = velocity;
    decide(mover, why, mover.support.face);
    if (!mover.grounded) mover.support.face = no_id;
}

// After the move: searches the ladder where it was. Its surface may have bent or ended.
void follow(Mover& mover, const Vec3& from, double rising, double sideways) {
    const Vec3 moved = mover.position - from;
    const Vec3 towards = -mover.state.ground_normal * (moved.norm() + mover.settings.skin);
    const Vec3 before = mover.position;
    const Swept swept = sweep_with_skin(mover, Pass::probe, 0, towards);
    if (!swept.contact) {
        leave(mover, mover.velocity, Decision::ladder_ended);
        return;
    }
    mover.position = swept.reached;
    const Contact& contact = *swept.contact;
    const SurfaceType& surface = surface_of(mover, contact.surface);
    const Support found{contact.normal, contact.face, contact.surface, swept.platform};
    mover.hazard = mover.hazard || surface.hazardous;
    note_contact(mover, Pass::slide, contact, swept.platform);
    if (is_walkable(mover, contact.normal, surface)) {
        mover.grounded = true;
        mover.support = found;
        leave(mover, Vec3::Zero(), Decision::ladder_top);
    } else if (surface.climbable) {
        mover.support = found;
    } else if (contact.feature != Feature::interior && rising > 0.0) {
        // The rim belongs also to the faces of the top. Whichever of them was touched, the climb goes on.
        mover.support = support_before(mover);
        mover.support.normal = contact.normal;
    } else if (rising >= std::abs(sideways)) {
        // A plain wall continues above the ladder. On it the player would fall back in every tick.
        mover.position = from;
        mover.velocity = Vec3::Zero();
        mover.support = support_before(mover);
        decide(mover, Decision::ladder_wall_above, contact.face);
    } else {
        mover.position = before;
        leave(mover, mover.velocity, Decision::ladder_beside);
    }
}

}  // namespace

std::optional<Deflection> grab_ladder(Mover& mover, const Hit& hit) {
    const Contact& contact = hit.contact;
    if (!hit.surface.climbable || mover.on_ladder || hit.walkable) return std::nullopt;
    const auto refuse = [&](Decision why, double value, double limit) {
        decide(mover, why, {.value = value, .limit = limit}, contact.face);
        return std::nullopt;
    };
    if (contact.normal.y() < overhang) return refuse(Decision::ladder_overhead, contact.normal.y(), overhang);
    const double into = -direction_of(as_vector(mover.wish)).dot(direction_of(horizontal(contact.normal)));
    if (mover.was_grounded && into < meant) return refuse(Decision::ladder_passed, into, meant);
    mover.climbing = true;
    mover.grounded = false;
    mover.support = {contact.normal, contact.face, contact.surface, hit.platform};
    decide(mover, Decision::ladder_grabbed, contact.face);
    return Deflection{.rule = Rule::stop, .plane = contact.normal};
}

void climb(Mover& mover) {
    const Vec3& normal = mover.state.ground_normal;
    const SurfaceType& ladder = support_of(mover);
    const Vec3 out = direction_of(horizontal(normal));
    const Vec3 up = direction_of(Vec3::UnitY() - normal * normal.y());
    const Vec3 side = Vec3::UnitY().cross(out);
    const Vec3 wish = as_vector(mover.wish);
    const double rising = -wish.dot(out);
    const double sideways = wish.dot(side);
    const Vec3 from = mover.position;

    mover.on_ladder = true;
    mover.climbing = true;
    mover.hazard = mover.hazard || ladder.hazardous;
    mover.support = support_before(mover);
    mover.velocity = ladder.climb_speed * (up * rising + side * sideways);
    mover.velocity_before = mover.velocity;
    decide(mover, Decision::ladder_climbed, {.value = mover.velocity.norm(), .limit = ladder.climb_speed},
           mover.support.face);
    if (mover.velocity.isZero(0.0)) return;

    collide_and_slide(mover, Pass::slide, mover.velocity * mover.dt);
    if (mover.stuck) {
        mover.climbing = false;
    } else if (mover.grounded) {
        leave(mover, Vec3::Zero(), Decision::ladder_ground);
    } else {
        follow(mover, from, rising, sideways);
    }
}

}  // namespace slipface
