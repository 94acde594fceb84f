#pragma once

#include "slipface/scenes/demo.h"

namespace slipface {

Demo demo_static_friction();
Demo demo_ground_velocity();
Demo demo_straight_ahead();
Demo demo_keep_energy();
Demo demo_push_out();
Demo demo_nudge();
Demo demo_step_up();
Demo demo_heightfield();
Demo demo_sectors();
Demo demo_bounce();
Demo demo_snap_down();
Demo demo_seam_filter();
Demo demo_coyote();
Demo demo_jump_buffer();
Demo demo_variable_jump();
Demo demo_air_control();
Demo demo_platforms();
Demo demo_turntable();
Demo demo_sticky();
Demo demo_surface_types();

// Builds a demo from a level, the player's start, the inputs ("60 wish 0,-1" lines of a tape) and a camera.
Demo demo_of(Level level, const Vec3& spawn, const MovementSettings& on, const char* inputs, const Vec3& eye,
             const Vec3& target);

// Plain ground in another colour, to make parts visible: it applies to faces of a material "NAME__name".
SurfaceType painted(const char* name, const std::array<float, 3>& color);

}  // namespace slipface
