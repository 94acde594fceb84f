#include "slipface/mesh/facing_doubt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace slipface {
namespace {

constexpr double least_height = 1.8, least_width = 0.8;  // of a room, metres

struct Edge {
    std::uint32_t low = 0, high = 0;  // vertices
    FaceId face = no_id;
    int direction = 0;
};

struct Shell {
    bool closed = true;
    double area = 0.0, volume = 0.0;  // negative: the faces look inward
    double up = 0.0, down = 0.0;      // area within 45 degrees of level
    Aabb bounds;

    // What stands in a room may be sunk into its floor.
    bool holds(const Shell& other) const {
        const Vec3 middle = other.bounds.centre();
        return std::abs(other.volume) < std::abs(volume) && (bounds.min.array() <= middle.array()).all() &&
               (bounds.max.array() >= middle.array()).all();
    }
};

std::vector<Edge> sorted_edges(const Mesh& mesh) {
    std::vector<Edge> edges;
    edges.reserve(mesh.corner_vertex.size());
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        const std::uint32_t first = mesh.face_first_corner[face], count = mesh.face_corner_count(face);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t a = mesh.corner_vertex[first + i];
            const std::uint32_t b = mesh.corner_vertex[first + (i + 1) % count];
            if (a != b) edges.push_back({std::min(a, b), std::max(a, b), face, a < b ? 1 : -1});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        if (a.low != b.low) return a.low < b.low;
        return a.high != b.high ? a.high < b.high : a.face < b.face;
    });
    return edges;
}

std::vector<Shell> shells_of(const Mesh& mesh) {
    const std::vector<Edge> edges = sorted_edges(mesh);
    std::vector<FaceId> parent(mesh.face_count());
    std::iota(parent.begin(), parent.end(), FaceId{0});
    const auto root = [&](FaceId face) {
        while (parent[face] != face)
            face = parent[face] = parent[parent[face]];
        return face;
    };
    const auto each_edge = [&](const auto& visit) {
        for (auto i = edges.begin(); i != edges.end();) {
            const auto begin = i;
            while (i != edges.end() && i->low == begin->low && i->high == begin->high)
                ++i;
            visit(begin, i);
        }
    };
    each_edge([&](auto begin, auto end) {
        for (auto i = begin; i != end; ++i) {
            const FaceId a = root(begin->face), b = root(i->face);
            parent[std::max(a, b)] = std::min(a, b);
        }
    });
    std::vector<Shell> of_face(mesh.face_count());  // at the first face of each
    each_edge([&](auto begin, auto end) {
        int sum = 0;
        for (auto i = begin; i != end; ++i)
            sum += i->direction;
        if (sum != 0) of_face[root(begin->face)].closed = false;
    });
    const Vec3 middle = 0.5 * (mesh.bounds.min + mesh.bounds.max);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        const Vec3 p = mesh.corner_position(a).cast<double>() - middle;
        const Vec3 q = mesh.corner_position(b).cast<double>() - middle;
        const Vec3 r = mesh.corner_position(c).cast<double>() - middle;
        const Vec3 normal = 0.5 * (q - p).cross(r - p);
        const double area = normal.norm();
        Shell& shell = of_face[root(mesh.triangle_face[i])];
        shell.area += area;
        shell.volume += p.dot(normal) / 3.0;
        if (normal.y() > std::sqrt(0.5) * area) shell.up += area;
        if (normal.y() < -std::sqrt(0.5) * area) shell.down += area;
        for (const Vec3& corner : {p, q, r})
            shell.bounds.add(corner);
    }
    std::vector<Shell> shells;
    for (FaceId face = 0; face < mesh.face_count(); ++face)
        if (parent[face] == face && of_face[face].area > 0.0) shells.push_back(of_face[face]);
    return shells;
}

bool is_room(const Shell& shell, const std::vector<Shell>& shells) {
    double others = 0.0, held = 0.0;
    for (const Shell& other : shells) {
        if (&other == &shell) continue;
        others += other.area;
        if (shell.holds(other)) held += other.area;
    }
    return shell.bounds.max.y() - shell.bounds.min.y() >= least_height &&
           -2.0 * shell.volume >= least_width * shell.area && 2.0 * held >= others;
}

}  // namespace

std::string FacingDoubt::text() const {
    return fmt::format("{:.0f} % of the surface seems to look the wrong way", 100 * wrong);
}

std::optional<FacingDoubt> facing_doubt(const Mesh& mesh) {
    std::vector<Shell> shells = shells_of(mesh);
    // The largest first: what holds a shell comes before it.
    std::stable_sort(shells.begin(), shells.end(),
                     [](const Shell& a, const Shell& b) { return std::abs(a.volume) > std::abs(b.volume); });
    constexpr std::size_t max_compared = 1000;  // with the shells that may hold them
    double judged = 0.0, wrong = 0.0;
    for (std::size_t i = 0; i < shells.size(); ++i) {
        const Shell& shell = shells[i];
        if (!shell.closed) {
            judged += shell.up + shell.down;
            if (shell.down > 2.0 * shell.up) wrong += shell.down;
            continue;
        }
        judged += shell.area;
        if (shell.volume >= 0.0) continue;
        const auto solid_around = [&](const Shell& other) {
            return other.closed && other.volume > 0.0 && other.holds(shell);
        };
        const auto before = shells.begin() + static_cast<std::ptrdiff_t>(std::min(i, max_compared));
        if (std::any_of(shells.begin(), before, solid_around)) continue;
        // Only the largest that look inward can be around half of all else.
        if (i < max_compared && is_room(shell, shells)) continue;
        wrong += shell.area;
    }
    if (!(2.0 * wrong > judged)) return std::nullopt;
    return FacingDoubt{wrong / judged};
}

}  // namespace slipface
