// Problem: at the edge of every downward step, and over every crest, the player flies for some ticks and
// cannot jump. Hack: a player that was on the ground and did not jump is put onto the ground below, if it is
// near. A long tick may cross several steps; each of them may be as deep as the snap distance.
#include "mover.h"

namespace slipface {

void snap_down(Mover& mover, const Motion& before) {
    const MovementSettings& s = mover.settings;
    if (!s.snap_down) {
        decide(mover, Decision::snap_off);
        return;
    }
    const double reach = s.snap_distance + 2.0 * s.skin;
    const double moved = horizontal(mover.position - before.position).norm();
    const Swept swept = sweep_with_skin(mover, Pass::snap, 0, Vec3(0.0, -(reach + moved), 0.0));
    const auto say = [&](Decision kind, const Quantity& quantity) {
        decide(mover, kind, quantity, swept.contact ? swept.contact->face : no_id);
    };
    if (!swept.contact) return say(Decision::snap_no_floor, {.value = s.snap_distance});
    const double dropped = mover.position.y() - swept.reached.y();
    if (dropped > reach && !no_deeper_than_steps(mover, before.position, *swept.contact, s.snap_distance))
        return say(Decision::snap_too_deep, {.value = dropped, .limit = s.snap_distance});
    const LandingRules rules{
        .own_response = Decision::snap_own_response, .too_steep = Decision::snap_too_steep, .on_ice = false};
    if (const auto refusal = land(mover, swept, rules)) return say(refusal->why, refusal->quantity);
    ++mover.contacts;
    note_contact(mover, Pass::snap, *swept.contact, swept.platform);
    say(Decision::snapped, {.value = dropped, .limit = s.snap_distance});
}

}  // namespace slipface
