#include "slipface/level/level_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "slipface/level/shown_mesh.h"

namespace slipface {

namespace {

// The triangles of some faces of a mesh.
struct Part {
    std::vector<Vec3f> rest;  // [vertex of the part] as modelled
    std::vector<std::array<std::uint32_t, 3>> corners;
    std::vector<FaceId> faces;
    std::vector<TriangleId> triangles;  // [triangle of the part] its index in the mesh
};

template <class Belongs>
Part part_of(const Mesh& mesh, const Belongs& belongs) {
    Part part;
    std::vector<std::uint32_t> vertex(mesh.positions.size(), no_id);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const FaceId face = mesh.triangle_face[t];
        if (!belongs(face)) continue;
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = mesh.corner_vertex[mesh.triangles[t][k]];
            if (vertex[from] == no_id) {
                vertex[from] = static_cast<std::uint32_t>(part.rest.size());
                part.rest.push_back(mesh.positions[from]);
            }
            corners[k] = vertex[from];
        }
        part.corners.push_back(corners);
        part.faces.push_back(face);
        part.triangles.push_back(static_cast<TriangleId>(t));
    }
    return part;
}

Result<CollisionWorld> collision_at(const Part& part, const Pose& pose,
                                    std::span<const Instance> instances = {}) {
    std::vector<Vec3f> positions;
    positions.reserve(part.rest.size());
    for (const Vec3f& rest : part.rest)
        positions.push_back(pose == Pose{} ? rest : Vec3f(pose.apply(rest.cast<double>()).cast<float>()));
    return CollisionWorld::build({positions, part.corners, part.faces}, instances);
}

// A platform of the level.
struct Moving {
    std::size_t index;  // in level->platforms
    std::vector<FaceId> faces;
    std::vector<TriangleId> triangles;     // [triangle] its index in the mesh
    std::shared_ptr<CollisionWorld> rest;  // as modelled; scenes for other threads share it
};

}  // namespace

struct LevelScene::Impl {
    const Level* level = nullptr;
    const CollisionWorld* fixed = nullptr;  // another owner's; null: `own` is used
    CollisionWorld own;
    std::vector<TriangleId> own_triangles;
    std::span<const TriangleId> triangles;  // [static triangle] its index in the mesh
    std::vector<Moving> moving;
    std::vector<MovingPart> parts;
    std::vector<Aabb> rooms;  // [part]
    PlatformTree tree;        // of `rooms`
    std::vector<std::uint32_t> face_platforms;
    std::vector<SurfaceId> surfaces;  // [face] resolved, for the platforms
    Heightfield terrain;              // a moved copy, if `offset` is not zero
    const Heightfield* heightfield = nullptr;
    Sectors sectors;
    Vec3 offset = Vec3::Zero();
    struct Tried {
        CollisionWorld* world;
        FaceId face;
        SurfaceId before;
    };
    std::vector<Tried> tried;

    void choose_origin(const MovementSettings& settings);
    Status build(const CollisionWorld* whole);
    Status add_moving(std::size_t platform, Part part);
    void paint(const Moving& moved) const;
    void make_room();
};

// With sectors the offset stays below a sector's size, and only the index of the home sector is large.
// Without them the level moves to its placement, and coordinates lose precision there.
void LevelScene::Impl::choose_origin(const MovementSettings& settings) {
    const SectorLayout& layout = level->sectors;
    if (layout.size > 0.0 && settings.sectors) {
        sectors.size = layout.size;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double placed = layout.placement[static_cast<Eigen::Index>(axis)];
            const double steps = std::clamp(std::round(placed / layout.size), -1e9, 1e9);
            sectors.home[axis] = static_cast<std::int32_t>(steps);
            offset[static_cast<Eigen::Index>(axis)] = placed - steps * layout.size;
        }
    } else {
        offset = layout.placement;
    }
    heightfield = level->terrain.get();
    if (heightfield != nullptr && !offset.isZero(0.0)) {
        terrain = *heightfield;
        terrain.origin += offset;
        for (double& height : terrain.heights)
            height += offset.y();
        heightfield = &terrain;
    }
}

