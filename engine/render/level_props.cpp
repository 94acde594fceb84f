#include "level_props.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "level_renderer_impl.h"
#include "slipface/level/prop_materials.h"

namespace slipface {

namespace {

constexpr std::size_t most_border_triangles = 200'000, most_outlined_props = 200;

// Whether something of a sphere may be in the picture.
class Frustum {
  public:
    Frustum(const Camera& camera, int width, int height) : camera_(camera), view_(view_from_world(camera)) {
        up_ = std::tan(0.5 * camera.fov_y);
        side_ = up_ * width / height;
    }
    bool sees(const Vec3& centre, double radius) const {
        if (camera_.orthographic) return true;
        const Vec3 at = (view_ * centre.homogeneous()).head<3>();
        const double depth = -at.z();
        return depth > -radius && std::abs(at.x()) - side_ * depth <= radius * std::hypot(1.0, side_) &&
               std::abs(at.y()) - up_ * depth <= radius * std::hypot(1.0, up_);
    }

  private:
    const Camera& camera_;
    Mat4 view_;
    double up_, side_;
};

}  // namespace

struct LevelProps::Shown {
    MeshPtr mesh;
    std::string file, texture;  // of its props
    std::unique_ptr<LevelRenderer> renderer;
    std::vector<std::uint32_t> props;
    bool current = true;  // the file has this mesh
};

struct LevelProps::Placed {
    Shown* shown = nullptr;  // null: it has no faces
    Vec3 position, rotation, scale;
    Placement rest, at;
    Vec3 centre = Vec3::Zero();  // of a sphere around it, at rest
    double radius = 0.0;
    int first_state = 0;
    Animation animation;

