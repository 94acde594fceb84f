// Draws a World with OpenGL: the implementation of Graphics for games.
//
//   GlGraphics graphics(context->gl());
//   target.bind();                                  // a Framebuffer, or the window's
//   graphics.begin_frame(camera, target.width(), target.height());
//   world.draw(graphics);
//   Status drawn = graphics.end_frame();
#pragma once

#include <memory>

#include "slipface/base/result.h"
#include "slipface/render/gl_context.h"
#include "slipface/render/level_renderer.h"
#include "slipface/render/overlay.h"
#include "slipface/view/camera.h"
#include "slipface/world/world.h"

namespace slipface {

// Use and destroy it only while its context is current.
class GlGraphics final : public Graphics {
  public:
    explicit GlGraphics(GlTable gl);
    ~GlGraphics() override;
    GlGraphics(const GlGraphics&) = delete;
    GlGraphics& operator=(const GlGraphics&) = delete;

    LevelStyle style;                                    // of levels, and the background behind them
    Color ellipsoid_fill{0.36f, 0.60f, 0.86f, 0.75f};    // alpha 0: none
    Color ellipsoid_outline{0.80f, 0.90f, 1.00f, 0.9f};  // its silhouette; alpha 0: none

    // Begins a frame; a frame that was not ended is discarded. `width` and `height` are those of the bound
    // framebuffer, pixels.
    void begin_frame(const Camera& camera, int width, int height);

    // Between end_frame() and begin_frame() these do nothing. A level is uploaded in the first frame that
    // draws it, with the textures of the mesh file's folder, and again when it has another mesh, terrain or
    // light. A frame that does not draw it frees it.
    void draw_level(const Level& level, double time_s) override;
    // A mesh is uploaded in the first frame that draws it, once for each texture, and freed like a level. It
    // is drawn without borders and surface types.
    void draw_mesh(const MeshPtr& mesh, const Placement& at, const std::filesystem::path& folder,
                   const MeshLook& look = {}) override;
    void draw_ellipsoid(const Vec3& centre, const Vec3& radii) override;

    // The game's own lines, arrows and discs over the frame. begin_frame() clears it.
    Overlay& overlay();

    // Clears the bound framebuffer and draws the frame into it. Errors: the driver refused a shader; there
    // was no begin_frame().
    Status end_frame();

    // Call it after types or painted faces of a drawn level changed: uploads those of all levels again.
    void surfaces_changed();

    // Textures and baked light that could not be used, since the last call.
    Warnings take_warnings();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace slipface
