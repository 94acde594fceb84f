// Problem: gravity makes a player who stands on a slope creep down it.
// Hack (lecture, "Sliding while standing"): the move is split; the horizontal part slides, the vertical part
// gets one sweep, and what it stands on holds. Ground steeper than max_slope lets the vertical part slide
// after all, unless two such faces wedge the player between them.
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

void hold_where_wedged(Mover& mover, double rise, double height) {
    // Without this there would be no jumping out of a ditch.
    const double dropped = height - mover.position.y();
    if (!(rise < 0.0) || mover.met_count < 2 || !(dropped < -0.01 * rise)) return;
    mover.grounded = true;
    mover.support.normal = Vec3::UnitY();
    mover.velocity.y() = 0.0;
    decide(mover, Decision::wedged, {.value = dropped}, mover.support.face);
}

void rest(Mover& mover, const Vec3& from) {
    // Rounding must not make an idle player creep.
    if (!mover.was_grounded || !mover.wish.isZero(0.0)) return;
    if ((mover.position - from).norm() <= 1e-3 * mover.settings.skin) mover.position = from;
}

}  // namespace slipface