    bool stands(const Prop& prop) const {
        return shown != nullptr && shown->current && position == prop.position && rotation == prop.rotation &&
               scale == prop.scale && shown->file == prop.mesh && shown->texture == prop.texture;
    }
};

LevelProps::LevelProps(GlTable gl, std::shared_ptr<LevelPrograms> programs)
    : gl_(std::move(gl)), programs_(std::move(programs)) {}
LevelProps::~LevelProps() = default;

LevelProps::Shown* LevelProps::upload(const Level& level, const Prop& prop, Warnings& warnings) {
    shown_.push_back(std::make_unique<Shown>());
    Shown& shown = *shown_.back();
    shown.mesh = find_prop_mesh(level, prop.mesh)->mesh;
    shown.file = prop.mesh;
    shown.texture = prop.texture;
    shown.renderer.reset(new LevelRenderer(std::make_unique<LevelRenderer::Impl>(gl_, programs_)));
    const Warnings found = shown.renderer->set_instances(drawn_prop_mesh(shown.mesh, prop.mesh, prop.texture),
                                                         level.mesh_path.parent_path());
    warnings.insert(warnings.end(), found.begin(), found.end());
    return &shown;
}

void LevelProps::set(const Level& level, const PropSurfaces& types, Warnings& warnings) {
    std::map<std::pair<std::string_view, std::string_view>, Shown*> known;  // by file and texture
    for (const auto& shown : shown_) {
        shown->props.clear();
        const PropMesh* const now = find_prop_mesh(level, shown->file);
        shown->current = now != nullptr && now->mesh == shown->mesh;
        if (shown->current) known[{shown->file, shown->texture}] = shown.get();
    }
    types_ = types;
    types_.resize(level.props.size());
    highlights_.clear();
    const std::vector<Placed> was = std::exchange(props_, {});
    props_.resize(level.props.size());
    std::size_t next = 0;  // that which is probably the same prop among those before
    for (std::size_t i = 0; i < level.props.size(); ++i) {
        if (!types_[i]) continue;
        const Prop& prop = level.props[i];
        const auto stood = [&](std::size_t k) { return k < was.size() && was[k].stands(prop); };
        if (!stood(next)) next = stood(next + 1) ? next + 1 : next > 0 && stood(next - 1) ? next - 1 : next;
        Placed& placed = props_[i];
        if (stood(next)) {
            placed = was[next];
            placed.at = placed.rest;
        } else {
            Shown*& shown = known[{prop.mesh, prop.texture}];
            if (shown == nullptr) shown = upload(level, prop, warnings);
            const Aabb& box = shown->mesh->bounds;
            const Placement at = prop.placement();
            const Vec3 centre = at.columns[0] * box.centre().x() + at.columns[1] * box.centre().y() +
                                at.columns[2] * box.centre().z() + at.offset;
            const double radius = 0.5 * box.size().norm() * prop.scale.cwiseAbs().maxCoeff();
            placed = {shown, prop.position, prop.rotation, prop.scale, at, at, centre, radius, 0, {}};
        }
        ++next;
        placed.animation = prop.animation;
        placed.shown->props.push_back(static_cast<std::uint32_t>(i));
    }
    std::erase_if(shown_, [](const std::unique_ptr<Shown>& shown) { return shown->props.empty(); });
    send_states();
}

// Each list of types is stored once for a mesh, and each prop with highlights has a copy of its own.
void LevelProps::send_states() {
    for (const auto& shown : shown_) {
        const std::size_t faces = shown->mesh->face_count();
        LevelRenderer::Impl& impl = *shown->renderer->impl_;
        std::vector<SurfaceId> surfaces;
        std::vector<std::uint8_t> highlights;
        std::map<const ResolvedSurfaces*, int> first;
        for (const std::uint32_t prop : shown->props) {
            const std::vector<SurfaceId>& of = types_[prop]->surface;
            const auto lit = highlights_.find(prop);
            const auto known = first.find(types_[prop].get());
            if (lit == highlights_.end() && known != first.end()) {
                props_[prop].first_state = known->second;
                continue;
            }
            props_[prop].first_state = static_cast<int>(surfaces.size());
            surfaces.insert(surfaces.end(), of.begin(), of.end());
            surfaces.resize(static_cast<std::size_t>(props_[prop].first_state) + faces);
            if (lit == highlights_.end())
                first[types_[prop].get()] = props_[prop].first_state;
            else
                highlights.insert(highlights.end(), lit->second.begin(), lit->second.end());
            highlights.resize(surfaces.size());
        }
        impl.face_state.resize(surfaces.size());
        impl.face_state.change(surfaces, FaceState::Channel::surface);
        impl.face_state.change(highlights, FaceState::Channel::highlight);
        const auto any = [](const auto& list) {
            return std::any_of(list.begin(), list.end(), [](std::uint8_t value) { return value != 0; });
        };
        impl.surfaces_shown = any(surfaces);
        impl.highlights_shown = any(highlights);
    }
}

void LevelProps::highlight(const std::map<std::uint32_t, std::vector<std::uint8_t>>& highlights) {
    if (highlights == highlights_) return;
    highlights_ = highlights;
    send_states();
}

void LevelProps::move(const std::map<std::uint32_t, Pose>& poses) {
    for (Placed& prop : props_)
        prop.at = prop.rest;
    for (const auto& [prop, pose] : poses)
        if (prop < props_.size()) props_[prop].at = moved(props_[prop].rest, pose);
}

void LevelProps::draw_faces(const Camera& camera, int width, int height, const Mat4f& clip,
                            const LevelStyle& style, const Vec3& origin, double extent_around,
                            unsigned surface_table) {
    const Frustum frustum(camera, width, height);
    std::vector<LevelRenderer::Impl::Place> places;
    std::vector<RigPose> poses;
    for (const auto& shown : shown_) {
        LevelRenderer::Impl& impl = *shown->renderer->impl_;
        places.clear();
        poses.resize(std::max(poses.size(), impl.rig ? shown->props.size() : 0));
        for (const std::uint32_t prop : shown->props) {
            const Placed& placed = props_[prop];
            const Vec3 centre = placed.centre + placed.at.offset - placed.rest.offset;
            // A prop that turns elsewhere is not looked at more closely.
            const double reach = impl.rig ? 2.0 * placed.radius : placed.radius;
            if (placed.at.columns == placed.rest.columns && !frustum.sees(centre, reach)) continue;
            RigPose* const pose = impl.rig ? &poses[places.size()] : nullptr;
            if (pose != nullptr) pose_at(*shown->mesh, placed.animation, time_s_, *pose);
            places.push_back({placed.at, placed.first_state, pose, uv_at(placed.animation, time_s_)});
        }
        if (places.empty()) continue;
        impl.places = places;
        impl.mesh_origin = impl.origin;
        impl.extent_around = extent_around;
        impl.origin = origin;
        const unsigned own_table = std::exchange(impl.table_texture, surface_table);
        impl.draw_faces(camera, height, clip, style);
        impl.table_texture = own_table;
        impl.origin = impl.mesh_origin;
        impl.places = {};
    }
}

Mesh LevelProps::mesh_of(const Placed& prop) const {
    Mesh mesh = *prop.shown->mesh;
    for (Vec3f& position : mesh.positions)
        position = prop.at.apply(position);
    return mesh;
}

void LevelProps::add_borders(const Vec3& origin, const std::uint8_t (&color)[4], float width,
                             std::vector<LineInstance>& lines) const {
    std::size_t triangles = 0;
    for (const Placed& prop : props_)
        triangles += prop.shown != nullptr ? prop.shown->mesh->triangle_count() : 0;
    if (triangles > most_border_triangles) return;
    for (std::uint32_t i = 0; i < props_.size(); ++i) {
        if (props_[i].shown == nullptr) continue;
        const auto lit = highlights_.find(i);
        const std::vector<LineInstance> more = face_border_lines(
            mesh_of(props_[i]),
            lit == highlights_.end() ? std::span<const std::uint8_t>() : std::span(lit->second), origin,
            color, width);
        lines.insert(lines.end(), more.begin(), more.end());
    }
}

void LevelProps::add_outlines(std::uint8_t bit, const Vec3& origin, const std::uint8_t (&color)[4],
                              float width, std::vector<LineInstance>& lines) const {
    std::size_t outlined = 0;
    for (const auto& [i, flags] : highlights_) {
        if (i >= props_.size() || props_[i].shown == nullptr) continue;
        if (std::none_of(flags.begin(), flags.end(), [&](std::uint8_t flag) { return (flag & bit) != 0; }))
            continue;
        if (++outlined > most_outlined_props) return;
        const Mesh mesh = mesh_of(props_[i]);
        const std::vector<LineInstance> more =
            OutlineFinder(mesh).lines(mesh, flags, bit, origin, color, width);
        lines.insert(lines.end(), more.begin(), more.end());
    }
}

}  // namespace slipface
