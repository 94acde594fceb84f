#pragma once

#include "slipface/scenes/demo.h"

namespace slipface {

inline constexpr double pi = 3.141592653589793;

// One row per demo, with all that it shows; demo_table() joins them.
std::span<const DemoInfo> lecture_demos();
std::span<const DemoInfo> ground_demos();
std::span<const DemoInfo> air_demos();
std::span<const DemoInfo> move_demos();

// Builds a demo from a level, the player's start, the inputs ("60 wish 0,-1" lines of a tape) and a camera.
Demo demo_of(Level level, const Vec3& spawn, const MovementSettings& on, const char* inputs, const Vec3& eye,
             const Vec3& target);

// Plain ground in another colour, to make parts visible: it applies to faces of a material "NAME__name".
SurfaceType painted(const char* name, const std::array<float, 3>& color);

// The height of the centre of a player who stands on level ground at `y`, m.
inline double standing_on_flat(const MovementSettings& s, double y) {
    return y + s.radii.y() + s.skin;
}

}  // namespace slipface
