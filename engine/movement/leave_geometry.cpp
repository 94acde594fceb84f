// A player who begins a step inside geometry, by a bad spawn or a moved wall, is put outside before anything
// else: by push_out.cpp, and where that is off or finds nothing by nudge.cpp. A nudge also puts out a new
// player whose centre is inside a solid of which it touches no face.
#include "mover.h"

namespace slipface {

void leave_geometry(Mover& mover) {
    const MovementSettings& settings = mover.settings;
    mover.trapped = false;
    const bool pushes = settings.push_out != PushOut::off;
    // Where nothing is done about it, only a trace and a platform need the answer.
    const bool asks = mover.trace != nullptr || mover.pressed;
    if (pushes || settings.nudge) mover.began_free = is_free(mover, mover.position);
    const bool inside =
        !mover.began_free && (pushes || settings.nudge || asks) && overlaps_scene(mover, mover.position);
    if (!inside && (pushes || settings.nudge))
        decide(mover, settings.nudge ? Decision::nudge_needless : Decision::push_out_needless);
    if (inside && pushes) push_out(mover);
    if (inside && !pushes) decide(mover, Decision::push_out_off);
    const bool enclosed =
        settings.nudge && mover.state.carrier == Carrier::unknown && in_solid(mover, mover.position);
    if ((inside || enclosed) && settings.nudge) mover.trapped = !nudge(mover);
    if (inside && !settings.nudge && asks && overlaps_scene(mover, mover.position)) {
        decide(mover, Decision::nudge_off);
        mover.trapped = mover.pressed;
    }
    if (!mover.swallowed && !(mover.pressed && mover.trapped)) return;
    mover.trapped = mover.crushed = true;
    decide(mover, Decision::platform_crushed, mover.presser);
}

}  // namespace slipface
