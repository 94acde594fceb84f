// The last word on every step: a position inside geometry is not accepted.
//
// Every centre lies on a swept path that stops a skin short, so this does not happen in exact arithmetic;
// rounding and the last hundredth of a skin in acute corners are what it is for. By induction each accepted
// position is outside and each way between two of them was swept.
#include "mover.h"

namespace slipface {

bool ends_inside(Mover& mover, const Vec3& from) {
    if (mover.position == from) return false;
    mover.end_is_free = !overlaps_scene(mover, mover.position);
    // A player who began inside may be on the way out.
    return !mover.end_is_free && !overlaps_scene(mover, from);
}

}  // namespace slipface
