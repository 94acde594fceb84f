// Props: reading their meshes once, and making them part of the level's geometry.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "json_text.h"
#include "mesh_collision.h"
#include "placed_geometry.h"
#include "slipface/base/hash.h"
#include "slipface/base/named_file.h"
#include "slipface/base/system.h"
#include "slipface/level/level.h"
#include "slipface/level/prop_materials.h"
#include "slipface/mesh/build.h"
#include "slipface/mesh/material_looks.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_warnings_of_mesh = 5;
// What collision takes (TriangleSoup). More triangles than this are never placed.
constexpr std::size_t max_triangles = std::size_t{1} << 25;

bool within(const Vec3& value, double smallest, double largest) {
    const Vec3 size = value.cwiseAbs();
    return value.allFinite() && size.minCoeff() >= smallest && size.maxCoeff() <= largest;
}

std::string prop_problem(const Prop& prop) {
    if (prop.name.empty()) return "A prop needs a name";
    if (prop.mesh.empty()) return "A prop needs a mesh";
    if (!within(prop.position, 0.0, farthest_prop)) return "A prop's position lies within 1e7 m";
    if (!within(prop.rotation, 0.0, largest_prop_rotation)) return "A prop's rotation is at most 1000 rad";
    if (!within(prop.scale, smallest_prop_scale, largest_prop_scale))
        return "A prop's scale is 0.001 to 1000 along each axis, or negative to mirror it";
    return {};
}

fs::path geometry_folder(const Level& level) {
    return (level.mesh_path.empty() ? level.file_path : level.mesh_path).parent_path();
}

PropMesh read_mesh(const fs::path& folder, const std::string& file, Warnings& warnings) {
    PropMesh read{file, nullptr, nullptr, {}};
    const NamedFile path = named_file(file, folder);
    if (!path) {
        read.problem = path.error().message;
    } else if (Result<ImportedMesh> imported = import_mesh(path.path, max_warnings_of_mesh); !imported) {
        read.problem = imported.error().text();
    } else if (auto shared = build_shared_collision(*imported->mesh); !shared) {
        read.problem = shared.error().text();
    } else {
        read.collision = std::move(*shared);
        read.mesh = std::move(imported->mesh);
        std::move(imported->warnings.begin(), imported->warnings.end(), std::back_inserter(warnings));
    }
    return read;
}

// The meshes that the props name. Those that are known are not read again.
std::vector<PropMesh> read_meshes(const Level& level, Warnings& warnings) {
    std::unordered_set<std::string_view> named;
    for (const Prop& prop : level.props)
        named.insert(prop.mesh);
    std::vector<PropMesh> meshes;
    for (const std::string_view name : std::set(named.begin(), named.end())) {
        const std::string file(name);
        const auto known = std::ranges::find(level.placed.meshes, file, &PropMesh::file);
        if (known != level.placed.meshes.end() && known->mesh)
            meshes.push_back(*known);
        else if (meshes.size() == max_prop_meshes)
            meshes.push_back(
                {file, nullptr, nullptr, fmt::format("props name more than {} meshes", max_prop_meshes)});
        else
            meshes.push_back(read_mesh(geometry_folder(level), file, warnings));
    }
    return meshes;
}

// Appends props to a mesh that has the level's own faces.
class Placer {
  public:
    explicit Placer(Mesh& to) : to_(to) {
        for (const Material& material : to.materials)
            looks_.add(material);
        for (const std::uint32_t number : to.vertex_number)
            next_number_ = std::max(next_number_, number + 1);
    }

