#include "slipface/mesh/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "slipface/base/hash.h"
#include "slipface/base/parallel.h"
#include "slipface/mesh/triangulate.h"
#include "weld.h"

namespace slipface {
namespace {

Error unfit(std::string message) {
    return Error{"", std::move(message)};
}

std::size_t corner_count(const PolygonSoup& soup) {
    return soup.corner_vertex.empty() ? soup.corner_position.size() : soup.corner_vertex.size();
}

Status check_faces(const PolygonSoup& soup) {
    const auto& first = soup.face_first_corner;
    if (first.size() < 2) return unfit("has no faces");
    if (first.front() != 0 || first.back() != corner_count(soup)) {
        return unfit("the numbers of faces and corners do not match");
    }
    for (std::size_t face = 0; face + 1 < first.size(); ++face) {
        if (first[face + 1] < first[face] || first[face + 1] - first[face] < 3) {
            return unfit(fmt::format("face {} has fewer than three corners", face));
        }
    }
    return {};
}

Status check_indices(const std::vector<std::uint32_t>& indices, std::size_t count, const char* what) {
    const auto bad =
        std::find_if(indices.begin(), indices.end(), [&](std::uint32_t index) { return index >= count; });
    if (bad == indices.end()) return {};
    return unfit(fmt::format("face {} has {} {} of {}", bad - indices.begin(), what, *bad, count));
}

Status check_corners(const PolygonSoup& soup) {
    const std::size_t count = soup.vertex_position.size();
    const auto bad = std::find_if(soup.corner_vertex.begin(), soup.corner_vertex.end(),
                                  [&](std::uint32_t index) { return index >= count; });
    if (bad == soup.corner_vertex.end()) return {};
    return unfit(fmt::format("corner {} has vertex {} of {}", bad - soup.corner_vertex.begin(), *bad, count));
}

Status check_positions(const std::vector<Vec3f>& positions, const char* what) {
    const auto bad =
        std::find_if(positions.begin(), positions.end(), [](const Vec3f& p) { return !p.allFinite(); });
    if (bad == positions.end()) return {};
    return unfit(fmt::format("{} {} is not finite", what, bad - positions.begin()));
}

Status check_nodes(const PolygonSoup& soup) {
    for (std::size_t i = 0; i < soup.nodes.size(); ++i) {
        const MeshNode& node = soup.nodes[i];
        if ((node.parent != no_id && node.parent >= i) || (node.shape != no_id && node.shape > i) ||
            (node.group != no_id && node.group >= soup.groups.size()))
            return unfit(fmt::format("node {} names another node or a group that is not there", i));
    }
    return {};
}

Status check(const PolygonSoup& soup) {
    if (corner_count(soup) >= no_id) return unfit("has too many corners");
    const bool indexed = !soup.corner_vertex.empty() || !soup.vertex_position.empty();
    if (indexed && !soup.corner_position.empty()) return unfit("has corners with two positions");
    if (auto status = check_corners(soup); !status) return status;
    if (auto status = check_faces(soup); !status) return status;
    const std::size_t faces = soup.face_first_corner.size() - 1;
    if (soup.corner_uv.size() != corner_count(soup) || soup.face_material.size() != faces ||
        soup.face_group.size() != faces) {
        return unfit("arrays of corners or faces differ in length");
    }
    if (auto status = check_indices(soup.face_material, soup.materials.size(), "material"); !status)
        return status;
    if (auto status = check_indices(soup.face_group, soup.groups.size(), "group"); !status) return status;
    if (const auto status = check_nodes(soup); !status) return status;
    if (const auto status = check_positions(soup.corner_position, "corner"); !status) return status;
    return check_positions(soup.vertex_position, "vertex");
}

void fill_defaults(PolygonSoup& soup) {
    const std::size_t faces = std::max<std::size_t>(soup.face_first_corner.size(), 1) - 1;
    if (soup.corner_uv.empty()) soup.corner_uv.assign(corner_count(soup), Vec2f::Zero());
    if (soup.face_material.empty()) soup.face_material.assign(faces, 0);
    if (soup.face_group.empty()) soup.face_group.assign(faces, 0);
    if (soup.materials.empty()) soup.materials.emplace_back();
    if (soup.groups.empty()) soup.groups.emplace_back();
}

// The vertices that a group has in the file besides the first at their position. `welded`, `in_file`: the
// position of each vertex in the file, and the first vertex at each position.
template <class VertexOf>
std::vector<GroupVertex> find_group_vertices(const Mesh& mesh, const std::vector<std::uint32_t>& welded,
                                             const std::vector<std::uint32_t>& in_file, VertexOf vertex_of) {
    std::vector<GroupVertex> found;
    if (mesh.groups.size() < 2 || welded.size() == in_file.size()) return found;
    std::vector<std::uint32_t> seen_by(in_file.size(), no_id), lowest(in_file.size()), positions;
    const auto end_group = [&](std::uint32_t group) {
        for (const std::uint32_t position : positions)
            if (lowest[position] != in_file[position]) found.push_back({group, position, lowest[position]});
        positions.clear();
    };
    std::uint32_t group = 0;
    for (const FaceId face : faces_by_group(mesh)) {
        if (mesh.face_group[face] != group) end_group(group);
        group = mesh.face_group[face];
        for (std::uint32_t c = mesh.face_first_corner[face]; c < mesh.face_first_corner[face + 1]; ++c) {
            const std::uint32_t vertex = vertex_of(c), position = welded[vertex];
            if (seen_by[position] != group) {
                seen_by[position] = group;
                lowest[position] = vertex;
                positions.push_back(position);
            }
            lowest[position] = std::min(lowest[position], vertex);
        }
    }
    end_group(group);
    return found;
}

// Numbers the vertices in the order in which corners first use them and removes unused ones. `in_file`: of
// the positions.
void number_by_first_use(const std::vector<Vec3f>& positions, const std::vector<std::uint32_t>& in_file,
                         Mesh& mesh) {
    std::vector<std::uint32_t> number(positions.size(), no_id);
    mesh.positions.reserve(positions.size());
    mesh.vertex_number.reserve(positions.size());
    for (std::uint32_t& vertex : mesh.corner_vertex) {
        if (number[vertex] == no_id) {
            number[vertex] = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.push_back(positions[vertex]);
            mesh.vertex_number.push_back(in_file[vertex]);
        }
        vertex = number[vertex];
    }
    for (GroupVertex& vertex : mesh.group_vertices)
        vertex.vertex = number[vertex.vertex];
    std::sort(mesh.group_vertices.begin(), mesh.group_vertices.end(),
              [](const GroupVertex& a, const GroupVertex& b) {
                  return std::pair(a.group, a.vertex) < std::pair(b.group, b.vertex);
              });
}

void set_corners(PolygonSoup& soup, Mesh& mesh) {
    const bool indexed = !soup.corner_vertex.empty();
    Welded welded = weld_positions(indexed ? soup.vertex_position : soup.corner_position);
    std::vector<Vec3f>().swap(soup.corner_position);
    std::vector<Vec3f>().swap(soup.vertex_position);
    if (!indexed && mesh.groups.size() < 2) {
        mesh.positions = std::move(welded.positions);
        mesh.corner_vertex = std::move(welded.index);
        return;
    }
    std::vector<std::uint32_t> in_file(welded.positions.size());  // the first there
    for (std::size_t i = welded.index.size(); i-- > 0;)
        in_file[welded.index[i]] = static_cast<std::uint32_t>(i);
    const auto vertex_of = [&](std::uint32_t corner) {
        return indexed ? soup.corner_vertex[corner] : corner;
    };
    mesh.group_vertices = find_group_vertices(mesh, welded.index, in_file, vertex_of);
    if (indexed) {
        mesh.corner_vertex = std::move(soup.corner_vertex);
        for (std::uint32_t& vertex : mesh.corner_vertex)
            vertex = welded.index[vertex];
    } else {
        mesh.corner_vertex = std::move(welded.index);  // each corner has a vertex of its own
    }
    number_by_first_use(welded.positions, in_file, mesh);
}

constexpr std::size_t faces_per_task = 4096;

// A face of n corners has n - 2 triangles, so the position of its triangles is known in advance.
void cut_faces(Mesh& mesh) {
    mesh.face_first_triangle.resize(mesh.face_count() + 1);
    for (std::size_t face = 0; face <= mesh.face_count(); ++face)
        mesh.face_first_triangle[face] = mesh.face_first_corner[face] - static_cast<std::uint32_t>(2 * face);
    mesh.triangles.resize(mesh.face_first_triangle.back());
    mesh.triangle_face.resize(mesh.triangles.size());
    parallel_for(mesh.face_count(), faces_per_task, [&](std::size_t begin, std::size_t end) {
        std::vector<Vec3f> corners;
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (auto face = static_cast<FaceId>(begin); face < end; ++face) {
            const std::uint32_t first = mesh.face_first_corner[face];
            const std::uint32_t count = mesh.face_corner_count(face);
            corners.clear();
            for (std::uint32_t i = 0; i < count; ++i)
                corners.push_back(mesh.corner_position(first + i));
            triangles.clear();
            triangulate_polygon(corners, triangles);
            std::uint32_t at = mesh.face_first_triangle[face];
            for (const auto& triangle : triangles) {
                mesh.triangles[at] = {triangle[0] + first, triangle[1] + first, triangle[2] + first};
                mesh.triangle_face[at++] = face;
            }
        }
    });
}

MeshPtr make(PolygonSoup soup) {
    auto mesh = std::make_shared<Mesh>();
    mesh->face_first_corner = std::move(soup.face_first_corner);
    mesh->face_material = std::move(soup.face_material);
    mesh->face_group = std::move(soup.face_group);
    mesh->corner_uv = std::move(soup.corner_uv);
    mesh->materials = std::move(soup.materials);
    mesh->groups = std::move(soup.groups);
    mesh->nodes = std::move(soup.nodes);
    mesh->other_files = std::move(soup.other_files);
    mesh->rig = std::move(soup.rig);
    set_corners(soup, *mesh);
    cut_faces(*mesh);
    for (const Vec3f& position : mesh->positions)
        mesh->bounds.add(position.cast<double>());
    mesh->fingerprint = mesh_fingerprint(*mesh);
    return mesh;
}

}  // namespace

std::uint64_t mesh_fingerprint(const Mesh& mesh) {
    static_assert(sizeof(Vec3f) == 3 * sizeof(float));
    Hasher hasher;
    const auto add = [&](const auto& values) {
        hasher.u64(values.size());
        hasher.u64(hash_blocks(values.data(), values.size() * sizeof values[0]));
    };
    add(mesh.positions);
    add(mesh.corner_vertex);
    add(mesh.face_first_corner);
    add(mesh.face_material);
    for (const Material& material : mesh.materials) {
        hasher.u64(material.name.size());
        hasher.text(material.name);
    }
    return hasher.value();
}

Result<MeshPtr> build_mesh(PolygonSoup soup) {
    try {
        fill_defaults(soup);
        if (const auto status = check(soup); !status) return status.error();
        return make(std::move(soup));
    } catch (const std::exception&) {
        return unfit("needs more memory than there is");
    }
}

}  // namespace slipface
