// Problem: a half-pipe is made of flat faces, and sliding projects the velocity at each of them, so speed is
// lost where a round pipe would take none. Hack (lecture, "Frictionless surfaces"): the direction of V - N
// (V.N), the length of V; only for glancing hits, N.V / |V| above keep_energy_limit, because a head-on hit is
// no approximation of a curve.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

Vec3 redirected(const Vec3& v, const Vec3& normal) {
    return direction_of(slide_along(v, normal)) * v.norm();
}

}  // namespace

std::optional<Deflection> keep_energy(Mover& mover, const Hit& hit) {
    if (!hit.surface.keeps_energy) return std::nullopt;
    const Vec3& normal = hit.contact.normal;
    const double limit = mover.settings.keep_energy_limit;
    // One part of a split move says nothing about the direction of the whole; the velocity does.
    const Vec3& judged = hit.pass == Pass::slide ? hit.remainder : mover.velocity;
    const double cosine = normal.dot(direction_of(judged));
    const auto say = [&](Decision kind) {
        decide(mover, kind, {.value = -cosine, .limit = -limit}, hit.contact.face);
    };
    if (!mover.settings.keep_energy) {
        say(Decision::energy_off);
        return std::nullopt;
    }
    // A pipe of six faces turns by the default limit exactly; normals of float corners are off by 1e-7.
    constexpr double rounding = 1e-6;
    if (!(cosine > limit - rounding)) {
        say(Decision::energy_head_on);
        return std::nullopt;
    }
    say(Decision::energy_kept);
    mover.kept_energy = true;
    return Deflection{.rule = Rule::keep_energy,
                      .remainder = redirected(hit.remainder, normal),
                      .velocity = redirected(mover.velocity, normal),
                      .plane = normal};
}

// The hack keeps the length of a velocity to which this step's gravity was already added, though the contact
// may have come before gravity did that work, and a push that restores the skin lifts the player a little.
// Kept, both would be energy from nothing, so the speed is held to what the height gained or lost in this
// step allows.
void cap_energy(Mover& mover, const Vec3& from, const Vec3& driven_velocity) {
    const double climbed = mover.position.y() - from.y();
    const double allowed =
        std::sqrt(std::max(0.0, driven_velocity.squaredNorm() - 2.0 * mover.settings.gravity * climbed));
    const double speed = mover.velocity.norm();
    const bool capped = speed > allowed;
    if (mover.kept_energy) {
        decide(mover, capped ? Decision::energy_capped : Decision::energy_within,
               {.value = speed, .limit = allowed}, mover.support.face);
    }
    if (capped) mover.velocity *= allowed / speed;
}

}  // namespace slipface
