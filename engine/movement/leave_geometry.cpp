// A player who begins a step inside geometry, by a bad spawn or a moved wall, is put outside before anything
// else: by push_out.cpp, and where that is off or finds nothing by nudge.cpp.
#include "mover.h"

namespace slipface {

void leave_geometry(Mover& mover) {
    const MovementSettings& settings = mover.settings;
    mover.trapped = false;
    const bool pushes = settings.push_out != PushOut::off;
    if (!pushes && !settings.nudge) {
        // Only a trace needs the answer.
        if (mover.trace == nullptr || !overlaps_scene(mover, mover.position)) return;
        decide(mover, Decision::push_out_off);
        decide(mover, Decision::nudge_off);
        return;
    }
    mover.began_free = is_free(mover, mover.position);
    if (mover.began_free || !overlaps_scene(mover, mover.position)) {
        decide(mover, settings.nudge ? Decision::nudge_needless : Decision::push_out_needless);
        return;
    }
    if (pushes) {
        push_out(mover);
    } else {
        decide(mover, Decision::push_out_off);
    }
    if (settings.nudge) {
        mover.trapped = !nudge(mover);
    } else if (mover.trace != nullptr && overlaps_scene(mover, mover.position)) {
        decide(mover, Decision::nudge_off);
    }
}

}  // namespace slipface
