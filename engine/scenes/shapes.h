// Polygons for the demos.
#pragma once

#include <string>

#include "slipface/level/level.h"
#include "slipface/mesh/build.h"

namespace slipface {

// Materials are named after what they are made of; "__ice" at the end makes a surface of that type.
class Shapes {
  public:
    Shapes() { soup_.face_first_corner = {0}; }
    Shapes& group(const std::string& name);
    Shapes& material(const std::string& name);
    // Counter-clockwise seen from the front.
    Shapes& polygon(const std::vector<Vec3>& corners);
    Shapes& box(const Vec3& low, const Vec3& high);
    // Level ground, cut into tiles of about `tile` metres.
    Shapes& floor(const Vec3& low, const Vec3& high_xz, double tile);
    // A wedge that rises along -Z from `low.y` to `high_y` over [low.z, far_z].
    Shapes& ramp(const Vec3& low, double width, double length, double rise);
    // Steps that rise along -Z.
    Shapes& stairs(const Vec3& foot, double width, int steps, double rise, double run);

    Level level() const;

  private:
    PolygonSoup soup_;
    std::uint32_t material_ = 0, group_ = 0;
};

}  // namespace slipface
