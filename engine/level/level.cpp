#include "slipface/level/level.h"

#include <algorithm>
#include <map>

#include "mesh_collision.h"
#include "placed_geometry.h"
#include "slipface/base/text.h"
#include "slipface/level/material_name.h"

namespace slipface {
namespace {

struct MaterialSurface {
    SurfaceId surface = default_surface;
    SurfaceSource source = SurfaceSource::none;
};

MaterialSurface material_surface(const Level& level, const std::string& material) {
    if (const auto suffix = suffix_surface(material, level.surfaces)) return {*suffix, SurfaceSource::suffix};
    const std::string name = normal_name(material);
    for (auto rule = level.rules.rbegin(); rule != level.rules.rend(); ++rule) {
        const auto surface = find_surface(level, rule->type);
        if (surface && glob_match(normal_pattern(rule->pattern), name))
            return {*surface, SurfaceSource::rule};
    }
    return {};
}

}  // namespace

const char* surface_source_name(SurfaceSource source) {
    switch (source) {
        case SurfaceSource::none: return "none";
        case SurfaceSource::rule: return "rule";
        case SurfaceSource::suffix: return "suffix";
        case SurfaceSource::prop: return "prop";
        case SurfaceSource::override_: return "override";
    }
    return "none";
}

bool material_matches(std::string_view pattern, std::string_view material) {
    return glob_match(normal_pattern(pattern), normal_name(material));
}

std::optional<SurfaceId> find_surface(const Level& level, std::string_view name) {
    const std::size_t count = std::min(level.surfaces.size(), max_surface_types);
    for (std::size_t i = 0; i < count; ++i) {
        if (level.surfaces[i].name == name) return static_cast<SurfaceId>(i);
    }
    return std::nullopt;
}

namespace {

ResolvedSurfaces types_of(const Level& level, const Mesh& mesh, std::optional<SurfaceId> of_prop) {
    std::vector<MaterialSurface> by_material;
    by_material.reserve(mesh.materials.size());
    for (const Material& material : mesh.materials)
        by_material.push_back(of_prop ? MaterialSurface{*of_prop, SurfaceSource::prop}
                                      : material_surface(level, material.name));
    ResolvedSurfaces resolved;
    resolved.surface.reserve(mesh.face_count());
    resolved.source.reserve(mesh.face_count());
    for (const std::uint32_t material : mesh.face_material) {
        resolved.surface.push_back(by_material[material].surface);
        resolved.source.push_back(by_material[material].source);
    }
    return resolved;
}

// The overrides of the faces from `first` to `end`: put(face, type).
template <class Put>
void for_each_painted(const Level& level, std::size_t first, std::size_t end, const Put& put) {
    for (std::size_t face = first; face < std::min(level.overrides.size(), end); ++face) {
        const std::optional<SurfaceId>& paint = level.overrides[face];
        if (paint && *paint < level.surfaces.size()) put(static_cast<FaceId>(face), *paint);
    }
}

}  // namespace

PropSurfaces resolve_props(const Level& level) {
    PropSurfaces props;
    if (!has_instances(level)) return props;
    const PlacedGeometry& placed = *level.mesh.placed();
    props.resize(placed.props.size());
    std::map<std::pair<std::uint32_t, std::string_view>, std::shared_ptr<const ResolvedSurfaces>> shared;
    for (std::size_t i = 0; i < std::min(props.size(), level.props.size()); ++i) {
        const Mesh* const mesh = placed.mesh(i);
        if (mesh == nullptr || mesh->face_count() == 0) continue;
        const Prop& prop = level.props[i];
        auto& list = shared[{placed.file_of[i], prop.type}];
        if (!list) {
            const auto type = prop.type.empty() ? std::nullopt : find_surface(level, prop.type);
            list = std::make_shared<ResolvedSurfaces>(types_of(level, *mesh, type));
        }
        props[i] = list;
    }
    return props;
}

void paint_props(const Level& level, PropSurfaces& surfaces) {
    if (surfaces.empty()) return;
    std::shared_ptr<ResolvedSurfaces> own;  // the list of the prop `painted`
    std::uint32_t painted = no_id;
    for_each_painted(level, level.placed.first_face.front(), level.placed.first_face.back(),
                     [&](FaceId face, SurfaceId type) {
                         const std::uint32_t prop = level.placed.prop_of(face);
                         if (!surfaces[prop]) return;
                         if (prop != painted) {
                             own = std::make_shared<ResolvedSurfaces>(*surfaces[prop]);
                             surfaces[prop] = own;
                             painted = prop;
                         }
                         own->surface[face - level.placed.first_face[prop]] = type;
                         own->source[face - level.placed.first_face[prop]] = SurfaceSource::override_;
                     });
}

SurfaceParts resolve_parts(const Level& level) {
    SurfaceParts parts;
    if (!level.mesh) return parts;
    parts.own = types_of(level, *own_mesh(level), std::nullopt);
    for_each_painted(level, 0, parts.own.surface.size(), [&](FaceId face, SurfaceId type) {
        parts.own.surface[face] = type;
        parts.own.source[face] = SurfaceSource::override_;
    });
    parts.props = resolve_props(level);
    paint_props(level, parts.props);
    return parts;
}

ResolvedSurfaces joined(const SurfaceParts& parts) {
    ResolvedSurfaces all = parts.own;
    for (const auto& prop : parts.props) {
        if (!prop) continue;
        all.surface.insert(all.surface.end(), prop->surface.begin(), prop->surface.end());
        all.source.insert(all.source.end(), prop->source.begin(), prop->source.end());
    }
    return all;
}

ResolvedSurfaces resolve_surfaces(const Level& level) {
    return joined(resolve_parts(level));
}

namespace {

std::vector<std::array<std::uint32_t, 3>> triangle_vertices(const Mesh& mesh) {
    std::vector<std::array<std::uint32_t, 3>> vertices;
    vertices.reserve(mesh.triangle_count());
    for (const auto& corner : mesh.triangles) {
        vertices.push_back(
            {mesh.corner_vertex[corner[0]], mesh.corner_vertex[corner[1]], mesh.corner_vertex[corner[2]]});
    }
    return vertices;
}

}  // namespace

Result<CollisionWorld> build_mesh_collision(const Mesh& mesh, std::span<const Instance> props) {
    return CollisionWorld::build({mesh.positions, triangle_vertices(mesh), mesh.triangle_face}, props);
}

Result<std::shared_ptr<const CollisionMesh>> build_shared_collision(const Mesh& mesh) {
    return CollisionMesh::build({mesh.positions, triangle_vertices(mesh), mesh.triangle_face});
}

Result<CollisionWorld> build_collision_world(const Level& level) {
    if (!level.mesh) return Error{level.mesh_path.string(), "the level has no geometry"};
    const SurfaceParts types = resolve_parts(level);
    const std::vector<Instance> props =
        prop_instances(level, types, Vec3::Zero(), [](std::size_t) { return true; });
    Result<CollisionWorld> world = build_mesh_collision(*own_mesh(level), props);
    if (!world) return Error{level.mesh_path.string(), world.error().text()};
    apply_surface_rules(*world, level.surfaces);
    world->set_face_surfaces(types.own.surface);
    return world;
}

void apply_surfaces(CollisionWorld& world, const Level& level) {
    apply_surface_rules(world, level.surfaces);
    world.set_face_surfaces(resolve_surfaces(level).surface);
}

}  // namespace slipface
