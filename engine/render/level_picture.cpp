#include "slipface/render/level_picture.h"

#include <glad/gl.h>

#include <algorithm>
#include <iterator>

namespace slipface {

Result<Image> render_level_picture(OffscreenContext& context, const Level& level, const Camera& camera,
                                   int width, int height, const LevelStyle& style, const Overlay* overlay,
                                   Warnings* warnings) {
    if (width < 1 || height < 1 || width > max_framebuffer_side || height > max_framebuffer_side) {
        return Error{"picture size", "found " + std::to_string(width) + "x" + std::to_string(height) +
                                         ", expected 1 to " + std::to_string(max_framebuffer_side) +
                                         " pixels a side"};
    }
    if (!context.make_current()) return Error{context.backend_name(), "the context cannot be made current"};
    const GlTable& gl = context.gl();
    while (gl->GetError() != GL_NO_ERROR) {
    }
    LevelRenderer renderer(gl);
    if (Status status = renderer.status(); !status) return status.error();
    Warnings found = renderer.set_mesh(level.mesh, level.mesh_path.parent_path());
    if (warnings != nullptr) std::move(found.begin(), found.end(), std::back_inserter(*warnings));
    renderer.set_surface_types(level.surfaces);
    if (level.mesh) renderer.set_face_surfaces(resolve_surfaces(level).surface);

    Framebuffer framebuffer(gl, width, height);
    framebuffer.bind();
    renderer.draw(camera, width, height, style);
    if (overlay != nullptr) {
        OverlayRenderer overlay_renderer(gl);
        if (Status status = overlay_renderer.status(); !status) return status.error();
        overlay_renderer.draw(*overlay, camera, width, height);
    }
    Image image = framebuffer.read();
    if (const unsigned error = gl->GetError(); error != GL_NO_ERROR) {
        return Error{context.renderer(), "OpenGL reports error " + std::to_string(error)};
    }
    if (image.width != width || image.height != height) {
        return Error{context.renderer(), "cannot draw a picture of " + std::to_string(width) + "x" +
                                             std::to_string(height) + " pixels"};
    }
    return image;
}

}  // namespace slipface
