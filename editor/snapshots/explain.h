// Explains why a scene does not look like its golden.
#pragma once

#include <functional>

#include "goldens/level_changes.h"
#include "snapshots/scene_camera.h"
#include "snapshots/scene_movement.h"

namespace slipface {

// One side of a comparison, the golden's or today's. Null: not known.
struct SceneSide {
    const StagedLevel* staged = nullptr;
    const SceneMovement* story = nullptr;
    Camera camera;
};

struct SceneComparison {
    const Scene& scene;
    const ExplainRequest& request;
    SceneSide before, after;  // before.staged is null when there is no digest
    // An image of a side, with or without what is drawn over the level and its baked light; empty if it
    // cannot be drawn.
    std::function<Image(const SceneSide&, bool with_overlay, bool lit)> draw;
};

// Causes before their effects: the level, settings and tape, the movement that they change, the view that
// follows it. The drawing code is a cause only if nothing else differs.
std::vector<Finding> explain_scene(const SceneComparison& comparison);

// The tape in the numbers of a golden, if they hold it.
std::optional<Tape> recorded_tape(const Numbers& numbers);

// Explains from the numbers alone.
std::vector<Finding> explain_numbers(const ExplainRequest& request, std::size_t changed_pixels);

}  // namespace slipface
