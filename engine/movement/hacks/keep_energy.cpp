// Problem: a half-pipe is made of flat faces. Sliding projects the velocity at each of them and loses speed
// that a round pipe would preserve. Hack (lecture, "Frictionless surfaces"): the direction of V - N (V.N)
// with the length of V. Only for glancing hits, N.V / |V| above keep_energy_limit: a head-on hit does not
// approximate a curve.
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
    // One part of a split move does not have the direction of the whole; the velocity does.
    const Vec3& judged = hit.pass == Pass::slide ? hit.remainder : mover.velocity;
    const double cosine = normal.dot(direction_of(judged));
    const auto say = [&](Decision kind) {
        decide(mover, kind, {.value = -cosine, .limit = -limit}, hit.contact.face);
    };
    if (!mover.settings.keep_energy) {
        say(Decision::energy_off);
        return std::nullopt;
    }
    // A pipe of six faces deflects by exactly the default limit; normals of float corners are off by 1e-7.
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

// The hack preserves the length of a velocity that already includes this step's gravity, although the contact
// may have come before gravity did that work; and a push that restores the skin lifts the player a little.
// Both would be energy from nothing. So the speed is limited to what the height gained or lost in this step
// allows.
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