    // `file`: of the mesh.
    void place(const PlacedGeometry::One& prop, const std::string& file, const Placement& placement,
               const Mesh& from) {
        const auto group = static_cast<std::uint32_t>(to_.groups.size());
        const auto first_vertex = static_cast<std::uint32_t>(to_.positions.size());
        const auto first_face = static_cast<FaceId>(to_.face_count());
        const auto first_corner = static_cast<std::uint32_t>(to_.corner_vertex.size());
        const auto first_triangle = static_cast<std::uint32_t>(to_.triangles.size());
        const std::uint32_t first_material = materials_of(file, prop.texture, from);
        const bool mirrors = placement.mirrors();
        to_.groups.push_back(prop.name);
        for (const Vec3f& rest : from.positions) {
            to_.positions.push_back(placement.apply(rest));
            to_.bounds.add(to_.positions.back().cast<double>());
            if (!to_.vertex_number.empty()) to_.vertex_number.push_back(next_number_++);
        }
        // Where a corner of the mesh went, in its face.
        const auto corner_in = [&](FaceId face, std::uint32_t corner) {
            const std::uint32_t begin = from.face_first_corner[face], end = from.face_first_corner[face + 1];
            return mirrors ? begin + (end - 1 - corner) : corner;
        };
        for (FaceId face = 0; face < from.face_count(); ++face) {
            for (std::uint32_t i = from.face_first_corner[face]; i < from.face_first_corner[face + 1]; ++i) {
                const std::uint32_t corner = corner_in(face, i);
                to_.corner_vertex.push_back(first_vertex + from.corner_vertex[corner]);
                to_.corner_uv.push_back(from.corner_uv[corner]);
            }
            to_.face_first_corner.push_back(first_corner + from.face_first_corner[face + 1]);
            to_.face_material.push_back(first_material + from.face_material[face]);
            to_.face_group.push_back(group);
            to_.face_first_triangle.push_back(first_triangle + from.face_first_triangle[face + 1]);
        }
        for (std::size_t t = 0; t < from.triangle_count(); ++t) {
            const FaceId face = from.triangle_face[t];
            auto [a, b, c] = from.triangles[t];
            if (mirrors) std::swap(b, c);
            to_.triangles.push_back({first_corner + corner_in(face, a), first_corner + corner_in(face, b),
                                     first_corner + corner_in(face, c)});
            to_.triangle_face.push_back(first_face + face);
        }
    }

  private:
    // The materials of a mesh are added once, and once more for each other texture.
    std::uint32_t materials_of(const std::string& file, const std::string& texture, const Mesh& from) {
        const auto [entry, added] =
            materials_.try_emplace({file, texture}, static_cast<std::uint32_t>(to_.materials.size()));
        if (!added) return entry->second;
        for (Material& material : prop_materials(from, file, texture)) {
            looks_.name(material);
            to_.materials.push_back(std::move(material));
        }
        return entry->second;
    }

    Mesh& to_;
    std::uint32_t next_number_ = 0;  // of a vertex, beyond those of the geometry's file
    // First of a mesh with a texture.
    std::map<std::pair<std::string, std::string>, std::uint32_t> materials_;
    MaterialLooks looks_;
};

}  // namespace

std::vector<Material> prop_materials(const Mesh& mesh, const std::string& file, const std::string& texture) {
    const fs::path folder = path_of(file).parent_path();
    std::vector<Material> materials = mesh.materials;
    for (Material& material : materials) {
        if (!texture.empty()) {
            material.texture = texture;
            material.picture = nullptr;
            material.diffuse = Vec3f::Ones();
        } else if (!material.texture.empty() && !material.picture) {
            material.texture = (folder / path_of(material.texture)).generic_string();
        }
    }
    return materials;
}

MeshPtr drawn_prop_mesh(const MeshPtr& mesh, const std::string& file, const std::string& texture) {
    const bool has_files = std::ranges::any_of(mesh->materials, [](const Material& material) {
        return !material.texture.empty() && !material.picture;
    });
    if (texture.empty() && (!has_files || path_of(file).parent_path().empty())) return mesh;
    auto drawn = std::make_shared<Mesh>(*mesh);
    drawn->materials = prop_materials(*mesh, file, texture);
    return drawn;
}

