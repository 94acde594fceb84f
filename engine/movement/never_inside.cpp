// The last word on every step: a position inside geometry is not accepted.
//
// Every centre lies on a swept path that stops a skin short, so this does not happen in exact arithmetic;
// rounding and the last hundredth of a skin in acute corners are what it is for. By induction each accepted
// position is outside and each way between two of them was swept.
#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

// One-sided faces let the player through from behind, so being across one is legal.
bool inside(const Mover& mover, const Vec3& centre) {
    const CollisionWorld& world = mover.scene.collision;
    if (!overlaps_any(world, mover.settings.radii, centre)) return false;
    std::array<Overlap, 64> overlaps;
    const std::size_t count = find_overlaps(world, mover.settings.radii, centre, overlaps);
    if (count > overlaps.size()) return true;
    return std::any_of(overlaps.begin(), overlaps.begin() + static_cast<std::ptrdiff_t>(count),
                       [&](const Overlap& o) { return !world.surface_rule(o.surface).one_sided; });
}

}  // namespace

bool ends_inside(const Mover& mover, const Vec3& from) {
    // A player who began inside may be on the way out.
    return mover.position != from && inside(mover, mover.position) && !inside(mover, from);
}

}  // namespace slipface
