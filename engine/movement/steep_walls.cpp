// Problem: a player who pushes against a cliff would slide up it.
// Rule: what is too steep to stand on is a wall to a horizontal move. The move slides along the horizontal
// part of the normal. A move that rises, as on a ramp, would then still lead into an overhang, and the player
// would stop between the two. So an overhang is met as the plane that it is: what leads into it slides down
// along it, and with the ramp it makes a crease.
#include "mover.h"

namespace slipface {

namespace {

// Rounding of a face's corners makes no overhang.
constexpr double grazing = 1e-6;

}  // namespace

Vec3 plane_of_wall(const Vec3& normal) {
    return normal.y() < -grazing ? normal : direction_of(horizontal(normal));
}

void note_wall(Mover& mover, const Vec3& plane) {
    const int known = mover.wall_count;
    if (known == 0 || (known == 1 && mover.walls[0].dot(plane) < 0.99))
        mover.walls[static_cast<std::size_t>(mover.wall_count++)] = plane;
}

std::optional<Deflection> slide_at_steep_wall(Mover& mover, const Hit& hit) {
    if (hit.pass != Pass::horizontal || hit.walkable) return std::nullopt;
    const Vec3 plane = direction_of(horizontal(hit.contact.normal));
    // Straight overhead or underfoot: no wall in it.
    if (plane.isZero(0.0)) return std::nullopt;
    note_wall(mover, plane);
    decide(mover, Decision::wall,
           {.value = hit.contact.normal.y(), .limit = walkable_limit(mover, hit.surface)}, hit.contact.face);
    Deflection deflection{.rule = Rule::slide,
                          .remainder = slide_along(hit.remainder, plane),
                          .velocity = slide_along(mover.velocity, plane),
                          .plane = plane,
                          .slides = true};
    const Vec3& normal = hit.contact.normal;
    deflection.plane = plane_of_wall(normal);
    if (normal.y() < -grazing) {
        if (deflection.remainder.dot(normal) < -grazing * deflection.remainder.norm())
            deflection.remainder = slide_along(hit.remainder, normal);
    }
    return deflection;
}

}  // namespace slipface
