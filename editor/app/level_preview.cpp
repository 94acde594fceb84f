#include "app/level_preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "document/inside_out.h"
#include "slipface/base/counted.h"
#include "widgets/theme.h"

namespace slipface {
namespace {

constexpr std::uintmax_t max_bytes = 96u << 20;  // of a file that is read only for its preview

std::string facts_of(const LoadedLevel& loaded) {
    std::size_t painted = 0;
    for (const auto& surface : loaded.level.overrides)
        painted += surface ? 1 : 0;
    std::string text = counted(loaded.level.mesh.face_count(), "face");
    if (painted > 0) text += fmt::format(", {} painted", painted);
    if (!loaded.level.orphans.empty()) text += fmt::format(", {} orphaned", loaded.level.orphans.size());
    return text;
}

}  // namespace

LevelPreview::LevelPreview(GlTable gl, const Session& session) : gl_(std::move(gl)), session_(session) {}

void LevelPreview::take(Result<LoadedLevel> loaded) {
    if (!loaded) {
        facts_ = loaded.error().text();
        return;
    }
    const Level& level = loaded->level;
    facts_ = facts_of(*loaded);
    if (!renderer_) renderer_ = std::make_unique<LevelRenderer>(gl_);
    static_cast<void>(renderer_->set_mesh(level.mesh, level.mesh_path.parent_path()));
    renderer_->set_surface_types(level.surfaces);
    renderer_->set_face_surfaces(resolve_surfaces(level).surface);
    // Rooms are viewed from inside.
    const Result<CollisionWorld> world = build_collision_world(level);
    back_faces_ = !world || !is_made_of_rooms(*world);
    camera_ = named_view("iso", level.mesh.bounds(), 1.5);
    drawn_ = false;
    ++images_;
}

LevelPreview::Shown LevelPreview::show(const std::filesystem::path& file, int width, int height) {
    requested_ = true;
    if (file != file_) {
        file_ = file;
        camera_.reset();
        job_.reset();
        std::error_code error;
        const std::uintmax_t bytes = std::filesystem::file_size(file, error);
        if (error || bytes > max_bytes) {
            facts_ = error ? "No level" : "Too large for a preview";
        } else {
            facts_ = "Reading\u2026";
            job_ = std::make_unique<Background<Result<LoadedLevel>>>(
                [file](Progress& progress) { return load_level(file, &progress); }, session_.wake);
        }
    }
    if (job_ && (!session_.beside || job_->ready())) {
        take(job_->take());
        job_.reset();
    }
    if (!camera_) return {0, facts_};
    width = std::clamp(width, 1, 2048);
    height = std::clamp(height, 1, 2048);
    if (!target_ || target_->width() != width || target_->height() != height) {
        target_ = std::make_unique<Framebuffer>(gl_, width, height);
        drawn_ = false;
        ++images_;
    }
    wanted_ = true;
    return {target_->texture(), facts_};
}

void LevelPreview::draw() {
    if (!wanted_ || drawn_ || !camera_ || !target_) return;
    LevelStyle style;
    style.back_faces = back_faces_;
    const auto color = [](const ImVec4& c) { return Vec3f(c.x, c.y, c.z); };
    style.background_top = color(ui::palette().view_top);
    style.background_bottom = color(ui::palette().view_bottom);
    target_->bind();
    renderer_->draw(*camera_, target_->width(), target_->height(), style);
    target_->resolve();
    drawn_ = true;
}

}  // namespace slipface
