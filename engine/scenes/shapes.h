// Polygons for the demos.
#pragma once

#include <string>

#include "slipface/level/level.h"
#include "slipface/mesh/build.h"

namespace slipface {

// A material's name gives its colour ("stone", "brick", ...); "__ice" at its end makes a surface of that
// type.
class Shapes {
  public:
    Shapes() { soup_.face_first_corner = {0}; }
    Shapes& group(const std::string& name);
    Shapes& material(const std::string& name);
    // Counter-clockwise seen from the front.
    Shapes& polygon(const std::vector<Vec3>& corners);
    Shapes& box(const Vec3& low, const Vec3& high);
    // A horizontal floor at low.y, divided into tiles of about `tile` metres.
    Shapes& floor(const Vec3& low, const Vec3& high_xz, double tile);
    // A wedge on `low`, its lower left corner, that rises by `rise` along -Z over `length`.
    Shapes& ramp(const Vec3& low, double width, double length, double rise);
    // Steps that rise along -Z, each `rise` high and `run` long.
    Shapes& stairs(const Vec3& foot, double width, int steps, double rise, double run);

    Level level() const;

  private:
    PolygonSoup soup_;
    std::uint32_t material_ = 0, group_ = 0;
};

}  // namespace slipface
