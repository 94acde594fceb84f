// Problem: gravity makes a player who stands on a slope creep down it.
// Hack (lecture, "Sliding while standing"): the move is split; the horizontal part slides, the vertical part
// gets one sweep, and what it stands on holds. Ground steeper than max_slope lets the vertical part slide
// after all.
#include "mover.h"

namespace slipface {

std::optional<Deflection> hold_by_static_friction(Mover& mover, const Hit& hit) {
    const Contact& contact = hit.contact;
    if (hit.pass != Pass::vertical) return std::nullopt;
    const auto say = [&](Decision kind) {
        decide(mover, kind, {.value = contact.normal.y(), .limit = walkable_limit(mover, hit.surface)},
               contact.face);
    };
    if (!hit.walkable) {
        say(Decision::too_steep_to_stand);
        return std::nullopt;
    }
    if (hit.surface.keeps_energy) {
        decide(mover, Decision::no_hold_on_ice, contact.face);
        return std::nullopt;
    }
    if (hit.surface.restitution > 0.0) {
        // A bounce too small to be seen comes to rest.
        if (std::optional<Deflection> deflection = bounce(mover, hit)) return deflection;
    }
    say(Decision::stood);
    return Deflection{.rule = Rule::stop, .velocity = horizontal(mover.velocity), .plane = contact.normal};
}

}  // namespace slipface
