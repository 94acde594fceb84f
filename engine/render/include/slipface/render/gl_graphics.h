// Draws a World with OpenGL: the Graphics of a game.
//
//   GlGraphics graphics(context->gl());
//   target.bind();                                  // a Framebuffer, or the window's
//   graphics.begin_frame(camera, target.width(), target.height());
//   world.draw(graphics);
//   Status drawn = graphics.end_frame();
#pragma once

#include <memory>

#include "slipface/base/result.h"
#include "slipface/render/camera.h"
#include "slipface/render/gl_context.h"
#include "slipface/render/level_renderer.h"
#include "slipface/render/overlay.h"
#include "slipface/world/world.h"

namespace slipface {

// Use it, and destroy it, while its context is current.
class GlGraphics final : public Graphics {
  public:
    explicit GlGraphics(GlTable gl);
    ~GlGraphics() override;
    GlGraphics(const GlGraphics&) = delete;
    GlGraphics& operator=(const GlGraphics&) = delete;

    LevelStyle style;                                    // of levels, and the background behind them
    Color ellipsoid_fill{0.36f, 0.60f, 0.86f, 0.75f};    // alpha 0: none
    Color ellipsoid_outline{0.80f, 0.90f, 1.00f, 0.9f};  // its silhouette; alpha 0: none

    // Forgets a frame that was begun and not ended. `width` and `height` are the bound framebuffer's, pixels.
    void begin_frame(const Camera& camera, int width, int height);

    // Only between begin_frame() and end_frame(); anywhere else they do nothing. A level is sent to the
    // graphics card in the first frame that draws it, with its textures from the mesh file's folder, and
    // again when it has another mesh, terrain or light; a frame that does not draw it drops it there.
    void draw_level(const Level& level, double time_s) override;
    void draw_ellipsoid(const Vec3& centre, const Vec3& radii) override;

    // Marks of the game's own over the frame: lines, arrows, discs. begin_frame() empties it.
    Overlay& overlay();

    // Clears the bound framebuffer and draws the frame into it. Errors: the driver refused a shader, or
    // there was no begin_frame().
    Status end_frame();

    // After types or painted faces of a level that is drawn have changed: sends those of all levels again.
    void surfaces_changed();

    // Since the last call: textures and baked light that could not be used.
    Warnings take_warnings();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace slipface
