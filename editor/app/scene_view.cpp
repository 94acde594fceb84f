#include "app/scene_view.h"

#include <algorithm>

#include "app/draw_hash.h"

namespace slipface {

SceneView::SceneView(GlTable gl, Editor& editor)
    : gl_(gl), editor_(editor), level_(gl), overlay_renderer_(std::move(gl)) {}

void SceneView::upload() {
    const Document& document = *editor_.document;
    const bool other_mesh = mesh_ != document.level().mesh;
    if (other_mesh) {
        mesh_ = document.level().mesh;
        texture_warnings_ = level_.set_mesh(mesh_, document.level().mesh_path.parent_path());
        ++uploads_;
    }
    if (other_mesh || document.face_revision() != face_revision_) {
        face_revision_ = document.face_revision();
        level_.set_surface_types(document.level().surfaces);
        level_.set_face_surfaces(document.resolved().surface);
        ++uploads_;
    }

    // Everything that face_highlights() looks at.
    Hasher highlights;
    highlights.u64(document.revision());
    highlights.u64(editor_.hovered);
    highlights.u64(static_cast<std::uint64_t>(editor_.tool));
    highlights.u64(editor_.playtest.has_value());
    highlights.f64(editor_.brush_radius);
    highlights.f64(editor_.fill_angle);
    if (editor_.brush_radius > 0.0 && editor_.tool == Tool::paint)
        for (int i = 0; i < 3; ++i)
            highlights.f64(editor_.hovered_point[i]);
    if (other_mesh || highlights.value() != highlights_hash_) {
        highlights_hash_ = highlights.value();
        std::vector<std::uint8_t> flags = face_highlights(editor_);
        if (other_mesh || flags != highlights_) {
            level_.set_face_highlights(flags);
            highlights_ = std::move(flags);
            ++uploads_;
        }
    }
}

unsigned SceneView::render(const Camera& camera, const Overlay& overlay, int width, int height) {
    width = std::clamp(width, 1, 8192);
    height = std::clamp(height, 1, 8192);
    upload();
    if (!target_ || target_->width() != width || target_->height() != height) {
        target_ = std::make_unique<Framebuffer>(gl_, width, height);
        drawn_hash_ = 0;
    }
    camera_ = camera;
    overlay_ = overlay;
    wanted_ = true;
    Hasher hasher;
    hash_camera(hasher, camera);
    hash_overlay(hasher, overlay);
    hash_style(hasher, editor_.style);
    hasher.u64(uploads_);
    hasher.u64(static_cast<std::uint64_t>(width));
    hasher.u64(static_cast<std::uint64_t>(height));
    wanted_hash_ = hasher.value();
    return target_->texture();
}

void SceneView::draw() {
    if (!wanted_ || !target_ || wanted_hash_ == drawn_hash_) return;
    target_->bind();
    level_.draw(camera_, target_->width(), target_->height(), editor_.style);
    overlay_renderer_.draw(overlay_, camera_, target_->width(), target_->height());
    target_->resolve();
    drawn_hash_ = wanted_hash_;
}

}  // namespace slipface
