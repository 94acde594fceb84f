// Renders a level to an image in one call, or to many images after one upload.
#pragma once

#include <memory>

#include "slipface/level/level.h"
#include "slipface/render/gl_context.h"
#include "slipface/render/level_renderer.h"
#include "slipface/render/overlay.h"
#include "slipface/view/camera.h"

namespace slipface {

// A level that stays on the graphics card for several images. Use and destroy it only while `context` lives.
class LevelPainter {
  public:
    // Uploads the level with the textures of the mesh file's folder; `warnings`, if given, receives those
    // that could not be used.
    static Result<std::unique_ptr<LevelPainter>> make(OffscreenContext& context, const Level& level,
                                                      Warnings* warnings = nullptr);
    ~LevelPainter();

    // The same as render_level_image().
    Result<Image> image(const Camera& camera, int width, int height, const LevelStyle& style,
                        const Overlay* overlay = nullptr);
    // Seconds spent drawing so far, without reading the pixels.
    double drawing_s() const;

  private:
    LevelPainter();
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// An image of `level` with its resolved surface types as seen by `camera`, width x height pixels
// (1..max_framebuffer_side each). Textures come from the mesh file's folder; `warnings`, if given, receives
// those that could not be used. `overlay` may be null. Errors: a size out of range; the driver refused a
// shader or reported an error.
Result<Image> render_level_image(OffscreenContext& context, const Level& level, const Camera& camera,
                                 int width, int height, const LevelStyle& style,
                                 const Overlay* overlay = nullptr, Warnings* warnings = nullptr);

}  // namespace slipface