Status LevelScene::Impl::build(const CollisionWorld* whole) {
    if (!level->mesh) return Error{level->mesh_path.string(), "the level has no geometry"};
    const std::vector<Platform>& platforms = level->platforms;
    face_platforms = slipface::face_platforms(*level);
    const bool something_moves = !face_platforms.empty();
    if (whole != nullptr && !something_moves && offset.isZero(0.0)) {
        fixed = whole;
        return {};
    }
    if (something_moves) surfaces = resolve_surfaces(*level).surface;
    const auto rests = [&](FaceId face) { return !something_moves || face_platforms[face] == no_id; };
    Part still = part_of(*own_mesh(*level), rests);
    const SurfaceParts types = resolve_parts(*level);
    const std::vector<Instance> props = prop_instances(
        *level, types, offset, [&](std::size_t prop) { return rests(level->placed.first_face[prop]); });
    Result<CollisionWorld> built = collision_at(still, Pose{.offset = offset}, props);
    if (!built) return Error{level->mesh_path.string(), built.error().text()};
    own = std::move(*built);
    apply_surface_rules(own, level->surfaces);
    own.set_face_surfaces(types.own.surface);
    if (something_moves) {
        const Mesh& mesh = *level->mesh;
        for (const Instance& prop : props) {
            const TriangleId first = mesh.face_first_triangle[prop.first_face];
            for (TriangleId i = 0; i < prop.mesh->triangle_count(); ++i)
                still.triangles.push_back(first + i);
        }
        own_triangles = std::move(still.triangles);
    }
    triangles = own_triangles;

    for (std::size_t i = 0; something_moves && i < platforms.size(); ++i) {
        Part part = part_of(*level->mesh, [&](FaceId face) { return face_platforms[face] == i; });
        if (const Status status = add_moving(i, std::move(part)); !status) return status;
    }
    make_room();
    return {};
}

Status LevelScene::Impl::add_moving(std::size_t platform, Part part) {
    Result<CollisionWorld> rest = CollisionWorld::build_movable({part.rest, part.corners, part.faces});
    if (!rest) return Error{level->mesh_path.string(), rest.error().text()};
    moving.push_back({.index = platform,
                      .faces = std::move(part.faces),
                      .triangles = std::move(part.triangles),
                      .rest = std::make_shared<CollisionWorld>(std::move(*rest))});
    paint(moving.back());
    return {};
}

void LevelScene::Impl::paint(const Moving& moved) const {
    apply_surface_rules(*moved.rest, level->surfaces);
    for (const FaceId face : moved.faces)
        moved.rest->set_face_surface(face, surfaces[face]);
}

void LevelScene::Impl::make_room() {
    parts.resize(moving.size());
    rooms.resize(moving.size());
    for (std::size_t i = 0; i < moving.size(); ++i) {
        rooms[i] = platform_reach(level->platforms[moving[i].index], moving[i].rest->bounds());
        parts[i].rest = moving[i].rest.get();
        parts[i].triangles = moving[i].triangles;
    }
    tree.build(rooms);
}

LevelScene::LevelScene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LevelScene::LevelScene(LevelScene&&) noexcept = default;
LevelScene& LevelScene::operator=(LevelScene&&) noexcept = default;
LevelScene::~LevelScene() = default;

Result<LevelScene> LevelScene::build(const Level& level, const MovementSettings& settings) {
    auto impl = std::make_unique<Impl>();
    impl->level = &level;
    impl->choose_origin(settings);
    if (const Status status = impl->build(nullptr); !status) return status.error();
    return LevelScene(std::move(impl));
}

Result<LevelScene> LevelScene::borrow(const Level& level, const CollisionWorld& whole,
                                      const MovementSettings& settings) {
    auto impl = std::make_unique<Impl>();
    impl->level = &level;
    impl->choose_origin(settings);
    if (const Status status = impl->build(&whole); !status) return status.error();
    return LevelScene(std::move(impl));
}

LevelScene LevelScene::for_another_thread() const {
    const Impl& from = *impl_;
    auto impl = std::make_unique<Impl>();
    impl->level = from.level;
    impl->fixed = from.fixed != nullptr ? from.fixed : &from.own;
    impl->triangles = from.triangles;
    impl->face_platforms = from.face_platforms;
    impl->surfaces = from.surfaces;
    impl->heightfield = from.heightfield;
    impl->sectors = from.sectors;
    impl->offset = from.offset;
    impl->moving = from.moving;
    impl->make_room();
    return LevelScene(std::move(impl));
}