std::string props_problem(std::span<const Prop> props) {
    if (props.size() > max_props) return fmt::format("A level has at most {} props", max_props);
    std::unordered_set<std::string_view> names(2 * props.size());
    for (const Prop& prop : props) {
        if (std::string problem = prop_problem(prop); !problem.empty()) return problem;
        if (!names.insert(prop.name).second) return "Another prop has this name";
    }
    return {};
}

std::uint32_t PlacedProps::prop_of(FaceId face) const {
    if (first_face.empty() || face < first_face.front() || face >= first_face.back()) return no_id;
    const auto after = std::upper_bound(first_face.begin(), first_face.end(), face);
    return static_cast<std::uint32_t>(after - first_face.begin() - 1);
}

namespace {

Aabb box_of(const Mesh& mesh, const Placement& placement) {
    Aabb box;
    for (const Vec3f& rest : mesh.positions)
        box.add(placement.apply(rest).cast<double>());
    return box;
}

bool stands_there(const PlacedGeometry& before, std::size_t prop, const Prop& now, const Mesh* mesh) {
    if (prop >= before.props.size() || before.mesh(prop) != mesh) return false;
    const PlacedGeometry::One& was = before.props[prop];
    return was.position == now.position && was.rotation == now.rotation && was.scale == now.scale;
}

std::uint64_t fingerprint_of(const PlacedGeometry& placed, const Mesh& own) {
    Hasher hasher;
    hasher.u64(own.fingerprint);
    for (std::size_t i = 0; i < placed.props.size(); ++i) {
        if (placed.mesh(i) == nullptr) continue;
        hasher.u64(placed.mesh(i)->fingerprint);
        for (const Vec3* numbers :
             {&placed.props[i].position, &placed.props[i].rotation, &placed.props[i].scale})
            for (int axis = 0; axis < 3; ++axis)
                hasher.f64((*numbers)[axis]);
    }
    return hasher.value();
}

void place(const PlacedGeometry& placed, std::size_t prop, Placer& placer) {
    placer.place(placed.props[prop], placed.files[placed.file_of[prop]].file, placed.places[prop],
                 *placed.mesh(prop));
}

MeshPtr make_whole(const PlacedGeometry& placed, const Mesh& own) {
    auto all = std::make_shared<Mesh>(own);
    Placer placer(*all);
    for (std::size_t i = 0; i < placed.props.size(); ++i)
        if (placed.mesh(i) != nullptr) place(placed, i, placer);
    all->fingerprint = placed.fingerprint;
    return all;
}

}  // namespace

const MeshPtr& LevelMesh::whole() const {
    if (!placed_) return own_;
    std::call_once(placed_->once, [this] { placed_->whole = make_whole(*placed_, *own_); });
    return placed_->whole;
}

std::size_t LevelMesh::face_count() const {
    if (placed_) return placed_->first_face.back();
    return own_ ? own_->face_count() : 0;
}

std::size_t LevelMesh::triangle_count() const {
    if (placed_) return placed_->triangles;
    return own_ ? own_->triangle_count() : 0;
}

Aabb LevelMesh::bounds() const {
    if (placed_) return placed_->bounds;
    return own_ ? own_->bounds : Aabb();
}

std::uint64_t LevelMesh::fingerprint() const {
    if (placed_) return placed_->fingerprint;
    return own_ ? own_->fingerprint : 0;
}

namespace {

std::size_t prop_of(const PlacedGeometry& placed, FaceId face) {
    const auto after = std::ranges::upper_bound(placed.first_face, face);
    return static_cast<std::size_t>(after - placed.first_face.begin() - 1);
}

}  // namespace

const std::string& LevelMesh::group_of(FaceId face) const {
    if (placed_ && face >= placed_->first_face.front()) return placed_->props[prop_of(*placed_, face)].name;
    return own_->groups[own_->face_group[face]];
}

