// Problem: a ramp met at an angle pushes the player up and to the side.
// Hack (lecture, "Deflection on ramps"): a horizontal move goes on in the direction V - (0, 1/N.y, 0) (N.V),
// straight ahead on the contact plane, by the length of V - N (N.V), what plain sliding would have made.
//
// Only ground that can be walked on is a ramp; steep_walls.cpp has what is steeper.
//
// A ramp deflects the displacement and leaves the velocity: the velocity of a walking player is what the
// stick asks for, and deflecting it in every tick would brake the player more the shorter the ticks are.
#include "mover.h"

namespace slipface {

std::optional<Deflection> go_straight_ahead(Mover& mover, const Hit& hit) {
    if (hit.pass != Pass::horizontal || !hit.walkable) return std::nullopt;
    const Vec3& normal = hit.contact.normal;
    const Vec3 slid = slide_along(hit.remainder, normal);
    Deflection deflection{
        .rule = Rule::slide,
        .remainder = slid,
        .velocity = mover.was_grounded ? mover.velocity : slide_along(mover.velocity, normal),
        .plane = normal,
        .constrains_velocity = !mover.was_grounded};
    const bool acts = mover.settings.straight_ahead;
    const bool constant = mover.settings.constant_slope_speed && mover.was_grounded;
    deflection.slides = !acts && !constant;
    if (constant) deflection.remainder = direction_of(slid) * hit.remainder.norm();
    if (acts) {
        const Vec3 ahead = hit.remainder - Vec3(0.0, hit.remainder.dot(normal) / normal.y(), 0.0);
        deflection.rule = Rule::straight_ahead;
        deflection.remainder = direction_of(ahead) * (constant ? hit.remainder : slid).norm();
    }
    decide(mover, acts ? Decision::straight_ahead : Decision::straight_ahead_off,
           {.value = normal.y(), .limit = walkable_limit(mover, hit.surface)}, hit.contact.face);
    return deflection;
}

}  // namespace slipface
