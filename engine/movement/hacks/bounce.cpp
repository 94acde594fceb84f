// Bounce (lecture, "Bouncing"): the velocity along the surface stays, the velocity into it is returned times
// the restitution e: V - (1+e) N (V.N). Friction f above 1 reduces the velocity along the surface as
// Coulomb's law does, by at most (f-1) times the rebound speed and by at most the fraction 1 - 1/f. So a weak
// rebound becomes a landing, which the ground's braking handles.
//
// The contact lies within the step, so the impact speed is neither the one before the step's gravity nor the
// one after it. With u the speed along N and constant acceleration, u*u changes linearly with the distance:
// at the fraction s of it, u*u = u0*u0 + s (u1*u1 - u0*u0). Gravity slows the rebound during the rest of the
// step. Without this the height of a bounce depends on where in a tick it lands.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

std::optional<Deflection> bounce(Mover& mover, const Hit& hit) {
    const double restitution = hit.surface.restitution;
    if (!(restitution > 0.0)) return std::nullopt;
    const Vec3& normal = hit.contact.normal;
    const auto refuse = [&](Decision why, const Quantity& quantity = {}) {
        decide(mover, why, quantity, hit.contact.face);
        return std::nullopt;
    };
    if (!mover.settings.bounce) return refuse(Decision::bounce_off);
    if (hit.pass == Pass::horizontal && hit.walkable && mover.was_grounded) {
        return refuse(Decision::bounce_walked);
    }
    const double before = mover.velocity_before.dot(normal);
    const double after = mover.velocity.dot(normal);
    const double impact =
        std::sqrt(std::max(0.0, before * before + hit.done * (after * after - before * before)));
    const double rebound = restitution * impact;
    const double rest = mover.settings.gravity * mover.dt;
    if (!(after < 0.0) || rebound <= rest) {
        return refuse(Decision::bounce_too_slow, {.value = rebound, .limit = rest});
    }

    const double into = hit.remainder.dot(normal);
    const double risen = -restitution * into;
    const double slowing = std::max(0.0, before - after) / mover.dt;
    const double leaving = std::sqrt(std::max(0.0, rebound * rebound - 2.0 * slowing * risen));
    const Vec3 along = mover.velocity - normal * after;
    const double kept = kept_by_friction(mover, hit, along.norm(), rebound);
    mover.bounced = true;
    mover.grounded = false;
    decide(mover, Decision::bounced, {.value = rebound}, hit.contact.face);
    return Deflection{.rule = Rule::bounce,
                      .remainder = kept * (hit.remainder - normal * into) + normal * risen,
                      .velocity = kept * along + normal * leaving,
                      .plane = normal};
}

}  // namespace slipface
