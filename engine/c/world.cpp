#include <algorithm>
#include <numeric>

#include "calls.h"
#include "slipface/base/system.h"
#include "slipface/level/find_start.h"
#include "slipface/level/level_file.h"

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

Corners corners_of(const slipface_triangles* from, const std::vector<SurfaceType>& types) {
    need("triangles", from);
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

std::vector<SurfaceType>& types_of(World& world) {
    return world.level ? world.level->surfaces : world.types;
}

void types_changed(World& world) {
    if (world.level) {
        world.scene->apply_surfaces();
        return world.see_level();
    }
    apply_surface_rules(world.collision, world.types);
    for (const PlatformBody& platform : world.platforms)
        apply_surface_rules(*platform.rest, world.types);
    world.see_triangles();
}

void need_type(const World& world, std::uint32_t type) {
    if (type >= world.now->surfaces.size())
        refuse(SLIPFACE_WRONG_ARGUMENT, "found the type {}, expected one below {}", type,
               world.now->surfaces.size());
}

slipface_world handle_of(std::unique_ptr<World> world) {
    const std::uint64_t id = new_handle(Kind::world, std::move(world));
    if (id == 0) refuse(SLIPFACE_NO_MEMORY, "too many worlds and settings, expected at most 65536");
    return {id};
}

void need_triangles(const World& world, const char* what) {
    if (world.level)
        refuse(SLIPFACE_WRONG_ARGUMENT, "{}: found the world of a level, expected one of triangles", what);
}
void need_level(const World& world, const char* what) {
    if (!world.level)
        refuse(SLIPFACE_WRONG_ARGUMENT, "{}: found a world of triangles, expected that of a level", what);
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
        auto made = std::make_unique<World>();
        made->types = preset_surface_types();
        made->collision = corners_of(triangles, made->types).world();
        paint(made->collision, triangles, made->types);
        made->groups = groups_of(triangles);
        made->see_triangles();
        *world = handle_of(std::move(made));
    });
}

