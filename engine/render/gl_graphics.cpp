#include "slipface/render/gl_graphics.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "level_textures.h"
#include "show_level.h"
#include "slipface/level/shown_mesh.h"

namespace slipface {

namespace {

// A level on the graphics card, and its uploaded state.
struct ShownLevel {
    const Level* level = nullptr;
    MeshPtr mesh;
    std::shared_ptr<const Heightfield> terrain;
    std::optional<LevelLight> light;
    std::vector<std::uint32_t> parts;  // [face] its platform; empty: nothing moves
    std::optional<double> placed_s;    // the time of the platforms' uploaded poses
    std::unique_ptr<LevelRenderer> renderer;
    bool wanted = false;             // drawn in the current frame
    bool surfaces_are_there = true;  // the uploaded types are those of the level

    // A new level at a deleted one's address has another mesh, because the old mesh is still held here.
    bool holds(const Level& other) const {
        return level == &other && mesh == other.mesh && terrain == other.terrain && light == other.light;
    }
};

// A mesh on the graphics card, and where the current frame draws it.
struct ShownMesh {
    MeshPtr mesh;
    std::filesystem::path folder, texture;
    std::unique_ptr<LevelRenderer> renderer;
    std::vector<PosedMesh> at;
};

}  // namespace

struct GlGraphics::Impl {
    explicit Impl(GlTable table) : gl(table), overlay_renderer(std::move(table)) {}

    GlTable gl;
    OverlayRenderer overlay_renderer;
    std::vector<ShownLevel> levels;                 // in the order in which they were first drawn
    std::vector<ShownMesh> meshes;                  // likewise
    std::unique_ptr<LevelRenderer> empty_renderer;  // for frames without a level; made at the first one
    Overlay overlay;
    Warnings warnings;
    Camera camera;
    int width = 0, height = 0;
    bool in_frame = false;

    ShownLevel& find(const Level& level);
};

ShownLevel& GlGraphics::Impl::find(const Level& level) {
    const auto known = std::find_if(levels.begin(), levels.end(),
                                    [&](const ShownLevel& shown) { return shown.holds(level); });
    if (known != levels.end()) {
        if (!std::exchange(known->surfaces_are_there, true)) show_surfaces(*known->renderer, level);
        return *known;
    }
    ShownLevel shown{.level = &level,
                     .mesh = level.mesh,
                     .terrain = level.terrain,
                     .light = level.light,
                     .parts = face_platforms(level),
                     .placed_s = {},
                     .renderer = std::make_unique<LevelRenderer>(gl)};
    Warnings found = show_level(*shown.renderer, level);
    std::move(found.begin(), found.end(), std::back_inserter(warnings));
    return levels.emplace_back(std::move(shown));
}

GlGraphics::GlGraphics(GlTable gl) : impl_(std::make_unique<Impl>(std::move(gl))) {}
GlGraphics::~GlGraphics() = default;

void GlGraphics::begin_frame(const Camera& camera, int width, int height) {
    impl_->camera = camera;
    impl_->width = width;
    impl_->height = height;
    impl_->overlay = {};
    for (ShownLevel& shown : impl_->levels)
        shown.wanted = false;
    for (ShownMesh& shown : impl_->meshes)
        shown.at.clear();
    impl_->in_frame = true;
}

void GlGraphics::draw_level(const Level& level, double time_s) {
    if (!impl_->in_frame) return;
    ShownLevel& shown = impl_->find(level);
    shown.wanted = true;
    shown.renderer->animate_props(time_s);
    if (shown.parts.empty() || shown.placed_s == time_s) return;
    const std::vector<Pose> poses = platform_poses(level, time_s);
    shown.renderer->move_faces(shown.parts, poses);
    shown.renderer->move_props(prop_poses(level, shown.parts, poses));
    shown.placed_s = time_s;
}

void GlGraphics::draw_mesh(const MeshPtr& mesh, const Placement& at, const std::filesystem::path& folder,
                           const MeshLook& look) {
    if (!impl_->in_frame || !mesh) return;
    const std::filesystem::path& texture = look.texture;
    auto known = std::find_if(impl_->meshes.begin(), impl_->meshes.end(), [&](const ShownMesh& shown) {
        return shown.mesh == mesh && shown.texture == texture && shown.folder == folder;
    });
    if (known == impl_->meshes.end()) {
        ShownMesh shown{mesh, folder, texture, std::make_unique<LevelRenderer>(impl_->gl), {}};
        Warnings found = texture.empty()
                             ? shown.renderer->set_instances(mesh, folder)
                             : shown.renderer->set_instances(with_texture(*mesh, texture.filename().string()),
                                                             texture.parent_path());
        std::move(found.begin(), found.end(), std::back_inserter(impl_->warnings));
        known = impl_->meshes.insert(impl_->meshes.end(), std::move(shown));
    }
    known->at.push_back({at, look.pose != nullptr ? *look.pose : RigPose(), look.uv});
}

void GlGraphics::draw_ellipsoid(const Vec3& centre, const Vec3& radii) {
    if (impl_->in_frame) impl_->overlay.ellipsoid(centre, radii, ellipsoid_fill, ellipsoid_outline);
}

Overlay& GlGraphics::overlay() {
    return impl_->overlay;
}

Status GlGraphics::end_frame() {
    Impl& impl = *impl_;
    if (!std::exchange(impl.in_frame, false))
        return Error{"GlGraphics::end_frame", "found no frame in progress, expected begin_frame() before it"};
    std::erase_if(impl.levels, [](const ShownLevel& shown) { return !shown.wanted; });
    std::erase_if(impl.meshes, [](const ShownMesh& shown) { return shown.at.empty(); });
    if (impl.levels.empty() && !impl.empty_renderer)
        impl.empty_renderer = std::make_unique<LevelRenderer>(impl.gl);
    LevelRenderer& first = impl.levels.empty() ? *impl.empty_renderer : *impl.levels.front().renderer;
    if (Status status = first.status(); !status) return status;
    first.draw(impl.camera, impl.width, impl.height, style);
    for (std::size_t i = 1; i < impl.levels.size(); ++i)
        impl.levels[i].renderer->draw_over(impl.camera, impl.width, impl.height, style);
    double extent = 0.0;
    for (const ShownLevel& shown : impl.levels)
        if (shown.mesh) extent = std::max(extent, shown.mesh->bounds.size().norm());
    for (ShownMesh& shown : impl.meshes)
        for (const PosedMesh& placed : shown.at)
            shown.renderer->draw_placed(impl.camera, impl.width, impl.height, style, placed, extent);
    for (const ShownMesh& shown : impl.meshes)
        if (Status status = shown.renderer->status(); !status) return status;
    if (Status status = impl.overlay_renderer.status(); !status) return status;
    impl.overlay_renderer.draw(impl.overlay, impl.camera, impl.width, impl.height);
    return {};
}

void GlGraphics::surfaces_changed() {
    for (ShownLevel& shown : impl_->levels)
        shown.surfaces_are_there = false;
}

Warnings GlGraphics::take_warnings() {
    return std::exchange(impl_->warnings, {});
}

}  // namespace slipface
