// The narrow phase of rays: one triangle against a ray, in double. ray_triangle_impl.h computes it, and
// kernels.h provides it for each instruction set. Pure, like sphere_triangle.h.
#pragma once

#include "queries/leaf_triangle.h"

namespace slipface::detail {

// A ray whose direction is sheared onto one axis (S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle
// Intersection", 2013). The sheared coordinates of a corner depend on the corner alone, and an edge function
// changes exactly its sign with the direction of the edge. So neighbours agree about a ray through their
// border; zero counts as inside for both.
struct ShearedRay {
    int kx, ky, kz;
    double sx, sy, sz;
    double origin[3];
};

struct RayTouch {
    double t;
    V3 weights;  // barycentric
};

}  // namespace slipface::detail
