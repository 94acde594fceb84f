// Renders the scenes of a suite, and explains why one does not look like its golden.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "goldens/suite.h"
#include "slipface/render/gl_context.h"

namespace slipface {

// Replaces "demo:*" by one scene per demo and state, and each scene with `cameras` by one scene per camera.
// Reads levels and runs tapes only for "bookmarks" and "contacts". Error: two scenes of one name.
Result<std::vector<Scene>> expand_suite(const std::vector<Scene>& scenes);

// Renders scenes. Levels stay loaded and uploaded from one scene to the next. `context` must outlive it.
class SceneStage {
  public:
    explicit SceneStage(OffscreenContext& context);
    ~SceneStage();

    // The scene's image and numbers. Errors name the scene: in its level, its tape or its camera.
    Result<Rendering> render(const Scene& scene);
    // Why `scene` does not look like its golden: the faces, the setting, the tick.
    std::vector<Finding> explain(const Scene& scene, const ExplainRequest& request);
    // The digest of the scene's level, to attach to its golden; empty for a level that is too large.
    Result<Attachment> digest(const Scene& scene);
    double drawing_s() const;  // seconds spent drawing so far

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// The scenes (cameras expanded) as snapshots.
std::vector<Snapshot> scene_snapshots(const std::vector<Scene>& scenes,
                                      const std::shared_ptr<SceneStage>& stage);

// Backend, renderer, OpenGL version and processor features: the "renderer" section of the numbers, JSON.
std::string renderer_fingerprint(const OffscreenContext& context);

}  // namespace slipface