slipface_status slipface_world_from_level(const char* path, slipface_world* world, slipface_error* error) {
    return run(error, [&] {
        need("path and world", path, world);
        Result<LoadedLevel> loaded = load_level(path_of(path));
        if (!loaded) refuse(SLIPFACE_CANNOT_READ, loaded.error());
        auto made = std::make_unique<World>();
        made->level = std::make_unique<Level>(std::move(loaded->level));
        Result<LevelScene> scene = LevelScene::build(*made->level);
        if (!scene) refuse(SLIPFACE_CANNOT_READ, scene.error());
        made->scene.emplace(std::move(*scene));
        made->see_level();
        *world = handle_of(std::move(made));
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

slipface_status slipface_world_settings(slipface_world world, slipface_settings* settings,
                                        slipface_error* error) {
    return run(error, [&] {
        need("settings", settings);
        auto made = std::make_unique<Settings>();
        {
            const SharedWorld in(world.id);
            need_level(*in, "slipface_world_settings");
            made->values = in->level->movement;
        }
        const std::uint64_t id = new_handle(Kind::settings, std::move(made));
        if (id == 0) refuse(SLIPFACE_NO_MEMORY, "too many worlds and settings, expected at most 65536");
        settings->id = id;
    });
}

slipface_status slipface_world_spawn(slipface_world world, slipface_settings settings, const char* name,
                                     slipface_vec3* position, double* yaw, slipface_error* error) {
    return run(error, [&] {
        need("position and yaw", position, yaw);
        const SharedWorld in(world.id);
        need_level(*in, "slipface_world_spawn");
        const SharedSettings with(settings.id);
        const Vec3 offset = in->scene->offset();
        const Result<Start> start =
            find_start(*in->level, *in->now, offset, with->values, name == nullptr ? "" : name);
        if (!start) refuse(SLIPFACE_WRONG_ARGUMENT, start.error());
        *position = vec(Vec3(start->position + offset));
        *yaw = start->yaw;
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
        std::vector<SurfaceType>& types = types_of(*in);
        if (*name == '\0' ||
            std::ranges::find(types, std::string_view(name), &SurfaceType::name) != types.end())
            refuse(SLIPFACE_WRONG_ARGUMENT, "found the name \"{}\", expected one that no type has", name);
        if (types.size() >= max_surface_types)
            refuse(SLIPFACE_WRONG_ARGUMENT, "found {} types, expected at most {}", types.size() + 1,
                   max_surface_types);
        types.push_back({.name = name});
        types_changed(*in);
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
        SurfaceType& changed = types_of(*in)[type];
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
        types_changed(*in);
    });
}

slipface_status slipface_world_set_face_type(slipface_world world, uint32_t face, uint32_t type,
                                             slipface_error* error) {
    return run(error, [&] {
        const ChangedWorld in(world.id);
        need_type(*in, type);
        const std::size_t faces = in->level ? in->level->mesh.face_count() : in->collision.triangle_count();
        if (face >= faces)
            refuse(SLIPFACE_WRONG_ARGUMENT, "found the face {}, expected one below {}", face, faces);
        if (in->level) {
            in->level->overrides.resize(std::max<std::size_t>(in->level->overrides.size(), face + 1));
            in->level->overrides[face] = static_cast<SurfaceId>(type);
            in->scene->apply_surfaces();
            in->see_level();
        } else {
            in->collision.set_face_surface(face, static_cast<SurfaceId>(type));
        }
    });
}

slipface_status slipface_world_add_platform(slipface_world world, const slipface_triangles* triangles,
                                            uint32_t* platform, slipface_error* error) {
    return run(error, [&] {
        need("platform", platform);
        const ChangedWorld in(world.id);
        need_triangles(*in, "slipface_world_add_platform");
        const Corners corners = corners_of(triangles, in->types);
        PlatformBody made;
        made.rest = std::make_unique<CollisionWorld>(corners.world(true));
        paint(*made.rest, triangles, in->types);
        made.groups = groups_of(triangles);
        in->parts.emplace_back().rest = made.rest.get();
        in->platforms.push_back(std::move(made));
        std::vector<Aabb> rooms;
        for (const MovingPart& part : in->parts)
            rooms.push_back(room_of(part));
        in->tree.build(rooms);
        in->tree.refit(rooms);
        in->see_triangles();
        *platform = static_cast<std::uint32_t>(in->platforms.size() - 1);
    });
}

slipface_status slipface_world_move_platform(slipface_world world, uint32_t platform, slipface_vec3 position,
                                             const double rotation[4], double dt, slipface_error* error) {
    return run(error, [&] {
        const ChangedWorld in(world.id);
        need_triangles(*in, "slipface_world_move_platform");
        if (platform >= in->platforms.size())
            refuse(SLIPFACE_WRONG_ARGUMENT, "found the platform {}, expected one below {}", platform,
                   in->platforms.size());
        if (!(dt >= 1e-4 && std::isfinite(dt)))
            refuse(SLIPFACE_WRONG_ARGUMENT, "dt: found {}, expected 1e-4 or more", dt);
        const Pose pose = pose_of(position, rotation);
        MovingPart& part = in->parts[platform];
        part.begin = part.end;
        part.end = pose;
        part.pivot = pose.offset;
        part.velocity = (pose.offset - part.begin.offset) / dt;
        part.angular_velocity = turn_of(part.begin, pose) / dt;
        in->tree.move(platform, room_of(part));
    });
}

slipface_status slipface_world_set_time(slipface_world world, double time, double dt, slipface_error* error) {
    return run(error, [&] {
        if (!std::isfinite(time) || !(dt >= 0.0) || !std::isfinite(dt))
            refuse(SLIPFACE_WRONG_ARGUMENT,
                   "found the time {} and dt {}, expected finite numbers, dt 0 or more", time, dt);
        const ChangedWorld in(world.id);
        need_level(*in, "slipface_world_set_time");
        in->time = time;
        in->dt = dt;
        in->see_level();
    });
}
