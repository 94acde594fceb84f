#include "level_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstring>
#include <numeric>

#include "slipface/base/parallel.h"

namespace slipface {

namespace {

struct Edge {
    std::uint32_t a, b;  // vertices, lower first
    FaceId face;

    bool same_position(const Edge& other) const { return a == other.a && b == other.b; }
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

// In a sorted list, one past the last edge with the same ends as edges[first].
std::size_t end_of_run(const std::vector<Edge>& edges, std::size_t first) {
    std::size_t end = first + 1;
    while (end < edges.size() && edges[end].same_position(edges[first]))
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
    std::vector<std::array<std::uint8_t, 4>> material_color;
    for (const Material& material : mesh.materials) {
        const Vec3f& color = material.diffuse;
        material_color.push_back({byte_of(color.x()), byte_of(color.y()), byte_of(color.z()), 255});
    }
    const std::size_t before = vertices.size();
    vertices.resize(before + 3 * triangles.size());
    parallel_for(triangles.size(), 4096, [&](std::size_t begin, std::size_t end) {
        FaceId normal_of = no_id;
        std::uint32_t normal = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const TriangleId triangle = triangles[i];
            const FaceId face = mesh.triangle_face[triangle];
            if (face != normal_of) normal = packed_normal(face_normal(mesh, face));
            normal_of = face;
            const std::array<std::uint8_t, 4>& color = material_color[mesh.face_material[face]];
            LevelVertex* to = vertices.data() + before + 3 * i;
            for (const std::uint32_t corner : mesh.triangles[triangle]) {
                const Vec3f position = (mesh.corner_position(corner).cast<double>() - origin).cast<float>();
                const Vec2f& uv = mesh.corner_uv[corner];
                *to++ = {{position.x(), position.y(), position.z()},
                         normal,
                         {uv.x(), uv.y()},
                         face,
                         {color[0], color[1], color[2], color[3]}};
            }
        }
    });
}

void append_moved_vertices(const Mesh& mesh, std::span<const TriangleId> triangles, const Pose& pose,
                           const Vec3& origin, std::vector<LevelVertex>& vertices) {
    const std::size_t first = vertices.size();
    append_vertices(mesh, triangles, origin, vertices);
    for (std::size_t i = first; i < vertices.size(); ++i) {
        LevelVertex& vertex = vertices[i];
        const Vec3 rest = Vec3(vertex.position[0], vertex.position[1], vertex.position[2]) + origin;
        const Vec3f at = (pose.apply(rest) - origin).cast<float>();
        std::copy(at.data(), at.data() + 3, vertex.position);
        vertex.normal = packed_normal(pose.rotate(face_normal(mesh, vertex.face)));
    }
}

std::vector<LineInstance> face_border_lines(const Mesh& mesh, std::span<const std::uint8_t> highlights,
                                            const Vec3& origin, const std::uint8_t (&color)[4], float width) {
    std::vector<Edge> edges;
    edges.reserve(mesh.corner_vertex.size());
    for (FaceId face = 0; face < mesh.face_count(); ++face)
        if (face >= highlights.size() || (highlights[face] & 4) == 0) append_edges(mesh, face, edges);
    std::sort(edges.begin(), edges.end());
    std::vector<LineInstance> lines;
    for (std::size_t i = 0; i < edges.size();) {
        const std::size_t end = end_of_run(edges, i);
        LineInstance line = line_of(mesh, edges[i], origin, color, width);
        // An edge of one or two faces can be culled together with them; an edge of more is always drawn.
        if (end - i <= 2) {
            line.normals[0] = packed_normal(face_normal(mesh, edges[i].face));
            line.normals[1] = packed_normal(face_normal(mesh, edges[end - 1].face));
        }
        lines.push_back(line);
        i = end;
    }
    return lines;
}

namespace {

struct CornerEdge {
    std::uint32_t high;  // the vertex with the larger index
    std::uint32_t corner;
    auto operator<=>(const CornerEdge&) const = default;
};

// Calls visit(corner, a, b) for each side of each face, from vertex a to vertex b.
template <class Visit>
void for_each_side(const Mesh& mesh, FaceId face, const Visit& visit) {
    const std::uint32_t first = mesh.face_first_corner[face], end = mesh.face_first_corner[face + 1];
    for (std::uint32_t corner = first; corner < end; ++corner)
        visit(corner, mesh.corner_vertex[corner], mesh.corner_vertex[corner + 1 < end ? corner + 1 : first]);
}

}  // namespace

OutlineFinder::OutlineFinder(const Mesh& mesh) : edge_(mesh.corner_vertex.size(), no_id) {
    // Counting sort by the lower vertex, then a comparison sort for each vertex.
    std::vector<std::uint32_t> end(mesh.positions.size() + 1, 0);
    const auto for_all = [&](const auto& visit) {
        for (FaceId face = 0; face < mesh.face_count(); ++face)
            for_each_side(mesh, face, [&](std::uint32_t corner, std::uint32_t a, std::uint32_t b) {
                if (a != b) visit(corner, std::min(a, b), std::max(a, b));
            });
    };
    for_all([&](std::uint32_t, std::uint32_t low, std::uint32_t) { ++end[low + 1]; });
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<CornerEdge> sides(end.back());
    // Filling advances end[low] from the vertex's begin to its end.
    for_all([&](std::uint32_t corner, std::uint32_t low, std::uint32_t high) {
        sides[end[low]++] = {high, corner};
    });
    for (std::uint32_t vertex = 0, begin = 0; vertex < mesh.positions.size(); begin = end[vertex++]) {
        std::sort(sides.begin() + begin, sides.begin() + end[vertex]);
        for (std::uint32_t i = begin; i < end[vertex]; ++i) {
            if (i == begin || sides[i].high != sides[i - 1].high) {
                vertices_.push_back({vertex, sides[i].high});
                total_.push_back(0);
            }
            edge_[sides[i].corner] = static_cast<std::uint32_t>(vertices_.size() - 1);
            if (total_.back() < many) ++total_.back();
        }
    }
    counted_.assign(total_.size(), 0);
    for (std::uint32_t edge = 0; edge < total_.size(); ++edge)
        if (total_[edge] == 1) borders_.push_back(edge);
}

std::vector<LineInstance> OutlineFinder::lines(const Mesh& mesh, std::span<const std::uint8_t> highlights,
                                               std::uint8_t bit, const Vec3& origin,
                                               const std::uint8_t (&color)[4], float width) {
    const auto members = static_cast<std::size_t>(std::count_if(
        highlights.begin(), highlights.end(), [bit](std::uint8_t flags) { return (flags & bit) != 0; }));
    const bool inverse =
        2 * members > highlights.size();  // then the faces that are not in the set are visited
    // The first visited face from `face` on. Eight are skipped at once.
    constexpr std::uint64_t ones = 0x0101010101010101U;
    const std::uint8_t skipped = inverse ? bit : 0;
    const auto next_visited = [&](FaceId face) {
        std::uint64_t eight = 0;
        for (; highlights.size() - face >= sizeof eight; face += sizeof eight) {
            std::memcpy(&eight, &highlights[face], sizeof eight);
            if ((eight & ones * bit) != ones * skipped) break;
        }
        while (face < highlights.size() && (highlights[face] & bit) == skipped)
            ++face;
        return face;
    };
    const auto for_edges = [&](const auto& visit) {
        for (FaceId face = next_visited(0); face < highlights.size(); face = next_visited(face + 1))
            for (std::uint32_t corner = mesh.face_first_corner[face];
                 corner < mesh.face_first_corner[face + 1]; ++corner)
                if (edge_[corner] != no_id) visit(edge_[corner]);
    };
    for_edges([&](std::uint32_t edge) {
        if (counted_[edge] < many) ++counted_[edge];
    });
    std::vector<LineInstance> lines;
    const auto add = [&](std::uint32_t edge) {
        lines.push_back(line_of(mesh, {vertices_[edge][0], vertices_[edge][1], no_id}, origin, color, width));
    };
    if (inverse)
        for (const std::uint32_t edge : borders_)
            if (counted_[edge] == 0) add(edge);
    // An edge is visited once per face that has it; the first visit draws it and clears its count.
    for_edges([&](std::uint32_t edge) {
        if (counted_[edge] == 0) return;
        const int faces = inverse ? total_[edge] - counted_[edge] : counted_[edge];
        if (faces == 1) add(edge);
        counted_[edge] = 0;
    });
    return lines;
}

}  // namespace slipface
