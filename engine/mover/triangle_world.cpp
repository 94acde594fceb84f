#include <algorithm>
#include <numeric>

#include "calls.h"
#include "slipface/collision/collision_world.h"

using namespace slipface;
using namespace slipface::c;

namespace {

// The triangles of a caller, checked and with corners of their own.
struct Corners {
    std::vector<Vec3f> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<FaceId> faces;

    CollisionWorld world(bool movable = false) const {
        const TriangleSoup soup{positions, triangles, faces};
        Result<CollisionWorld> built =
            movable ? CollisionWorld::build_movable(soup) : CollisionWorld::build(soup);
        if (!built) refuse(SLIPFACE_WRONG_ARGUMENT, built.error());
        return std::move(*built);
    }
};

slipface_triangles triangles_of(const slipface_triangles* from) {
    need("triangles", from);
    return taken(*from, "triangles");
}

Corners corners_of(const slipface_triangles* from, const std::vector<SurfaceType>& types) {
    constexpr std::size_t most = std::size_t{1} << 25;
    if (from->triangle_count > most || from->position_count > 3 * most)
        refuse(SLIPFACE_WRONG_ARGUMENT, "found {} triangles and {} positions, expected at most {} and {}",
               from->triangle_count, from->position_count, most, 3 * most);
    if (from->triangle_count > 0) need("positions and indices", from->positions, from->indices);
    Corners made;
    made.positions.reserve(from->position_count);
    for (std::size_t i = 0; i < from->position_count && from->positions != nullptr; ++i)
        made.positions.emplace_back(from->positions[3 * i], from->positions[3 * i + 1],
                                    from->positions[3 * i + 2]);
    for (std::size_t i = 0; i < from->triangle_count; ++i) {
        const std::uint32_t* const at = from->indices + 3 * i;
        for (int k = 0; k < 3; ++k)
            if (at[k] >= made.positions.size())
                refuse(SLIPFACE_WRONG_ARGUMENT, "triangle {}: found the position {}, expected one below {}",
                       i, at[k], made.positions.size());
        if (from->types != nullptr && from->types[i] >= types.size())
            refuse(SLIPFACE_WRONG_ARGUMENT, "triangle {}: found the type {}, expected one below {}", i,
                   from->types[i], types.size());
        made.triangles.push_back({at[0], at[1], at[2]});
    }
    made.faces.resize(made.triangles.size());
    std::iota(made.faces.begin(), made.faces.end(), FaceId{0});
    return made;
}

void paint(CollisionWorld& world, const slipface_triangles* from, const std::vector<SurfaceType>& types) {
    apply_surface_rules(world, types);
    for (std::size_t i = 0; i < from->triangle_count && from->types != nullptr; ++i)
        world.set_face_surface(static_cast<FaceId>(i), from->types[i]);
}

std::vector<std::uint32_t> groups_of(const slipface_triangles* from) {
    return from->groups == nullptr
               ? std::vector<std::uint32_t>{}
               : std::vector<std::uint32_t>(from->groups, from->groups + from->triangle_count);
}

// A platform: its mesh at rest.
struct PlatformBody {
    std::vector<std::uint32_t> groups;
    std::unique_ptr<CollisionWorld> rest;
};

struct TriangleWorld final : World {
    CollisionWorld collision;
    std::vector<SurfaceType> surfaces = preset_surface_types();
    std::vector<std::uint32_t> groups;  // [triangle]; empty: all are in all
    std::vector<PlatformBody> platforms;
    std::vector<MovingPart> parts;
    PlatformTree tree;  // of `parts`

