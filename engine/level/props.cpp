// Props: reading their meshes once, and making them part of the level's geometry.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "json_text.h"
#include "mesh_collision.h"
#include "slipface/base/files.h"
#include "slipface/level/level.h"
#include "slipface/mesh/build.h"

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

// Only files in the folder of the level's geometry or below are read, as for textures.
PropMesh read_mesh(const fs::path& folder, const std::string& file, Warnings& warnings) {
    PropMesh read{file, nullptr, nullptr, {}};
    const fs::path path = folder / file;
    std::error_code error;
    if (fs::path(file).is_absolute() || !lies_within(path, folder)) {
        read.problem = "lies outside the level's folder";
    } else if (!fs::exists(path, error)) {
        read.problem = "there is no such file";
    } else if (Result<ImportedMesh> imported = import_mesh(path, max_warnings_of_mesh); !imported) {
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
    std::set<std::string> files;
    for (const Prop& prop : level.props)
        files.insert(prop.mesh);
    std::vector<PropMesh> meshes;
    for (const std::string& file : files) {
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
            looks_.try_emplace(material.name, material);
    }

    bool has_room(const Mesh& from) const {
        return from.triangle_count() <= max_triangles - std::min(max_triangles, to_.triangle_count());
    }

    void place(const Prop& prop, const Mesh& from) {
        const Placement placement = prop.placement();
        const auto group = static_cast<std::uint32_t>(to_.groups.size());
        const auto first_vertex = static_cast<std::uint32_t>(to_.positions.size());
        const auto first_face = static_cast<FaceId>(to_.face_count());
        const auto first_corner = static_cast<std::uint32_t>(to_.corner_vertex.size());
        const auto first_triangle = static_cast<std::uint32_t>(to_.triangles.size());
        const std::uint32_t first_material = materials_of(prop, from);
        const bool mirrors = placement.mirrors();
        to_.groups.push_back(prop.name);
        for (const Vec3f& rest : from.positions) {
            to_.positions.push_back(placement.apply(rest));
            to_.bounds.add(to_.positions.back().cast<double>());
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
    std::uint32_t materials_of(const Prop& prop, const Mesh& from) {
        const auto [entry, added] = materials_.try_emplace({prop.mesh, prop.texture},
                                                           static_cast<std::uint32_t>(to_.materials.size()));
        if (!added) return entry->second;
        const fs::path folder = fs::path(prop.mesh).parent_path();
        for (Material material : from.materials) {
            if (!prop.texture.empty()) {
                material.texture = prop.texture;
                material.picture = nullptr;
                material.diffuse = Vec3f::Ones();
            } else if (!material.texture.empty() && !material.picture) {
                material.texture = (folder / material.texture).generic_string();
            }
            name_by_look(material);
            to_.materials.push_back(std::move(material));
        }
        return entry->second;
    }

    // In files for other programs a name means one look, so another look gets another name. Rules and
    // suffixes ignore an ending like ".001".
    void name_by_look(Material& material) {
        const std::string name = material.name;
        for (std::size_t& number = numbers_[name];; ++number) {
            if (number > 0) material.name = fmt::format("{}.{:03}", name, number);
            const auto [known, added] = looks_.try_emplace(material.name, material);
            if (added ||
                (known->second.diffuse == material.diffuse && known->second.texture == material.texture &&
                 known->second.picture == material.picture))
                return;
        }
    }

    Mesh& to_;
    // First of a mesh with a texture.
    std::map<std::pair<std::string, std::string>, std::uint32_t> materials_;
    std::map<std::string, Material> looks_;       // by name
    std::map<std::string, std::size_t> numbers_;  // where the search for a free name goes on
};

}  // namespace

std::string props_problem(std::span<const Prop> props) {
    if (props.size() > max_props) return fmt::format("A level has at most {} props", max_props);
    std::set<std::string_view> names;
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

const MeshPtr& own_mesh(const Level& level) {
    return level.placed.own ? level.placed.own : level.mesh;
}

Warnings place_props(Level& level) {
    Warnings warnings;
    level.mesh = own_mesh(level);
    level.placed.meshes = read_meshes(level, warnings);
    level.placed.first_face.clear();
    level.placed.own = level.placed.all = nullptr;
    const std::string location = level.file_path.string() + ":/props";
    for (const PropMesh& mesh : level.placed.meshes)
        if (!mesh.mesh)
            warnings.push_back({location, fmt::format("\"{}\": {}", json_excerpt(mesh.file), mesh.problem)});
    if (level.props.empty() || !level.mesh) return warnings;
    auto all = std::make_shared<Mesh>(*level.mesh);
    Placer placer(*all);
    std::size_t left_out = 0;
    for (const Prop& prop : level.props) {
        level.placed.first_face.push_back(static_cast<FaceId>(all->face_count()));
        const PropMesh* const mesh = find_prop_mesh(level, prop.mesh);
        if (!mesh->mesh) continue;
        if (placer.has_room(*mesh->mesh))
            placer.place(prop, *mesh->mesh);
        else
            ++left_out;
    }
    level.placed.first_face.push_back(static_cast<FaceId>(all->face_count()));
    if (left_out > 0)
        warnings.push_back({location, fmt::format("{} props are left out: a level has at most {} triangles",
                                                  left_out, max_triangles)});
    all->fingerprint = mesh_fingerprint(*all);
    level.placed.own = std::exchange(level.mesh, std::move(all));
    level.placed.all = level.mesh;
    return warnings;
}

const PropMesh* find_prop_mesh(const Level& level, std::string_view file) {
    const auto found = std::ranges::lower_bound(level.placed.meshes, file, std::less<>(), &PropMesh::file);
    return found != level.placed.meshes.end() && found->file == file ? &*found : nullptr;
}

bool has_instances(const Level& level) {
    return level.placed.all && level.placed.all == level.mesh;
}

std::vector<Instance> prop_instances(const Level& level, const Vec3& offset,
                                     const std::function<bool(std::size_t)>& wanted) {
    std::vector<Instance> instances;
    if (!has_instances(level)) return instances;
    for (std::size_t i = 0; i < level.props.size(); ++i) {
        const FaceId first = level.placed.first_face[i];
        if (first == level.placed.first_face[i + 1] || !wanted(i)) continue;
        const PropMesh* const mesh = find_prop_mesh(level, level.props[i].mesh);
        Placement placement = level.props[i].placement();
        placement.offset += offset;
        instances.push_back({mesh->collision, placement, first});
    }
    return instances;
}

Level without_props(const Level& level) {
    Level own = level;
    own.mesh = own_mesh(level);
    own.props.clear();
    own.placed = {};
    const std::size_t faces = own.mesh ? own.mesh->face_count() : 0;
    own.overrides.resize(faces);
    const auto keep_own = [&](std::vector<FaceId>& list) {
        std::erase_if(list, [&](FaceId face) { return face >= faces; });
    };
    keep_own(own.hidden);
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
    flat.props.clear();
    flat.placed = {};
    return flat;
}

}  // namespace slipface
