// Small images of levels that are not open, for the welcome screen. A thread reads them one after the other;
// the window's context draws each once and stores it.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "panels/panels.h"
#include "slipface/render/level_renderer.h"

namespace slipface {

class LevelThumbnails {
  public:
    LevelThumbnails(GlTable gl, const Session& session);

    struct Shown {
        unsigned texture = 0;  // rows from the bottom; 0: there is no image yet
        std::string facts;     // "6456 faces", or why there is no image
    };
    // The view from the level's first camera as an image of that many pixels, which draw() makes.
    Shown show(const std::filesystem::path& file, int width, int height);

    std::uint64_t hash() const { return images_; }  // of the images that are ready
    void begin_frame() { requested_ = false; }
    // Something new is there for the next frame. Valid if show() was called in this frame.
    bool ready() const { return requested_ && job_ && job_->ready(); }
    void draw();

  private:
    struct Picture {
        std::string facts;
        std::optional<Level> level;  // read but not drawn yet
        std::unique_ptr<Framebuffer> target;
    };
    void take(Picture& image, Result<LoadedLevel> loaded, int width, int height);

    GlTable gl_;
    const Session& session_;
    std::map<std::filesystem::path, Picture> pictures_;
    std::filesystem::path reading_;
    std::unique_ptr<Background<Result<LoadedLevel>>> job_;
    bool requested_ = false;
    std::uint64_t images_ = 0;
};

}  // namespace slipface