MovementScene LevelScene::at(double time_s, double dt) {
    Impl& impl = *impl_;
    for (std::size_t i = 0; i < impl.moving.size(); ++i) {
        const Platform& platform = impl.level->platforms[impl.moving[i].index];
        const double axis = platform.spin_axis.norm();
        MovingPart& part = impl.parts[i];
        part.begin = pose(i, time_s);
        part.end = dt > 0.0 ? pose(i, time_s + dt) : part.begin;
        part.pivot = part.end.apply(platform.spin_pivot);
        part.velocity = Vec3::Zero();
        if (dt > 0.0) part.velocity = (part.pivot - part.begin.apply(platform.spin_pivot)) / dt;
        if (axis > 0.0) part.angular_velocity = platform.spin_axis * (platform.spin_rate / axis);
        impl.rooms[i] = room_of(part);
    }
    impl.tree.refit(impl.rooms);
    const CollisionWorld& fixed = impl.fixed != nullptr ? *impl.fixed : impl.own;
    return {.collision = fixed,
            .surfaces = impl.level->surfaces,
            .platforms = impl.parts,
            .tree = impl.moving.empty() ? nullptr : &impl.tree,
            .heightfield = impl.heightfield,
            .sectors = impl.sectors,
            .triangles = impl.triangles};
}

void LevelScene::apply_surfaces() {
    Impl& impl = *impl_;
    if (impl.fixed == nullptr) slipface::apply_surfaces(impl.own, *impl.level);
    if (!impl.moving.empty()) impl.surfaces = resolve_surfaces(*impl.level).surface;
    for (const Moving& moved : impl.moving)
        impl.paint(moved);
}

void LevelScene::try_surface(std::span<const FaceId> faces, SurfaceId type) {
    Impl& impl = *impl_;
    const auto paint = [&](CollisionWorld& world, FaceId face) {
        impl.tried.push_back({&world, face, world.face_surface(face)});
        world.set_face_surface(face, type);
    };
    for (const FaceId face : faces) {
        const bool moves = face < impl.face_platforms.size() && impl.face_platforms[face] != no_id;
        if (!moves) {
            paint(impl.own, face);
            continue;
        }
        for (const Moving& moved : impl.moving)
            if (moved.index == impl.face_platforms[face]) paint(*moved.rest, face);
    }
}

void LevelScene::end_trial() {
    for (std::vector<Impl::Tried>& tried = impl_->tried; !tried.empty(); tried.pop_back())
        tried.back().world->set_face_surface(tried.back().face, tried.back().before);
}

std::optional<SurfaceId> LevelScene::nothing() {
    const std::size_t id = impl_->level->surfaces.size();
    if (id > std::numeric_limits<SurfaceId>::max()) return std::nullopt;
    const auto type = static_cast<SurfaceId>(id);
    constexpr SurfaceRule gone{.solid = false};
    impl_->own.set_surface_rule(type, gone);
    for (const Moving& moved : impl_->moving)
        moved.rest->set_surface_rule(type, gone);
    return type;
}

bool LevelScene::is_static() const {
    return impl_->moving.empty();
}

std::size_t LevelScene::platform_count() const {
    return impl_->moving.size();
}

std::span<const std::uint32_t> LevelScene::face_platforms() const {
    return impl_->face_platforms;
}

// The level's own motion, moved by the offset.
Pose LevelScene::pose(std::size_t platform, double time_s) const {
    Pose pose = platform_pose(impl_->level->platforms[platform], time_s);
    pose.offset += impl_->offset;
    return pose;
}

std::optional<double> LevelScene::fall_limit() const {
    const std::optional<double>& limit = impl_->level->fall_limit;
    return limit ? std::optional(*limit + impl_->offset.y()) : std::nullopt;
}

Vec3 LevelScene::offset() const {
    return impl_->offset;
}

Vec3 LevelScene::to_level(const MovementScene& scene, const PlayerState& state) const {
    return position_in_scene(scene, state) - impl_->offset;
}

Vec3 LevelScene::to_level(const PlayerState& state) const {
    const CollisionWorld nothing;
    return to_level({.collision = nothing, .surfaces = {}, .sectors = impl_->sectors}, state);
}

PlayerState LevelScene::player_at(const Vec3& level_position) {
    const CollisionWorld nothing;
    PlayerState state;
    put_in_scene({.collision = nothing, .surfaces = {}, .sectors = impl_->sectors}, to_scene(level_position),
                 state);
    return state;
}

}  // namespace slipface
