// Problem: a player that spawned inside geometry never moves again.
// Hack (lecture, "Case study: Quake 2"): tries small offsets along all three axes and takes the nearest free
// one (room.cpp).
#include "mover.h"

namespace slipface {

bool nudge(Mover& mover) {
    constexpr int rings = 8;  // how many distances up to the farthest are tried
    const double farthest = mover.settings.nudge_distance;
    if (!overlaps_scene(mover, mover.position) && !in_solid(mover, mover.position)) {
        decide(mover, Decision::nudge_needless);
        return true;
    }
    const auto room = nearest_room(mover, farthest, rings);
    if (!room) {
        decide(mover, Decision::nudge_failed, {.value = farthest});
        return false;
    }
    decide(mover, Decision::nudged, {.value = (*room - mover.position).norm(), .limit = farthest});
    mover.position = *room;
    return true;
}

}  // namespace slipface