const std::string& LevelMesh::material_of(FaceId face) const {
    const bool is_own = !placed_ || face < placed_->first_face.front();
    const std::size_t prop = is_own ? 0 : prop_of(*placed_, face);
    const Mesh& mesh = is_own ? *own_ : *placed_->mesh(prop);
    return mesh.materials[mesh.face_material[is_own ? face : face - placed_->first_face[prop]]].name;
}

const MeshPtr& own_mesh(const Level& level) {
    return level.mesh.own();
}

Warnings place_props(Level& level) {
    Warnings warnings;
    const std::shared_ptr<const PlacedGeometry> before = level.mesh.placed();
    level.mesh = LevelMesh(level.mesh.own());
    level.placed.meshes = read_meshes(level, warnings);
    level.placed.first_face.clear();
    const std::string location = level.file_path.string() + ":/props";
    for (const PropMesh& mesh : level.placed.meshes)
        if (!mesh.mesh)
            warnings.push_back({location, fmt::format("\"{}\": {}", json_excerpt(mesh.file), mesh.problem)});
    if (level.props.empty() || !level.mesh) return warnings;
    const Mesh& own = *level.mesh.own();
    auto placed = std::make_shared<PlacedGeometry>();
    placed->props.reserve(level.props.size());
    for (const Prop& prop : level.props)
        placed->props.push_back({prop.name, prop.texture, prop.position, prop.rotation, prop.scale});
    placed->triangles = own.triangle_count();
    placed->bounds = own.bounds;
    placed->files = level.placed.meshes;
    placed->file_of.reserve(level.props.size());
    placed->places.reserve(level.props.size());
    placed->boxes.reserve(level.props.size());
    std::unordered_map<std::string_view, std::uint32_t> file_of;
    for (std::uint32_t i = 0; i < placed->files.size(); ++i)
        file_of[placed->files[i].file] = i;
    std::size_t left_out = 0, faces = own.face_count();
    std::size_t next = 0;  // that which is probably the same prop among those before
    for (const Prop& prop : level.props) {
        placed->first_face.push_back(static_cast<FaceId>(faces));
        const std::uint32_t file = file_of.at(prop.mesh);
        const Mesh* mesh = placed->files[file].mesh.get();
        if (mesh != nullptr &&
            mesh->triangle_count() > max_triangles - std::min(max_triangles, placed->triangles)) {
            ++left_out;
            mesh = nullptr;
        }
        placed->file_of.push_back(mesh != nullptr ? file : no_id);
        placed->places.emplace_back();
        placed->boxes.emplace_back();
        if (mesh == nullptr) continue;
        const auto was = [&](std::size_t k) { return before && stands_there(*before, k, prop, mesh); };
        // One may have gone, or come.
        if (!was(next)) next = was(next + 1) ? next + 1 : next > 0 && was(next - 1) ? next - 1 : next;
        Aabb& box = placed->boxes.back();
        Placement& place = placed->places.back();
        const bool stays = was(next);
        place = stays ? before->places[next] : prop.placement();
        box = stays ? before->boxes[next] : box_of(*mesh, place);
        ++next;
        if (!box.empty()) {
            placed->bounds.add(box.min);
            placed->bounds.add(box.max);
        }
        placed->triangles += mesh->triangle_count();
        faces += mesh->face_count();
    }
    placed->first_face.push_back(static_cast<FaceId>(faces));
    if (left_out > 0)
        warnings.push_back({location, fmt::format("{} props are left out: a level has at most {} triangles",
                                                  left_out, max_triangles)});
    placed->fingerprint = fingerprint_of(*placed, own);
    level.placed.first_face = placed->first_face;
    level.mesh = LevelMesh(level.mesh.own(), std::move(placed));
    return warnings;
}

