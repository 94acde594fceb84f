#include "level_geometry.h"

#include <algorithm>
#include <cmath>
#include <compare>

namespace slipface {

namespace {

struct Edge {
    std::uint32_t a, b;  // vertices, lower first
    FaceId face;

    bool same_place(const Edge& other) const { return a == other.a && b == other.b; }
    auto operator<=>(const Edge&) const = default;
};

std::uint32_t packed_normal(const Vec3& normal) {
    const auto component = [](double value) {
        const int scaled = static_cast<int>(std::lround(std::clamp(value, -1.0, 1.0) * 511.0));
        return static_cast<std::uint32_t>(scaled) & 0x3ffU;
    };
    return component(normal.x()) | component(normal.y()) << 10U | component(normal.z()) << 20U;
}

std::uint8_t byte_of(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

void append_edges(const Mesh& mesh, FaceId face, std::vector<Edge>& edges) {
    const std::uint32_t first = mesh.face_first_corner[face];
    const std::uint32_t count = mesh.face_corner_count(face);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t a = mesh.corner_vertex[first + i];
        const std::uint32_t b = mesh.corner_vertex[first + (i + 1) % count];
        if (a != b) edges.push_back({std::min(a, b), std::max(a, b), face});
    }
}

// One past the last of the edges that lie where edges[first] lies, in a sorted list.
std::size_t end_of_run(const std::vector<Edge>& edges, std::size_t first) {
    std::size_t end = first + 1;
    while (end < edges.size() && edges[end].same_place(edges[first]))
        ++end;
    return end;
}

LineInstance line_of(const Mesh& mesh, const Edge& edge, const Vec3& origin, const std::uint8_t (&color)[4],
                     float width) {
    const Vec3f a = (mesh.positions[edge.a].cast<double>() - origin).cast<float>();
    const Vec3f b = (mesh.positions[edge.b].cast<double>() - origin).cast<float>();
    return {{a.x(), a.y(), a.z()},
            {b.x(), b.y(), b.z()},
            {color[0], color[1], color[2], color[3]},
            width,
            0.0f,
            {0, 0}};
}

}  // namespace

DrawOrder draw_order(const Mesh& mesh, std::span<const std::uint32_t> material_texture,
                     std::size_t texture_count) {
    const auto texture_of = [&](TriangleId triangle) {
        return material_texture[mesh.face_material[mesh.triangle_face[triangle]]];
    };
    std::vector<std::size_t> next(texture_count + 1, 0);
    for (TriangleId t = 0; t < mesh.triangle_count(); ++t)
        ++next[texture_of(t) + 1];
    for (std::size_t i = 1; i < next.size(); ++i)
        next[i] += next[i - 1];

    DrawOrder order;
    for (std::uint32_t i = 0; i < texture_count; ++i) {
        if (next[i + 1] > next[i]) order.batches.push_back({i, next[i], next[i + 1] - next[i]});
    }
    order.triangles.resize(mesh.triangle_count());
    for (TriangleId t = 0; t < mesh.triangle_count(); ++t)
        order.triangles[next[texture_of(t)]++] = t;
    return order;
}

Vec3 drawing_origin(const Mesh& mesh) {
    if (mesh.bounds.empty()) return Vec3::Zero();
    return mesh.bounds.centre().unaryExpr([](double value) { return std::round(value / 64.0) * 64.0; });
}

void append_vertices(const Mesh& mesh, std::span<const TriangleId> triangles, const Vec3& origin,
                     std::vector<LevelVertex>& vertices) {
    FaceId normal_of = no_id;
    std::uint32_t normal = 0;
    for (const TriangleId triangle : triangles) {
        const FaceId face = mesh.triangle_face[triangle];
        if (face != normal_of) normal = packed_normal(face_normal(mesh, face));
        normal_of = face;
        const Vec3f& diffuse = mesh.materials[mesh.face_material[face]].diffuse;
        for (const std::uint32_t corner : mesh.triangles[triangle]) {
            const Vec3f position = (mesh.corner_position(corner).cast<double>() - origin).cast<float>();
            const Vec2f& uv = mesh.corner_uv[corner];
            vertices.push_back({{position.x(), position.y(), position.z()},
                                normal,
                                {uv.x(), uv.y()},
                                face,
                                {byte_of(diffuse.x()), byte_of(diffuse.y()), byte_of(diffuse.z()), 255}});
        }
    }
}

std::vector<LineInstance> face_border_lines(const Mesh& mesh, const Vec3& origin,
                                            const std::uint8_t (&color)[4], float width) {
    std::vector<Edge> edges;
    edges.reserve(mesh.corner_vertex.size());
    for (FaceId face = 0; face < mesh.face_count(); ++face)
        append_edges(mesh, face, edges);
    std::sort(edges.begin(), edges.end());
    std::vector<LineInstance> lines;
    for (std::size_t i = 0; i < edges.size();) {
        const std::size_t end = end_of_run(edges, i);
        LineInstance line = line_of(mesh, edges[i], origin, color, width);
        // With one or two faces beside it an edge may be hidden together with them; with more it is always
        // drawn.
        if (end - i <= 2) {
            line.normals[0] = packed_normal(face_normal(mesh, edges[i].face));
            line.normals[1] = packed_normal(face_normal(mesh, edges[end - 1].face));
        }
        lines.push_back(line);
        i = end;
    }
    return lines;
}

std::vector<LineInstance> outline_lines(const Mesh& mesh, std::span<const std::uint8_t> highlights,
                                        std::uint8_t bit, const Vec3& origin, const std::uint8_t (&color)[4],
                                        float width) {
    std::vector<Edge> edges;
    for (FaceId face = 0; face < highlights.size(); ++face) {
        if ((highlights[face] & bit) != 0) append_edges(mesh, face, edges);
    }
    std::sort(edges.begin(), edges.end());
    std::vector<LineInstance> lines;
    for (std::size_t i = 0; i < edges.size();) {
        const std::size_t end = end_of_run(edges, i);
        if (end - i == 1) lines.push_back(line_of(mesh, edges[i], origin, color, width));
        i = end;
    }
    return lines;
}

}  // namespace slipface
