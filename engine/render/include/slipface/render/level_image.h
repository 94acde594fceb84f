// A level as a picture, in one call; or as many pictures, sent to the graphics card once.
#pragma once

#include <memory>

#include "slipface/level/level.h"
#include "slipface/render/camera.h"
#include "slipface/render/gl_context.h"
#include "slipface/render/level_renderer.h"
#include "slipface/render/overlay.h"

namespace slipface {

// A level that stays on the graphics card while pictures of it are made. Use it, and destroy it, while
// `context` lives.
class LevelPainter {
  public:
    // Textures are taken from the mesh file's folder; `warnings`, if given, receives those that could not be
    // used.
    static Result<std::unique_ptr<LevelPainter>> make(OffscreenContext& context, const Level& level,
                                                      Warnings* warnings = nullptr);
    ~LevelPainter();

    // As render_level_picture.
    Result<Image> image(const Camera& camera, int width, int height, const LevelStyle& style,
                        const Overlay* overlay = nullptr);
    // Seconds spent drawing, until the pixels were there: what pictures cost at least.
    double drawing_s() const;

  private:
    LevelPainter();
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// `level` with its resolved surface types as `camera` sees it, width x height pixels
// (1..max_framebuffer_side). Textures are taken from the mesh file's folder; `warnings`, if given, receives
// those that could not be used. `overlay` may be null. Errors: a size out of range, a driver that refuses a
// shader or reports an error.
Result<Image> render_level_image(OffscreenContext& context, const Level& level, const Camera& camera,
                                 int width, int height, const LevelStyle& style,
                                 const Overlay* overlay = nullptr, Warnings* warnings = nullptr);

}  // namespace slipface
