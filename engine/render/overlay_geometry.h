// The lines and meshes that overlay shapes are drawn with.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gl_util.h"
#include "slipface/render/overlay.h"

namespace slipface {

LineInstance line_instance(const Vec3& a, const Vec3& b, const Color& color, float width, LineKind kind);

// Appends the outline of an ellipsoid as seen by the camera: its silhouette, and three great circles whose
// far halves are fainter. Positions are relative to `origin`.
void append_ellipsoid_outline(const Overlay::Ellipsoid& ellipsoid, const Camera& camera, const Vec3& origin,
                              std::vector<LineInstance>& lines);

struct SphereMesh {
    std::vector<Vec3f> positions;
    std::vector<std::uint16_t> indices;  // counter-clockwise from outside
};
SphereMesh unit_sphere(int rings, int sectors);

}  // namespace slipface
