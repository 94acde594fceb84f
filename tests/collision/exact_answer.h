// Whether an answer of the engine is the exact one but for rounding, without asking for a time where the time
// hangs on the last bit.
#pragma once

#include "closed_form_oracle.h"
#include "slipface/collision/collision_world.h"

namespace slipface::oracle {

// What the engine's distances in radii may be off by: it subtracts the start first, so that every number is
// relative to the reach, and takes cross products with compensation where a triangle is sharp. Measured over
// all families: 1.1 roundings of 2^-53 for a distance, 1.3 for a normal.
inline double engine_rounding(double reach) {
    return 4 * 0x1p-53 * reach;
}

// A sphere larger by `margin` touches no later than t, a smaller one no earlier. It says the same of a graze
// as of a blow. Without a touch, the smaller one has none within the move.
template <class Exact>
bool is_answer(const Exact& exact, const std::optional<Contact>& contact, double margin) {
    const Quad smaller = exact.first_touch(Quad(1) - margin);
    if (!contact) return smaller > 1;
    return exact.first_touch(Quad(1) + margin) <= contact->t && contact->t <= smaller;
}

// How far a world normal is from that of the exact nearest point at time t; sphere space, radians.
template <class Exact>
double normal_error(const Exact& exact, const Vec3& radii, const Vec3& normal, double t) {
    return (normal.cwiseProduct(radii).normalized() - vec(exact.gap(t)).normalized()).norm();
}

}  // namespace slipface::oracle
