// Renders the scenes of a suite.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "goldens/coverage.h"
#include "goldens/suite.h"
#include "slipface/render/gl_context.h"
#include "snapshots/input_book.h"

namespace slipface {

// Replaces "demo:*" by one scene per demo and state, and each scene with `cameras` or frames by one scene
// each. Reads levels and runs tapes only for "bookmarks" and "contacts". Error: two scenes of one name.
Result<std::vector<Scene>> expand_suite(const std::vector<Scene>& scenes);

// Renders scenes. Levels stay loaded and uploaded from one scene to the next. `context` and `book` must
// outlive it.
class SceneStage {
  public:
    SceneStage(OffscreenContext& context, InputBook& book);
    ~SceneStage();

    // The scene's image and numbers. Errors name the scene: in its level, its tape or its camera.
    Result<Rendering> render(const Scene& scene);
    double drawing_s() const;                               // seconds spent drawing so far
    const Coverage& coverage() const { return coverage_; }  // of all that was rendered

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    Coverage coverage_;
};

// The inputs of a scene: its level and its tape, by their names in the book, which learns them.
std::vector<std::string> scene_inputs(const Scene& scene, InputBook& book);
// The "inputs" section of the numbers, JSON: each name with a hash of its files' bytes.
std::string inputs_json(const std::vector<std::string>& inputs, InputBook& book);

// The part of a row that says how its image is compared.
void add_comparison(Numbers& row, const Scene& scene);
// A scene (cameras expanded) as a snapshot. `book` must outlive it.
Snapshot scene_snapshot(const Scene& scene, std::function<Result<Rendering>()> render, InputBook& book);

// Backend, renderer, OpenGL version and processor features: the "renderer" section of the numbers, JSON.
std::string renderer_fingerprint(const OffscreenContext& context);

}  // namespace slipface
