#include "app/scene_view.h"

#include <glad/gl.h>

#include <algorithm>

#include "app/draw_hash.h"
#include "slipface/level/shown_mesh.h"

namespace slipface {

SceneView::~SceneView() {
    for (const Still& still : stills_)
        if (still.texture != 0) gl_->DeleteTextures(1, &still.texture);
}

SceneView::SceneView(GlTable gl, Editor& editor, std::size_t draft_from)
    : gl_(gl), editor_(editor), level_(gl), overlay_renderer_(std::move(gl)), draft_from_(draft_from) {}

void SceneView::upload() {
    const Document& document = *editor_.document;
    const Level& level = document.level();
    // Baked light is that of faces, so props that it lights are faces, too.
    const bool apart = has_instances(level) && !level.light;
    const MeshPtr& mesh = apart ? own_mesh(level) : level.mesh.whole();
    const bool other_mesh = mesh_ != mesh || texture_revision_ != editor_.texture_revision;
    if (other_mesh) {
        texture_revision_ = editor_.texture_revision;
        mesh_ = mesh;
        props_ = nullptr;
        texture_warnings_ = level_.set_mesh(shown_mesh(level, !apart), level.mesh_path.parent_path());
        draft_ = level.mesh.triangle_count() >= draft_from_;
        ++uploads_;
    }
    if (other_mesh || level.light != light_) {
        light_ = level.light;
        for (Diagnostic& warning : level_.set_light(light_, mesh_, level.file_path.parent_path()))
            texture_warnings_.push_back(std::move(warning));
        ++uploads_;
    }
    const bool other_types = other_mesh || document.face_revision() != face_revision_;
    if (other_types) {
        face_revision_ = document.face_revision();
        level_.set_surface_types(level.surfaces);
        level_.set_face_surfaces(apart ? document.resolved_parts().own.surface : document.resolved().surface);
        ++uploads_;
    }
    // Those that are animated are always instances.
    const bool animated = has_animated_props(level), drawn_props = apart || animated;
    std::vector<Animation> animations;
    for (const Prop& prop : level.props)
        if (animated) animations.push_back(prop.animation);
    const bool other_props = (drawn_props || props_) &&
                             (other_types || props_ != level.mesh.placed() || animations_ != animations);
    if (other_props) {
        props_ = level.mesh.placed();
        animations_ = std::move(animations);
        const PropSurfaces& types = document.resolved_parts().props;
        for (Diagnostic& warning :
             apart ? level_.set_props(level, types) : level_.set_animated_props(level, types))
            texture_warnings_.push_back(std::move(warning));
        highlights_hash_ = 0;
        ++uploads_;
    }

    // Platforms are where the playtest's last tick left them; while editing, at the level's start.
    const std::vector<std::uint32_t> parts = face_platforms(level);
    if (!parts.empty() || animated || moved_) {
        const double time_s =
            editor_.playtest ? static_cast<double>(editor_.playtest->tape().tick_count()) * Playtest::tick_s
                             : 0.0;
        level_.animate_props(time_s);
        if (other_mesh || other_props || !moved_ || *moved_ != time_s) {
            const std::vector<Pose> poses = platform_poses(level, time_s);
            level_.move_faces(std::span(parts).first(std::min(parts.size(), mesh_->face_count())), poses);
            level_.move_props(prop_poses(level, parts, poses));
            moved_ = parts.empty() && !animated ? std::optional<double>() : time_s;
            ++uploads_;
        }
    }

    // Everything that face_highlights() depends on.
    Hasher highlights;
    highlights.u64(document.revision());
    highlights.u64(editor_.hovered);
    highlights.u64(static_cast<std::uint64_t>(editor_.tool));
    highlights.u64(editor_.playtest.has_value());
    highlights.f64(editor_.brush_radius);
    highlights.f64(editor_.fill_angle);
    highlights.f64(editor_.select_radius);
    highlights.u64(static_cast<std::uint64_t>(editor_.select_shape));
    if ((editor_.brush_radius > 0.0 && editor_.tool == Tool::paint) ||
        (editor_.select_radius > 0.0 && editor_.tool == Tool::select))
        for (int i = 0; i < 3; ++i)
            highlights.f64(editor_.hovered_point[i]);
    if (other_mesh || other_props || highlights.value() != highlights_hash_) {
        highlights_hash_ = highlights.value();
        FaceHighlights flags = face_highlights(editor_, mesh_->face_count());
        if (other_mesh || other_props || flags != highlights_) {
            level_.set_face_highlights(flags.own);
            if (other_props || flags.props != highlights_.props) level_.set_prop_highlights(flags.props);
            highlights_ = std::move(flags);
            ++uploads_;
        }
    }
}

unsigned SceneView::render(std::size_t pane, const Camera& camera, const Overlay& overlay, int width,
                           int height) {
    width = std::clamp(width, 1, 8192);
    height = std::clamp(height, 1, 8192);
    upload();
    Picture& image = images_[std::min(pane, images_.size() - 1)];
    if (!image.target || image.target->width() != width || image.target->height() != height) {
        image.target = std::make_unique<Framebuffer>(gl_, width, height);
        image.drawn_hash = 0;
    }
    image.camera = camera;
    image.overlay = overlay;
    image.style = editor_.style;
    image.style.back_faces = draws_back_faces(editor_, camera);
    image.wanted = true;
    Hasher hasher;
    hash_camera(hasher, camera);
    hash_overlay(hasher, overlay);
    hash_style(hasher, image.style);
    hasher.u64(uploads_);
    hasher.u64(static_cast<std::uint64_t>(width));
    hasher.u64(static_cast<std::uint64_t>(height));
    image.wanted_hash = hasher.value();
    return image.target->texture();
}

void SceneView::begin_frame() {
    for (Picture& image : images_)
        image.wanted = false;
}

std::uint64_t SceneView::wanted_hash() const {
    Hasher hasher;
    for (const Picture& image : images_)
        hasher.u64(image.wanted ? image.wanted_hash : 0);
    return hasher.value();
}

unsigned SceneView::still(int slot, const Image& image, std::uint64_t revision) {
    Still& kept = stills_[static_cast<std::size_t>(slot) % stills_.size()];
    if (kept.texture != 0 && kept.revision == revision) return kept.texture;
    if (kept.texture == 0) gl_->GenTextures(1, &kept.texture);
    kept.revision = revision;
    gl_->BindTexture(GL_TEXTURE_2D, kept.texture);
    gl_->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl_->PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                    image.rgba.data());
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl_->BindTexture(GL_TEXTURE_2D, 0);
    return kept.texture;
}

void SceneView::draw() {
    for (Picture& image : images_) {
        if (!image.wanted || !image.target || image.wanted_hash == image.drawn_hash) continue;
        const int width = image.target->width(), height = image.target->height();
        draft_ ? image.target->bind_draft() : image.target->bind();
        level_.draw(image.camera, width, height, image.style);
        overlay_renderer_.draw(image.overlay, image.camera, width, height);
        if (draft_) continue;
        image.target->resolve();
        image.drawn_hash = image.wanted_hash;
    }
    if (!draft_) level_.prepare_outlines();
    draft_ = false;
}

}  // namespace slipface
