#include "app/picture_shelf.h"

#include "slipface/render/level_renderer.h"

namespace slipface {

PictureShelf::PictureShelf(GlTable gl) : gl_(std::move(gl)) {}
PictureShelf::~PictureShelf() = default;

unsigned PictureShelf::picture(const std::string& key, int width, int height,
                               const std::function<PictureRequest()>& request) {
    std::unique_ptr<Framebuffer>& kept = pictures_[key];
    if (kept && kept->width() == width && kept->height() == height) return kept->texture();
    kept = std::make_unique<Framebuffer>(gl_, width, height);
    const PictureRequest wanted = request();
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
