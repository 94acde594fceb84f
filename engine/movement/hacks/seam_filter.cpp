// Problem: a player that is slightly inside a floor is stopped by the invisible edges of its triangles.
// Hack: where a triangle at the touched edge or corner rises above the contact plane, a player outside could
// not have touched that edge: it lies inside a flat or concave surface. Then the face's normal counts.
//
// A player outside never needs it: all triangles of a flat or concave surface lie behind the plane of its
// first contact. It helps a player that began inside: moved walls, bad spawns, geometry changed by an editor.
#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

// Radius within which triangles meet at a point, relative to the coordinates' own rounding as floats.
constexpr double meeting = 1e-4;
// Rising above the contact plane by less than this slope is rounding.
constexpr double rounding = 1e-5;

double rise_above(const std::array<Vec3, 3>& corners, const Vec3& point, const Vec3& normal) {
    double steepest = 0.0;
    for (const Vec3& corner : corners) {
        const Vec3 offset = corner - point;
        const double length = offset.norm();
        if (length > 2.0 * meeting) steepest = std::max(steepest, offset.dot(normal) / length);
    }
    return steepest;
}

}  // namespace

double filter_seam(const Mover& mover, const Vec3& centre, std::uint32_t platform, Contact& contact) {
    if (!mover.settings.seam_filter) {
        decide(mover, Decision::seam_off, contact.face);
        return 0.0;
    }
    const SeenWorld world = world_of(mover, platform);
    std::array<Overlap, 16> around;
    const Vec3 ball = Vec3::Constant(meeting);
    const std::size_t count = std::min(find_overlaps(world, ball, contact.point, around), around.size());
    Vec3 normal = Vec3::Zero();
    double alignment = 0.0;
    double rise = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double above = rise_above(world.triangle(around[i].triangle), contact.point, contact.normal);
        if (above <= rounding) continue;
        Vec3 face = world.triangle_normal(around[i].triangle);
        if (face.dot(centre - contact.point) < 0.0) face = -face;
        // Of several the one nearest to the contact's own normal.
        if (face.dot(contact.normal) <= alignment) continue;
        alignment = face.dot(contact.normal);
        normal = face;
        rise = above;
    }
    if (normal.isZero(0.0)) {
        decide(mover, Decision::seam_stands_out, contact.face);
        return 0.0;
    }
    decide(mover, Decision::seam_filtered, {.value = rise}, contact.face);
    contact.normal = normal;
    const double extent = mover.settings.radii.cwiseProduct(normal).norm();
    return std::max(0.0, extent - normal.dot(centre - contact.point));
}

}  // namespace slipface
