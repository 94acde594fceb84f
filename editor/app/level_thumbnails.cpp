#include "app/level_thumbnails.h"

#include <algorithm>

#include "slipface/level/shown_mesh.h"

namespace slipface {

LevelThumbnails::LevelThumbnails(GlTable gl, const Session& session)
    : gl_(std::move(gl)), session_(session) {}

LevelThumbnails::Shown LevelThumbnails::show(const std::filesystem::path& file, int width, int height) {
    asked_ = true;
    Picture& picture = kept_[file];
    const bool unread = picture.facts.empty();
    if (unread && !job_) {
        reading_ = file;
        job_ = std::make_unique<Background<Result<LoadedLevel>>>(
            [file](Progress& progress) { return load_level(file, &progress); }, session_.wake);
    }
    if (job_ && reading_ == file && (!session_.beside || job_->ready())) {
        take(picture, job_->take(), std::clamp(width, 1, 1024), std::clamp(height, 1, 1024));
        job_.reset();
    }
    return {picture.target ? picture.target->texture() : 0, picture.facts};
}

void LevelThumbnails::take(Picture& picture, Result<LoadedLevel> loaded, int width, int height) {
    ++pictures_;
    if (!loaded) {
        picture.facts = "Cannot be read";
        return;
    }
    picture.level = std::move(loaded->level);
    picture.facts = std::to_string(picture.level->mesh->face_count()) + " faces";
    picture.target = std::make_unique<Framebuffer>(gl_, width, height);
}

void LevelThumbnails::draw() {
    for (auto& [file, picture] : kept_) {
        if (!picture.level) continue;
        const Level& level = *picture.level;
        LevelRenderer renderer(gl_);
        static_cast<void>(renderer.set_mesh(shown_mesh(level), level.mesh_path.parent_path()));
        static_cast<void>(renderer.set_light(level.light, level.mesh, level.file_path.parent_path()));
        renderer.set_surface_types(level.surfaces);
        renderer.set_face_surfaces(resolve_surfaces(level).surface);
        const double aspect = static_cast<double>(picture.target->width()) / picture.target->height();
        Camera camera = named_view("iso", level.mesh->bounds, aspect).value_or(Camera());
        if (!level.cameras.empty()) {
            camera.orthographic = false;
            camera.eye = level.cameras.front().eye;
            camera.target = level.cameras.front().target;
            camera.fov_y = level.cameras.front().fov_y;
        }
        picture.target->bind();
        renderer.draw(camera, picture.target->width(), picture.target->height(), LevelStyle());
        picture.target->resolve();
        picture.level.reset();
    }
}

}  // namespace slipface