    void see() {
        for (std::size_t i = 0; i < parts.size(); ++i)
            parts[i].groups = platforms[i].groups;
        now.emplace(MovementScene{.collision = collision,
                                  .surfaces = surfaces,
                                  .platforms = parts,
                                  .tree = &tree,
                                  .groups = groups});
    }
    std::vector<SurfaceType>& types() override { return surfaces; }
    void types_changed() override {
        apply_surface_rules(collision, surfaces);
        for (const PlatformBody& platform : platforms)
            apply_surface_rules(*platform.rest, surfaces);
        see();
    }
    std::size_t face_count() const override { return collision.triangle_count(); }
    void set_face_type(FaceId face, SurfaceId type) override { collision.set_face_surface(face, type); }
};

TriangleWorld& of_triangles(World& world, const char* what) {
    auto* const made = dynamic_cast<TriangleWorld*>(&world);
    if (made == nullptr)
        refuse(SLIPFACE_WRONG_ARGUMENT, "{}: found the world of a level, expected one of triangles", what);
    return *made;
}

void need_type(const World& world, std::uint32_t type) {
    if (type >= world.now->surfaces.size())
        refuse(SLIPFACE_WRONG_ARGUMENT, "found the type {}, expected one below {}", type,
               world.now->surfaces.size());
}

void need_platform(const TriangleWorld& world, std::uint32_t platform) {
    if (platform >= world.platforms.size())
        refuse(SLIPFACE_WRONG_ARGUMENT, "found the platform {}, expected one below {}", platform,
               world.platforms.size());
}

Pose pose_of(const slipface_vec3& position, const double* rotation) {
    Pose pose;
    pose.offset = finite(position, "position");
    if (rotation == nullptr) return pose;
    double square = 0.0;
    for (int i = 0; i < 4; ++i)
        square += rotation[i] * rotation[i];
    if (!std::isfinite(square) || !(square > 1e-12))
        refuse(SLIPFACE_WRONG_ARGUMENT, "rotation: found ({}, {}, {}, {}), expected a quaternion",
               rotation[0], rotation[1], rotation[2], rotation[3]);
    const double scale = 2.0 / square;
    const double x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
    pose.columns[0] = {1.0 - scale * (y * y + z * z), scale * (x * y + w * z), scale * (x * z - w * y)};
    pose.columns[1] = {scale * (x * y - w * z), 1.0 - scale * (x * x + z * z), scale * (y * z + w * x)};
    pose.columns[2] = {scale * (x * z + w * y), scale * (y * z - w * x), 1.0 - scale * (x * x + y * y)};
    return pose;
}

// Of the turn from one pose to another: the axis times the sine of the angle, which for the small turns of a
// tick is the angle.
Vec3 turn_of(const Pose& begin, const Pose& end) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
        sum += begin.columns[k].cross(end.columns[k]);
    return 0.5 * sum;
}

}  // namespace

slipface_status slipface_world_from_triangles(const slipface_triangles* triangles, slipface_world* world,
                                              slipface_error* error) {
    return run(error, [&] {
        need("world", world);
        auto made = std::make_unique<TriangleWorld>();
        const slipface_triangles given = triangles_of(triangles);
        made->collision = corners_of(&given, made->surfaces).world();
        paint(made->collision, &given, made->surfaces);
        made->groups = groups_of(&given);
        made->see();
        world->id = handle_of(Kind::world, std::move(made));
    });
}

slipface_status slipface_world_free(slipface_world world, slipface_error* error) {
    return run(error, [&] {
        const slipface_status status = free_handle(Kind::world, world.id);
        if (status != SLIPFACE_OK) (void)ChangedWorld(world.id), refuse(status, "in use");
    });
}

slipface_status slipface_world_bounds(slipface_world world, slipface_vec3* lowest, slipface_vec3* highest,
                                      size_t* triangle_count, slipface_error* error) {
    return run(error, [&] {
        need("lowest, highest and triangle_count", lowest, highest, triangle_count);
        const SharedWorld in(world.id);
        const Aabb bounds = in->now->collision.bounds();
        *lowest = vec(bounds.min);
        *highest = vec(bounds.max);
        *triangle_count = in->now->collision.triangle_count();
    });
}

slipface_status slipface_world_find_type(slipface_world world, const char* name, uint32_t* type,
                                         slipface_error* error) {
    return run(error, [&] {
        need("name and type", name, type);
        const SharedWorld in(world.id);
        const SurfaceTable types = in->now->surfaces;
        const auto found = std::ranges::find(types, std::string_view(name), &SurfaceType::name);
        *type = found == types.end() ? SLIPFACE_NONE : static_cast<std::uint32_t>(found - types.begin());
    });
}

slipface_status slipface_world_add_type(slipface_world world, const char* name, uint32_t* type,
                                        slipface_error* error) {
    return run(error, [&] {
        need("name and type", name, type);
        const ChangedWorld in(world.id);
        std::vector<SurfaceType>& types = in->types();
        if (*name == '\0' ||
            std::ranges::find(types, std::string_view(name), &SurfaceType::name) != types.end())
            refuse(SLIPFACE_WRONG_ARGUMENT, "found the name \"{}\", expected one that no type has", name);
        if (types.size() >= max_surface_types)
            refuse(SLIPFACE_WRONG_ARGUMENT, "found {} types, expected at most {}", types.size() + 1,
                   max_surface_types);
        types.push_back({.name = name});
        in->types_changed();
        *type = static_cast<std::uint32_t>(types.size() - 1);
    });
}

