// What a contact does: first what it means for the state, then how it turns the move.
#include "mover.h"

namespace slipface {

namespace {

using Response = std::optional<Deflection> (*)(Mover&, const Hit&);

// In the order in which they are asked. A new response is a file with one such function and one name here.
constexpr std::array<Response, 7> responses{stick,       grab_ladder,         hold_by_static_friction, bounce,
                                            keep_energy, slide_at_steep_wall, go_straight_ahead};

}  // namespace

void touch(Mover& mover, const Hit& hit) {
    note_contact(mover, hit.pass, hit.contact, hit.platform);
    if (hit.surface.hazardous && !mover.hazard) decide(mover, Decision::hazard_touched, hit.contact.face);
    mover.hazard = mover.hazard || hit.surface.hazardous;
    if (!mover.settings.surface_types && hit.contact.surface != default_surface) {
        decide(mover, Decision::surface_types_off, hit.contact.face);
    }
    // The horizontal part of a move meets ramps that the vertical part may then leave; only the latter knows
    // the ground.
    const bool ground = hit.walkable && hit.pass != Pass::horizontal;
    if (mover.grounded && !ground) return;
    if (ground) return stand_on(mover, hit.contact, hit.platform);
    mover.support = {hit.contact.normal, hit.contact.face, hit.contact.surface, hit.platform};
}

Deflection respond(Mover& mover, const Hit& hit) {
    for (const Response response : responses) {
        if (const std::optional<Deflection> deflection = response(mover, hit)) return *deflection;
    }
    const Vec3& normal = hit.contact.normal;
    return {.rule = Rule::slide,
            .remainder = slide_along(hit.remainder, normal),
            .velocity = slide_along(mover.velocity, normal),
            .plane = normal,
            .slides = true};
}

}  // namespace slipface
