// Sticky surfaces, also walls and ceilings, hold a player that touches them until a jump, which leaves along
// the normal.
#include "mover.h"

namespace slipface {

std::optional<Deflection> stick(Mover& mover, const Hit& hit) {
    if (!hit.surface.sticky) return std::nullopt;
    if (!mover.settings.stick) {
        decide(mover, Decision::stick_off, hit.contact.face);
        return std::nullopt;
    }
    mover.stuck = true;
    mover.grounded = false;
    mover.support = {hit.contact.normal, hit.contact.face, hit.contact.surface, hit.platform};
    decide(mover, Decision::stuck, hit.contact.face);
    return Deflection{.rule = Rule::stick, .plane = hit.contact.normal};
}

void hold(Mover& mover) {
    mover.stuck = true;
    mover.velocity = Vec3::Zero();
    mover.support = support_before(mover);
    mover.hazard = mover.hazard || support_of(mover).hazardous;
    decide(mover, Decision::still_stuck, mover.support.face);
}

}  // namespace slipface