const PropMesh* find_prop_mesh(const Level& level, std::string_view file) {
    const auto found = std::ranges::lower_bound(level.placed.meshes, file, std::less<>(), &PropMesh::file);
    return found != level.placed.meshes.end() && found->file == file ? &*found : nullptr;
}

bool has_instances(const Level& level) {
    return level.mesh.placed() != nullptr;
}

MeshPtr prop_mesh(const Level& level, std::size_t prop) {
    const PlacedGeometry* const placed = level.mesh.placed().get();
    if (placed == nullptr || prop >= placed->props.size() || placed->mesh(prop) == nullptr) return nullptr;
    auto alone = std::make_shared<Mesh>();
    alone->face_first_corner = alone->face_first_triangle = {0};
    Placer placer(*alone);
    place(*placed, prop, placer);
    return alone;
}

TriangleId prop_first_triangle(const Level& level, std::size_t prop) {
    std::size_t first = own_mesh(level)->triangle_count();
    const PlacedGeometry* const placed = level.mesh.placed().get();
    for (std::size_t i = 0; placed != nullptr && i < std::min(prop, placed->props.size()); ++i)
        if (placed->mesh(i) != nullptr) first += placed->mesh(i)->triangle_count();
    return static_cast<TriangleId>(first);
}

Aabb prop_bounds(const Level& level, std::size_t prop) {
    const PlacedGeometry* const placed = level.mesh.placed().get();
    return placed != nullptr && prop < placed->boxes.size() ? placed->boxes[prop] : Aabb();
}

bool has_group(const Level& level, std::string_view group) {
    if (!level.mesh) return false;
    if (std::ranges::count(level.mesh.own()->groups, group) > 0) return true;
    const PlacedGeometry* const placed = level.mesh.placed().get();
    if (placed == nullptr) return false;
    const auto found = std::ranges::find(placed->props, group, &PlacedGeometry::One::name);
    return found != placed->props.end() &&
           placed->mesh(static_cast<std::size_t>(found - placed->props.begin())) != nullptr;
}

std::vector<Instance> prop_instances(const Level& level, const SurfaceParts& types, const Vec3& offset,
                                     const std::function<bool(std::size_t)>& wanted) {
    std::vector<Instance> instances;
    const PlacedGeometry* const placed = level.mesh.placed().get();
    if (placed == nullptr) return instances;
    for (std::size_t i = 0; i < placed->props.size(); ++i) {
        if (placed->mesh(i) == nullptr || placed->mesh(i)->triangle_count() == 0 || !wanted(i)) continue;
        Placement placement = placed->places[i];
        placement.offset += offset;
        Instance instance{placed->files[placed->file_of[i]].collision, placement, placed->first_face[i],
                          nullptr};
        if (i < types.props.size() && types.props[i])
            instance.surfaces = {types.props[i], &types.props[i]->surface};
        instances.push_back(std::move(instance));
    }
    return instances;
}

Level without_props(const Level& level) {
    Level own = level;
    own.mesh = own_mesh(level);
    own.props.clear();
    own.placed = {};
    const std::size_t faces = own.mesh.face_count();
    own.overrides.resize(faces);
    const auto keep_own = [&](std::vector<FaceId>& list) {
        std::erase_if(list, [&](FaceId face) { return face >= faces; });
    };
    keep_own(own.hidden);
    keep_own(own.guessed);
    for (SavedSelection& saved : own.selections)
        keep_own(saved.faces);
    return own;
}

Level with_flat_props(const Level& level) {
    Level flat = level;
    if (level.props.empty()) return flat;
    const ResolvedSurfaces resolved = resolve_surfaces(level);
    flat.overrides.resize(resolved.surface.size());
    for (std::size_t face = 0; face < resolved.surface.size(); ++face)
        if (resolved.source[face] == SurfaceSource::prop) flat.overrides[face] = resolved.surface[face];
    flat.mesh = level.mesh.whole();
    flat.props.clear();
    flat.placed = {};
    return flat;
}

}  // namespace slipface
