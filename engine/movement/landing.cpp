// Landing: where a step up and a snap to the floor end.
#include <algorithm>

#include "mover.h"

namespace slipface {

std::optional<Refusal> land(Mover& mover, const Swept& swept, const LandingRules& rules) {
    const Contact& contact = *swept.contact;
    const SurfaceType& surface = surface_of(mover, contact.surface);
    if (sticks(mover, surface) || restitution_of(mover, surface) > 0.0 ||
        (surface.keeps_energy && !rules.on_ice)) {
        return Refusal{rules.own_response};
    }
    const Vec3 above = mover.position;
    mover.position = swept.reached;
    if (!is_walkable(mover, contact.normal, surface) && !on_rim(mover, contact)) {
        mover.position = above;
        return Refusal{rules.too_steep,
                       {.value = contact.normal.y(), .limit = walkable_limit(mover, surface)}};
    }
    stand_on(mover, contact, swept.platform);
    return std::nullopt;
}

void stand_on(Mover& mover, const Contact& contact, std::uint32_t platform) {
    const SurfaceType& surface = surface_of(mover, contact.surface);
    mover.grounded = true;
    mover.hazard = mover.hazard || surface.hazardous;
    // A rim is stood on as if it were level.
    const bool flat = is_walkable(mover, contact.normal, surface);
    mover.support = {flat ? contact.normal : Vec3(Vec3::UnitY()), contact.face, contact.surface, platform};
    mover.support_rise = std::max(0.0, contact.point.y() - (mover.position.y() - mover.settings.radii.y()));
}

}  // namespace slipface
