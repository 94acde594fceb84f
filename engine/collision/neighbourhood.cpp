#include "slipface/collision/neighbourhood.h"

#include "near.h"

namespace slipface {

using namespace detail;

namespace {

// Of what floats and the narrow phase round off, in radii; ways are longer by it.
constexpr double way_slack = 2e-5;
// In radii. Further away floats say too little.
constexpr double most_reach = 1e3;

}  // namespace

Neighbourhood::Neighbourhood(const CollisionWorld& world, const Vec3& radii, const Vec3& centre, double reach)
    : world_(&world) {
    const CollisionWorld::Impl& impl = world.impl();
    const V3 at = v3(centre), axes = v3(radii), still{0.0, 0.0, 0.0};
    if (!(reach >= 0.0 && reach <= most_reach) || !in_float_range(axes, at, still, impl.extent)) return;
    const double coordinate = larger(largest(at) + reach * largest(axes), impl.extent.reach);
    const EllipsoidQuery body = ellipsoid_query(at, axes, still);
    const PointBoxes boxes = point_boxes(body, coordinate);
    if (!boxes.sphere.usable) return;
    if (!impl.bvh.nodes.empty() &&
        !kernels().near(impl.bvh.view(), boxes, round_up(reach + way_slack), triangles_)) {
        triangles_.count = 0;
        return;
    }
    centre_ = centre;
    radii_ = radii;
    inverse_ = vec(body.inverse);
    least_radius_ = larger(2.0 * coordinate / filter_range, 1.0 / float_range);
    reach_ = reach;
}

float Neighbourhood::clear_limit(const Vec3& radii, const Vec3& from, const Vec3& move) const {
    constexpr float out = std::numeric_limits<float>::infinity();
    if (reach_ < 0.0) return out;
    double size = 1.0;
    if (radii != radii_) {
        if (!(least(v3(radii)) > least_radius_)) return out;
        size = largest(mul(v3(radii), v3(inverse_)));
    }
    // A point that is touched is at most `size` away from where the centre is then; the centre is never
    // further off than at one of its ends.
    const Three inverse(v3(inverse_));
    const Three first = (Three(v3(from)) - Three(v3(centre_))) * inverse;
    const Three last = first + Three(v3(move)) * inverse;
    const double away = std::sqrt(larger((first * first).sum(), (last * last).sum()));
    const double way = (away + size) * (1.0 + way_slack) - 1.0;
    return way <= reach_ ? round_up(way + way_slack) : out;
}

}  // namespace slipface
