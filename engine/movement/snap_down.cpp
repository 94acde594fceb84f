// Problem: at the edge of every step on the way down, and over every crest, the player flies for some ticks
// and cannot jump. Hack: a player who was on the ground and did not jump is put onto the ground below, if it
// is near.
#include "mover.h"

namespace slipface {

void snap_down(Mover& mover) {
    const double distance = mover.settings.snap_distance;
    if (!mover.settings.snap_down) {
        decide(mover, "snap_down", false, "", 0.0, 0.0, "switched off: leaves the ground");
        return;
    }
    const Swept swept = sweep_with_skin(mover, Pass::snap, 0, Vec3(0.0, -distance, 0.0));
    const auto say = [&](bool acted, const char* quantity, double value, double limit, const char* outcome) {
        decide(mover, "snap_down", acted, quantity, value, limit, outcome,
               swept.contact ? swept.contact->face : no_id);
    };
    if (!swept.contact)
        return say(false, "distance, m", distance, distance, "refused: no floor within reach");
    const Contact& contact = *swept.contact;
    const SurfaceType& surface = surface_of(mover, contact.surface);
    const bool walkable = is_walkable(mover, contact.normal, surface);
    if (sticks(mover, surface) || restitution_of(mover, surface) > 0.0 || surface.keeps_energy) {
        return say(false, "plain ground", 0.0, 1.0, "refused: the floor has its own response");
    }
    const Vec3 before = mover.position;
    mover.position = swept.reached;
    if (!walkable && !on_rim(mover, contact)) {
        mover.position = before;
        return say(false, "N.y", contact.normal.y(), walkable_limit(mover, surface), "refused: too steep");
    }
    mover.grounded = true;
    mover.hazard = mover.hazard || surface.hazardous;
    mover.support_normal = walkable ? contact.normal : Vec3(Vec3::UnitY());
    mover.support_face = contact.face;
    mover.support_surface = contact.surface;
    mover.support_platform = swept.platform;
    ++mover.contacts;
    say(true, "snapped, m", before.y() - mover.position.y(), distance, "snaps to the floor");
}

}  // namespace slipface
