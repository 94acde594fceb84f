// Problem: gravity makes a player who stands on a slope creep down it.
// Hack (lecture, "Sliding while standing"): the move is split; the horizontal part slides, the vertical part
// gets one sweep, and what it stands on holds. Ground steeper than max_slope lets the vertical part slide
// after all.
#include "mover.h"

namespace slipface {

std::optional<Turn> hold_by_static_friction(Mover& mover, const Hit& hit) {
    const Contact& contact = hit.contact;
    if (hit.pass != Pass::vertical) return std::nullopt;
    const double limit = walkable_limit(mover, hit.surface);
    const auto refuse = [&](const char* why) {
        decide(mover, "static_friction", false, "N.y", contact.normal.y(), limit, why, contact.face);
        return std::nullopt;
    };
    if (!hit.walkable) return refuse("refused: steeper than the maximum slope, slides");
    if (hit.surface.keeps_energy) return refuse("refused: the surface keeps energy, slides");
    if (hit.surface.restitution > 0.0) {
        // A bounce too small to be seen comes to rest.
        if (std::optional<Turn> turn = bounce(mover, hit)) return turn;
    }
    decide(mover, "static_friction", true, "N.y", contact.normal.y(), limit, "grounded", contact.face);
    return Turn{.rule = Rule::stop, .velocity = horizontal(mover.velocity), .plane = contact.normal};
}

}  // namespace slipface
