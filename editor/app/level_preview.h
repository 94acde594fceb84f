// A small image of a level that is not open, for the file browser. A thread reads the level; the window's
// context draws it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "panels/panels.h"
#include "slipface/render/level_renderer.h"

namespace slipface {

class LevelPreview {
  public:
    LevelPreview(GlTable gl, const Session& session);

    struct Shown {
        unsigned texture = 0;  // rows from the bottom; 0: there is no image
        std::string facts;  // "6456 faces, 12 painted", why there is no image, or that the file is being read
    };
    // The preview of `file` as an image of that many pixels, which draw() makes. Only the last file is
    // stored.
    Shown show(const std::filesystem::path& file, int width, int height);

    std::uint64_t hash() const { return wanted_ ? images_ : 0; }
    void begin_frame() { wanted_ = requested_ = false; }
    // Something new is there for the next frame. Valid if show() was called in this frame.
    bool ready() const { return requested_ && job_ && job_->ready(); }
    void draw();

  private:
    void take(Result<LoadedLevel> loaded);

    GlTable gl_;
    const Session& session_;
    std::filesystem::path file_;
    std::unique_ptr<Background<Result<LoadedLevel>>> job_;
    std::string facts_;
    std::optional<Camera> camera_;  // nothing: no image
    std::unique_ptr<LevelRenderer> renderer_;
    std::unique_ptr<Framebuffer> target_;
    bool requested_ = false, wanted_ = false, drawn_ = false;
    bool back_faces_ = true;
    std::uint64_t images_ = 0;
};

}  // namespace slipface
