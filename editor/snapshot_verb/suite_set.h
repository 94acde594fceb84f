// Everything that can be rendered by name: scenes of suites, scenes of levels named on the command line, and
// the editor's screens.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "goldens/golden.h"
#include "slipface/render/gl_context.h"
#include "snapshots/other_programs.h"
#include "snapshots/scene_stage.h"

namespace slipface {

struct SuiteArguments {
    std::string goldens = "screenshots";
    std::vector<std::string> suites;  // none: GOLDENS/scenes.json and GOLDENS/editor/*.script
    std::vector<std::string> levels;  // instead of suites: the cameras of these levels, from `cameras`
    std::vector<std::string> cameras{"auto:iso4", "auto:map", "bookmarks"};
    std::string size = "960x540", style = "textured overlay", tape;
    std::string gl = "auto";  // "osmesa", "egl"

    std::vector<std::string> as_command_line() const;  // the arguments for a worker process
};

struct SuiteSet {
    std::vector<Scene> scenes;  // cameras expanded
    std::vector<Snapshot> screens;
    std::shared_ptr<InputBook> book;                         // what they are made from, by meaning
    std::map<std::string, std::vector<std::string>> inputs;  // of each scene and screen
    std::vector<std::string> names;                          // scenes first, grouped by level; inputs last
    // What they are made from: suites, scripts, levels with their textures, tapes. Sorted.
    std::vector<std::filesystem::path> files;
};

// True if a pattern matches the name, or if there are no patterns.
bool is_wanted(const std::vector<std::string>& patterns, const std::string& name);

// Reads suites and scripts; makes no context. Errors: a missing folder, an invalid suite.
Result<SuiteSet> load_suite_set(const SuiteArguments& arguments);

// Makes snapshots by name. All scenes use one context and one copy of each level, all images of a command one
// run of it.
class Studio {
  public:
    explicit Studio(SuiteSet set) : set_(std::move(set)) {}

    const SuiteSet& set() const { return set_; }
    Result<Snapshot> find(const std::string& name);
    double drawing_s() const { return stage_ ? stage_->drawing_s() : 0.0; }
    Coverage new_coverage();  // since the last call
    // "OSMesa, llvmpipe (...), 4.5 (Core Profile) Mesa 22.3.6"; empty before the first scene.
    const std::string& renderer() const { return renderer_; }

  private:
    SuiteSet set_;
    std::unique_ptr<OffscreenContext> context_;
    std::unique_ptr<SceneStage> stage_;
    ProgramRuns runs_;
    Coverage told_;
    std::string renderer_;
};

std::string renderer_line(const OffscreenContext& context);

}  // namespace slipface
