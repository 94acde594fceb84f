// Problem: a ramp met at an angle pushes the player up and to the side.
// Hack (lecture, "Deflection on ramps"): a horizontal move goes on in the direction V - (0, 1/N.y, 0) (N.V),
// straight ahead on the contact plane, by the length of V - N (N.V), what plain sliding would have made.
//
// Only ground that can be walked on is a ramp. Anything steeper is a wall to a horizontal move: it slides
// along the horizontal part of the normal, or a player would run up a cliff by pushing against it.
//
// A ramp turns the displacement and leaves the velocity: the velocity of a walking player is what the stick
// asks for, and turning it at every tick would brake the player more the shorter the ticks are.
#include "mover.h"

namespace slipface {

std::optional<Turn> slide_at_wall(Mover& mover, const Hit& hit) {
    if (hit.pass != Pass::horizontal || hit.walkable) return std::nullopt;
    const Vec3 plane = direction_of(horizontal(hit.contact.normal));
    // Straight overhead or underfoot: no wall in it.
    if (plane.isZero(0.0)) return std::nullopt;
    mover.walled = true;
    decide(mover, "max_slope", true, "N.y", hit.contact.normal.y(), walkable_limit(mover, hit.surface),
           "a wall: slides along it", hit.contact.face);
    return Turn{.rule = Rule::slide,
                .leftover = slide_along(hit.leftover, plane),
                .velocity = slide_along(mover.velocity, plane),
                .plane = plane};
}

std::optional<Turn> go_straight_ahead(Mover& mover, const Hit& hit) {
    if (hit.pass != Pass::horizontal || !hit.walkable) return std::nullopt;
    const Vec3& normal = hit.contact.normal;
    const Vec3 slid = slide_along(hit.leftover, normal);
    Turn turn{.rule = Rule::slide,
              .leftover = slid,
              .velocity = mover.was_grounded ? mover.velocity : slide_along(mover.velocity, normal),
              .plane = normal,
              .constrains_velocity = !mover.was_grounded};
    const bool acts = mover.settings.straight_ahead;
    if (acts) {
        const Vec3 ahead = hit.leftover - Vec3(0.0, hit.leftover.dot(normal) / normal.y(), 0.0);
        turn.rule = Rule::straight_ahead;
        turn.leftover = direction_of(ahead) * slid.norm();
    }
    decide(mover, "straight_ahead", acts, "N.y", normal.y(), walkable_limit(mover, hit.surface),
           acts ? "goes straight ahead up the ramp" : "switched off: the ramp turns the move",
           hit.contact.face);
    return turn;
}

}  // namespace slipface
