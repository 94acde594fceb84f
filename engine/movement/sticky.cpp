// Sticky surfaces hold whoever touches them, on walls and ceilings too, until a jump, which leaves along the
// normal.
#include "mover.h"

namespace slipface {

std::optional<Turn> stick(Mover& mover, const Hit& hit) {
    if (!hit.surface.sticky) return std::nullopt;
    if (!mover.settings.stick) {
        decide(mover, "stick", false, "sticky", 1.0, 0.0, "switched off: does not stick", hit.contact.face);
        return std::nullopt;
    }
    mover.stuck = true;
    mover.grounded = false;
    mover.support_normal = hit.contact.normal;
    mover.support_face = hit.contact.face;
    mover.support_surface = hit.contact.surface;
    mover.support_platform = hit.platform;
    decide(mover, "stick", true, "sticky", 1.0, 0.0, "sticks until a jump", hit.contact.face);
    return Turn{.rule = Rule::stick, .plane = hit.contact.normal};
}

void hold(Mover& mover, const PlayerState& state) {
    mover.stuck = true;
    mover.velocity = Vec3::Zero();
    mover.support_normal = state.ground_normal;
    mover.support_face = state.ground_face;
    mover.support_surface = state.ground_surface;
    mover.support_platform = state.ground_platform;
    mover.hazard = mover.hazard || support_of(mover, state).hazardous;
    decide(mover, "stick", true, "sticky", 1.0, 0.0, "held until a jump", state.ground_face);
}

}  // namespace slipface
