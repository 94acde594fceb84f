#include "app/level_thumbnails.h"

#include <algorithm>

#include "slipface/level/shown_mesh.h"

namespace slipface {

LevelThumbnails::LevelThumbnails(GlTable gl, const Session& session)
    : gl_(std::move(gl)), session_(session) {}

LevelThumbnails::Shown LevelThumbnails::show(const std::filesystem::path& file, int width, int height) {
    requested_ = true;
    Picture& image = pictures_[file];
    const bool unread = image.facts.empty();
    if (unread && !job_) {
        reading_ = file;
        job_ = std::make_unique<Background<Result<LoadedLevel>>>(
            [file](Progress& progress) { return load_level(file, &progress); }, session_.wake);
    }
    if (job_ && reading_ == file && (!session_.beside || job_->ready())) {
        take(image, job_->take(), std::clamp(width, 1, 1024), std::clamp(height, 1, 1024));
        job_.reset();
    }
    return {image.target ? image.target->texture() : 0, image.facts};
}

void LevelThumbnails::take(Picture& image, Result<LoadedLevel> loaded, int width, int height) {
    ++images_;
    if (!loaded) {
        image.facts = "Cannot be read";
        return;
    }
    image.level = std::move(loaded->level);
    image.facts = std::to_string(image.level->mesh->face_count()) + " faces";
    image.target = std::make_unique<Framebuffer>(gl_, width, height);
}

void LevelThumbnails::draw() {
    for (auto& [file, image] : pictures_) {
        if (!image.level) continue;
        const Level& level = *image.level;
        LevelRenderer renderer(gl_);
        static_cast<void>(renderer.set_mesh(shown_mesh(level), level.mesh_path.parent_path()));
        static_cast<void>(renderer.set_light(level.light, level.mesh, level.file_path.parent_path()));
        renderer.set_surface_types(level.surfaces);
        renderer.set_face_surfaces(resolve_surfaces(level).surface);
        const double aspect = static_cast<double>(image.target->width()) / image.target->height();
        Camera camera = named_view("iso", level.mesh.bounds(), aspect).value_or(Camera());
        if (!level.cameras.empty()) {
            camera.orthographic = false;
            camera.eye = level.cameras.front().eye;
            camera.target = level.cameras.front().target;
            camera.fov_y = level.cameras.front().fov_y;
        }
        image.target->bind();
        renderer.draw(camera, image.target->width(), image.target->height(), LevelStyle());
        image.target->resolve();
        image.level.reset();
    }
}

}  // namespace slipface
