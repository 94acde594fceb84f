// Surfaces that move under the player: conveyors by their velocity, turntables by turning about the vertical
// through their centre. The player is moved first and walks from there; a jump or a step off takes the
// surface's velocity along.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

// Turned by `angle` about +Y, through the half-angle tangent: the result is a rotation to rounding whatever
// the error of the tangent, so nobody spirals off a turntable. The series is exact to 1e-15 within a quarter.
Vec3 turned(const Vec3& r, double angle) {
    constexpr double longest = 0.5;
    const int parts = static_cast<int>(std::ceil(std::abs(angle) / longest));
    const double half = 0.5 * angle / std::max(parts, 1);
    const double q = half * half;
    const double tangent =
        half *
        (1.0 + q * (1.0 / 3 + q * (2.0 / 15 + q * (17.0 / 315 + q * (62.0 / 2835 + q * 1382.0 / 155925)))));
    const double scale = 1.0 / (1.0 + tangent * tangent);
    const double cosine = (1.0 - tangent * tangent) * scale;
    const double sine = 2.0 * tangent * scale;
    Vec3 result = r;
    for (int i = 0; i < parts; ++i) {
        result = Vec3(result.x() * cosine + result.z() * sine, result.y(),
                      result.z() * cosine - result.x() * sine);
    }
    return result;
}

}  // namespace

Vec3 carry_velocity(const Mover& mover, const SurfaceType& support) {
    const Vec3 r = mover.position - support.spin_centre;
    return support.velocity + support.angular_velocity * Vec3(r.z(), 0.0, -r.x());
}

void carry(Mover& mover, const SurfaceType& support) {
    const double angle = support.angular_velocity * mover.dt;
    constexpr double most = 1e3;  // radians a step; no table turns that fast, and it bounds the work
    if (!(std::abs(angle) <= most) || !support.velocity.allFinite()) return;
    const Vec3 r = horizontal(mover.position - support.spin_centre);
    const Vec3 move = turned(r, angle) - r + support.velocity * mover.dt;
    if (move.isZero(0.0)) return;
    decide(mover, "surface_types", true, "carried, m", move.norm(), 0.0, "carried by the surface",
           mover.support_face);
    mover.on_ladder = true;  // being carried past a ladder is no wish to climb it
    collide_and_slide(mover, move.y() == 0.0 ? Pass::horizontal : Pass::slide, move);
    mover.on_ladder = false;
    mover.grounded = false;
    mover.kept_energy = false;
    mover.bounced = false;
}

}  // namespace slipface
