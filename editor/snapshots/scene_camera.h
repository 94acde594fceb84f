// The camera that a scene names.
#pragma once

#include "snapshots/scene_movement.h"

namespace slipface {

// Errors name the scene's location and list the level's cameras.
Result<Camera> scene_camera(const Scene& scene, const StagedLevel& staged, const SceneMovement& story);

// Moves the near plane as far away, and the far plane as near, as the visible geometry allows. This gives the
// finest depth resolution, so that far faces do not flicker through each other on another processor.
void fit_depth_range(Camera& camera, const StagedLevel& staged, const Overlay& overlay, double aspect);

// Adds a grid in metres over a level seen from above, and its scale.
void draw_grid(Overlay& overlay, const Aabb& bounds);

}  // namespace slipface
