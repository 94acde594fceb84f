#include "slipface/mesh/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "slipface/base/hash.h"
#include "slipface/mesh/triangulate.h"
#include "weld.h"

namespace slipface {
namespace {

Error unfit(std::string message) {
    return Error{"", std::move(message)};
}

Status check_faces(const PolygonSoup& soup) {
    const auto& first = soup.face_first_corner;
    if (first.size() < 2) return unfit("has no faces");
    if (first.front() != 0 || first.back() != soup.corner_position.size()) {
        return unfit("faces and corners do not fit together");
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

Status check(const PolygonSoup& soup) {
    if (soup.corner_position.size() >= no_id) return unfit("has too many corners");
    if (auto status = check_faces(soup); !status) return status;
    const std::size_t faces = soup.face_first_corner.size() - 1;
    if (soup.corner_uv.size() != soup.corner_position.size() || soup.face_material.size() != faces ||
        soup.face_group.size() != faces) {
        return unfit("arrays of corners or faces differ in length");
    }
    if (auto status = check_indices(soup.face_material, soup.materials.size(), "material"); !status)
        return status;
    if (auto status = check_indices(soup.face_group, soup.groups.size(), "group"); !status) return status;
    const auto& positions = soup.corner_position;
    const auto bad =
        std::find_if(positions.begin(), positions.end(), [](const Vec3f& p) { return !p.allFinite(); });
    if (bad != positions.end()) return unfit(fmt::format("corner {} is not finite", bad - positions.begin()));
    return {};
}

void fill_defaults(PolygonSoup& soup) {
    const std::size_t faces = std::max<std::size_t>(soup.face_first_corner.size(), 1) - 1;
    if (soup.corner_uv.empty()) soup.corner_uv.assign(soup.corner_position.size(), Vec2f::Zero());
    if (soup.face_material.empty()) soup.face_material.assign(faces, 0);
    if (soup.face_group.empty()) soup.face_group.assign(faces, 0);
    if (soup.materials.empty()) soup.materials.emplace_back();
    if (soup.groups.empty()) soup.groups.emplace_back();
}

void cut_faces(Mesh& mesh, const std::vector<Vec3f>& corner_position) {
    const std::size_t corners = corner_position.size();
    mesh.triangles.reserve(corners - 2 * mesh.face_count());
    mesh.triangle_face.reserve(mesh.triangles.capacity());
    mesh.face_first_triangle.reserve(mesh.face_count() + 1);
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        const std::uint32_t first = mesh.face_first_corner[face];
        const auto begin = static_cast<std::uint32_t>(mesh.triangles.size());
        mesh.face_first_triangle.push_back(begin);
        triangulate_polygon(std::span(corner_position).subspan(first, mesh.face_corner_count(face)),
                            mesh.triangles);
        for (std::size_t i = begin; i < mesh.triangles.size(); ++i) {
            for (std::uint32_t& corner : mesh.triangles[i])
                corner += first;
            mesh.triangle_face.push_back(face);
        }
    }
    mesh.face_first_triangle.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
}

std::uint64_t fingerprint(const Mesh& mesh) {
    Hasher hasher;
    hasher.u64(mesh.positions.size());
    for (const Vec3f& position : mesh.positions) {
        for (const float coordinate : position)
            hasher.bytes(&coordinate, sizeof coordinate);
    }
    const auto add = [&](const std::vector<std::uint32_t>& values) {
        hasher.u64(values.size());
        hasher.bytes(values.data(), values.size() * sizeof values[0]);
    };
    add(mesh.corner_vertex);
    add(mesh.face_first_corner);
    add(mesh.face_material);
    for (const Material& material : mesh.materials) {
        hasher.u64(material.name.size());
        hasher.text(material.name);
    }
    return hasher.value();
}

MeshPtr make(PolygonSoup soup) {
    auto mesh = std::make_shared<Mesh>();
    mesh->face_first_corner = std::move(soup.face_first_corner);
    mesh->face_material = std::move(soup.face_material);
    mesh->face_group = std::move(soup.face_group);
    mesh->corner_uv = std::move(soup.corner_uv);
    mesh->materials = std::move(soup.materials);
    mesh->groups = std::move(soup.groups);

    Welded welded = weld_positions(soup.corner_position);
    mesh->positions = std::move(welded.positions);
    mesh->corner_vertex = std::move(welded.index);
    cut_faces(*mesh, soup.corner_position);
    for (const Vec3f& position : mesh->positions)
        mesh->bounds.add(position.cast<double>());
    mesh->fingerprint = fingerprint(*mesh);
    return mesh;
}

}  // namespace

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