slipface_status slipface_world_set_type(slipface_world world, uint32_t type, const char* parameter,
                                        const double* values, size_t value_count, slipface_error* error) {
    return run(error, [&] {
        need("parameter and values", parameter, values);
        const ChangedWorld in(world.id);
        need_type(*in, type);
        const auto fields = surface_fields();
        const auto field = std::ranges::find(fields, std::string_view(parameter), &SurfaceField::name);
        if (field == fields.end()) refuse(SLIPFACE_WRONG_ARGUMENT, "found no parameter \"{}\"", parameter);
        const bool is_vector = std::holds_alternative<Vec3 SurfaceType::*>(field->member);
        if (value_count != (is_vector ? 3u : 1u))
            refuse(SLIPFACE_WRONG_ARGUMENT, "{}: found {} numbers, expected {}", parameter, value_count,
                   is_vector ? 3 : 1);
        for (std::size_t i = 0; i < value_count; ++i)
            if (!(values[i] >= field->minimum && values[i] <= field->maximum) &&
                !std::holds_alternative<bool SurfaceType::*>(field->member))
                refuse(SLIPFACE_WRONG_ARGUMENT, "{}: found {}, expected {} to {}", parameter, values[i],
                       field->minimum, field->maximum);
        SurfaceType& changed = in->types()[type];
        std::visit(
            [&](auto member) {
                using Value = std::remove_cvref_t<decltype(changed.*member)>;
                if constexpr (std::is_same_v<Value, bool>)
                    changed.*member = values[0] != 0.0;
                else if constexpr (std::is_same_v<Value, Vec3>)
                    changed.*member = {values[0], values[1], values[2]};
                else
                    changed.*member = values[0];
            },
            field->member);
        in->types_changed();
    });
}

slipface_status slipface_world_set_face_type(slipface_world world, uint32_t face, uint32_t type,
                                             slipface_error* error) {
    return run(error, [&] {
        const ChangedWorld in(world.id);
        need_type(*in, type);
        if (face >= in->face_count())
            refuse(SLIPFACE_WRONG_ARGUMENT, "found the face {}, expected one below {}", face,
                   in->face_count());
        in->set_face_type(face, static_cast<SurfaceId>(type));
    });
}

slipface_status slipface_world_set_face_groups(slipface_world world, uint32_t platform, uint32_t face,
                                               uint32_t groups, slipface_error* error) {
    return run(error, [&] {
        const ChangedWorld changed(world.id);
        TriangleWorld& in = of_triangles(*changed, "slipface_world_set_face_groups");
        const bool moves = platform != SLIPFACE_NONE;
        if (moves) need_platform(in, platform);
        const std::size_t faces = moves ? in.platforms[platform].rest->triangle_count() : in.face_count();
        if (face >= faces)
            refuse(SLIPFACE_WRONG_ARGUMENT, "found the face {}, expected one below {}", face, faces);
        std::vector<std::uint32_t>& list = moves ? in.platforms[platform].groups : in.groups;
        list.resize(faces, ~std::uint32_t{0});
        list[face] = groups;
        in.see();
    });
}

slipface_status slipface_world_add_platform(slipface_world world, const slipface_triangles* triangles,
                                            uint32_t* platform, slipface_error* error) {
    return run(error, [&] {
        need("platform", platform);
        const ChangedWorld changed(world.id);
        TriangleWorld& in = of_triangles(*changed, "slipface_world_add_platform");
        const slipface_triangles given = triangles_of(triangles);
        const Corners corners = corners_of(&given, in.surfaces);
        PlatformBody made;
        made.rest = std::make_unique<CollisionWorld>(corners.world(true));
        paint(*made.rest, &given, in.surfaces);
        made.groups = groups_of(&given);
        in.parts.emplace_back().rest = made.rest.get();
        in.platforms.push_back(std::move(made));
        std::vector<Aabb> rooms;
        for (const MovingPart& part : in.parts)
            rooms.push_back(room_of(part));
        in.tree.build(rooms);
        in.tree.refit(rooms);
        in.see();
        *platform = static_cast<std::uint32_t>(in.platforms.size() - 1);
    });
}

slipface_status slipface_world_move_platform(slipface_world world, uint32_t platform, slipface_vec3 position,
                                             const double rotation[4], double dt, slipface_error* error) {
    return run(error, [&] {
        const ChangedWorld changed(world.id);
        TriangleWorld& in = of_triangles(*changed, "slipface_world_move_platform");
        need_platform(in, platform);
        if (!(dt >= 1e-4 && std::isfinite(dt)))
            refuse(SLIPFACE_WRONG_ARGUMENT, "dt: found {}, expected 1e-4 or more", dt);
        const Pose pose = pose_of(position, rotation);
        MovingPart& part = in.parts[platform];
        part.begin = part.end;
        part.end = pose;
        part.pivot = pose.offset;
        part.velocity = (pose.offset - part.begin.offset) / dt;
        part.angular_velocity = turn_of(part.begin, pose) / dt;
        in.tree.move(platform, room_of(part));
    });
}
