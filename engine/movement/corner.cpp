// Corners: one surface deflects the player into another.
//
// Deflecting at each contact alone sends the player to and fro between two walls; each return costs an
// iteration and shows as jitter. So a deflection that leads back into an earlier plane of the same pass
// follows the crease of both planes instead, and a crease that leads into a third plane ends the move.
#include "mover.h"

namespace slipface {

namespace {

// Leading into a plane by less than this fraction is rounding; the skin absorbs it.
constexpr double grazing = 1e-6;
// Square of the sine below which two planes have no crease.
constexpr double parallel = 1e-12;

template <class Counts>
bool leads_into(const Corner& corner, const Vec3& v, const Counts& counts) {
    const double limit = -grazing * v.norm();
    for (int i = 0; i < corner.count; ++i) {
        if (counts(i) && v.dot(corner.planes[static_cast<std::size_t>(i)]) < limit) return true;
    }
    return false;
}

// `deflected` made free of all planes: itself, `v` along a crease of the latest plane, or zero.
template <class Counts>
Vec3 freed(const Corner& corner, const Vec3& v, const Vec3& deflected, const Vec3& plane,
           const Counts& counts, Rule& rule) {
    if (!leads_into(corner, deflected, counts)) return deflected;
    rule = Rule::crease;
    const double limit = -grazing * deflected.norm();
    for (int i = 0; i < corner.count; ++i) {
        const Vec3& earlier = corner.planes[static_cast<std::size_t>(i)];
        if (!counts(i) || deflected.dot(earlier) >= limit) continue;
        const Vec3 crease = plane.cross(earlier);
        const double square = crease.squaredNorm();
        if (square < parallel) continue;
        Vec3 along = crease * (crease.dot(v) / square);
        if (!leads_into(corner, along, counts)) return along;
    }
    rule = Rule::stop;
    return Vec3::Zero();
}

}  // namespace

void respect_corner(const Corner& corner, const Vec3& remainder, const Vec3& velocity,
                    Deflection& deflection) {
    if (corner.count == 0) return;
    deflection.remainder = freed(
        corner, remainder, deflection.remainder, deflection.plane, [](int) { return true; }, deflection.rule);
    if (!deflection.constrains_velocity) return;
    Rule ignored = deflection.rule;
    deflection.velocity = freed(
        corner, velocity, deflection.velocity, deflection.plane,
        [&](int i) { return corner.constrains_velocity[static_cast<std::size_t>(i)]; }, ignored);
}

}  // namespace slipface
