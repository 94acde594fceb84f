#include "app/image_shelf.h"

#include "slipface/render/level_renderer.h"

namespace slipface {

ImageShelf::ImageShelf(GlTable gl) : gl_(std::move(gl)) {}
ImageShelf::~ImageShelf() = default;

unsigned ImageShelf::image(const std::string& key, int width, int height,
                           const std::function<ImageRequest()>& request) {
    std::unique_ptr<Framebuffer>& kept = images_[key];
    if (kept && kept->width() == width && kept->height() == height) return kept->texture();
    kept = std::make_unique<Framebuffer>(gl_, width, height);
    const ImageRequest wanted = request();
    LevelRenderer level(gl_);
    OverlayRenderer overlay(gl_);
    if (wanted.level) {
        (void)level.set_mesh(wanted.level->mesh, wanted.level->mesh_path.parent_path());
        level.set_surface_types(wanted.level->surfaces);
        level.set_face_surfaces(resolve_surfaces(*wanted.level).surface);
    }
    LevelStyle style;
    style.wireframe = true;
    kept->bind();
    level.draw(wanted.camera, kept->width(), kept->height(), style);
    overlay.draw(wanted.overlay, wanted.camera, kept->width(), kept->height());
    kept->resolve();
    return kept->texture();
}

}  // namespace slipface
