// The result of a sweep.
#pragma once

#include "slipface/base/types.h"
#include "slipface/collision/feature.h"

namespace slipface {

// The first hit of a moving ellipsoid. All vectors are in world space.
struct Contact {
    double t = 1.0;  // fraction of the displacement covered at the hit, [0, 1]
    Vec3 normal =
        Vec3::Zero();  // unit; of the contact plane, which is tangent to the ellipsoid, towards its centre
    Vec3 point = Vec3::Zero();  // on the triangle
    TriangleId triangle = no_id;
    FaceId face = no_id;
    SurfaceId surface = default_surface;
    Feature feature = Feature::interior;
};

}  // namespace slipface
