// How well the ground holds: a surface's friction f, 1 on plain ground.
//
// Walking accelerates and brakes by f times ground_acceleration. At f >= 1 a player never slides down a slope
// it can stand on. Below 1 the fraction 1 - f of gravity along the slope pulls, and the acceleration that the
// stick did not use works against it. So f = 0 slides like a sledge, and the player stands still where (1 -
// f) g sin a < f ground_acceleration.
#include <algorithm>

#include "mover.h"

namespace slipface {

double friction_of(const SurfaceType& surface) {
    return surface.friction >= 0.0 ? std::min(surface.friction, max_friction) : 0.0;
}

void pull_down_slope(Mover& mover, double friction, double spare) {
    if (!(friction < 1.0)) return;
    const double gravity = (1.0 - friction) * mover.settings.gravity;
    const Vec3 pull = horizontal(slide_along(Vec3(0.0, -gravity, 0.0), mover.state.ground_normal)) * mover.dt;
    const double gained = pull.norm();
    if (!(gained > 0.0)) return;
    const Quantity quantity{.value = gained, .limit = spare};
    if (gained <= spare) {
        decide(mover, Decision::friction_held, quantity, mover.state.ground_face);
        return;
    }
    mover.velocity += pull * ((gained - spare) / gained);
    decide(mover, Decision::friction_slid, quantity, mover.state.ground_face);
}

double kept_by_friction(const Mover& mover, const Hit& hit, double along, double rebound) {
    const double friction = friction_of(hit.surface);
    if (!(friction > 1.0) || !(along > 0.0)) return 1.0;
    const double lost = std::min((1.0 - 1.0 / friction) * along, (friction - 1.0) * rebound);
    decide(mover, Decision::bounce_scraped, {.value = lost}, hit.contact.face);
    return 1.0 - lost / along;
}

}  // namespace slipface
