// Sticky surfaces hold whoever touches them, on walls and ceilings too, until a jump, which leaves along the
// normal.
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
    mover.support_normal = hit.contact.normal;
    mover.support_face = hit.contact.face;
    mover.support_surface = hit.contact.surface;
    mover.support_platform = hit.platform;
    decide(mover, Decision::stuck, hit.contact.face);
    return Deflection{.rule = Rule::stick, .plane = hit.contact.normal};
}

void hold(Mover& mover, const PlayerState& state) {
    mover.stuck = true;
    mover.velocity = Vec3::Zero();
    mover.support_normal = state.ground_normal;
    mover.support_face = state.ground_face;
    mover.support_surface = state.ground_surface;
    mover.support_platform = state.ground_platform;
    mover.hazard = mover.hazard || support_of(mover, state).hazardous;
    decide(mover, Decision::still_stuck, state.ground_face);
}

}  // namespace slipface
