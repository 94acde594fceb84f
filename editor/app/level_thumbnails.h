// Small pictures of levels that are not open, for the welcome screen. Read beside the window one after the
// other, drawn once by the window's own context, and kept.
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
        unsigned texture = 0;  // rows from the bottom; 0: there is no picture yet
        std::string facts;     // "6456 faces"; why there is no picture
    };
    // Seen from the level's first camera, in a picture of that many pixels; draw() makes it.
    Shown show(const std::filesystem::path& file, int width, int height);

    std::uint64_t hash() const { return images_; }  // of what was ready to be shown
    void begin_frame() { requested_ = false; }
    // show(), which was called in this frame, has something new for the next.
    bool ready() const { return requested_ && job_ && job_->ready(); }
    void draw();

  private:
    struct Picture {
        std::string facts;
        std::optional<Level> level;  // read and not drawn yet
        std::unique_ptr<Framebuffer> target;
    };
    void take(Picture& image, Result<LoadedLevel> loaded, int width, int height);

    GlTable gl_;
    const Session& session_;
    std::map<std::filesystem::path, Picture> kept_;
    std::filesystem::path reading_;
    std::unique_ptr<Background<Result<LoadedLevel>>> job_;
    bool requested_ = false;
    std::uint64_t images_ = 0;
};

}  // namespace slipface
