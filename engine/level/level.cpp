#include "slipface/level/level.h"

#include <algorithm>

#include "mesh_collision.h"
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

ResolvedSurfaces resolve_surfaces(const Level& level) {
    ResolvedSurfaces resolved;
    if (!level.mesh) return resolved;
    const Mesh& mesh = *level.mesh;
    std::vector<MaterialSurface> by_material;
    by_material.reserve(mesh.materials.size());
    for (const Material& material : mesh.materials)
        by_material.push_back(material_surface(level, material.name));

    resolved.surface.resize(mesh.face_count());
    resolved.source.resize(mesh.face_count());
    std::vector<std::optional<SurfaceId>> by_prop;
    for (const Prop& prop : level.props)
        by_prop.push_back(prop.type.empty() ? std::nullopt : find_surface(level, prop.type));
    for (std::size_t face = 0; face < mesh.face_count(); ++face) {
        MaterialSurface found = by_material[mesh.face_material[face]];
        const std::uint32_t prop = level.placed.prop_of(static_cast<FaceId>(face));
        if (prop < by_prop.size() && by_prop[prop]) found = {*by_prop[prop], SurfaceSource::prop};
        if (face < level.overrides.size()) {
            const std::optional<SurfaceId>& painted = level.overrides[face];
            if (painted && *painted < level.surfaces.size()) found = {*painted, SurfaceSource::override_};
        }
        resolved.surface[face] = found.surface;
        resolved.source[face] = found.source;
    }
    return resolved;
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
    const std::vector<Instance> props = prop_instances(level, Vec3::Zero(), [](std::size_t) { return true; });
    Result<CollisionWorld> world =
        build_mesh_collision(has_instances(level) ? *own_mesh(level) : *level.mesh, props);
    if (!world) return Error{level.mesh_path.string(), world.error().text()};
    apply_surfaces(*world, level);
    return world;
}

void apply_surfaces(CollisionWorld& world, const Level& level) {
    apply_surface_rules(world, level.surfaces);
    world.set_face_surfaces(resolve_surfaces(level).surface);
}

}  // namespace slipface
