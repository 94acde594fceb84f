#include "mesh_edits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace slipface {
namespace {

Vec3 vertex(const Mesh& mesh, std::uint32_t corner) {
    return mesh.corner_position(corner).cast<double>();
}

// The point of the face's outline that is nearest to `p`.
Vec3 nearest_on_outline(const Mesh& mesh, FaceId face, const Vec3& p) {
    const std::uint32_t first = mesh.face_first_corner[face], count = mesh.face_corner_count(face);
    Vec3 nearest = vertex(mesh, first);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 a = vertex(mesh, first + i), b = vertex(mesh, first + (i + 1) % count);
        const double square = (b - a).squaredNorm();
        const double t = square > 0.0 ? std::clamp((p - a).dot(b - a) / square, 0.0, 1.0) : 0.0;
        const Vec3 q = a + t * (b - a);
        if ((q - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = q;
    }
    return nearest;
}

void update_bounds(Mesh& mesh) {
    mesh.bounds = {};
    for (const Vec3f& position : mesh.positions)
        mesh.bounds.add(position.cast<double>());
}

// Every corner of `face` that is at most `widest` from the other's outline goes there.
double move_onto(Mesh& mesh, FaceId face, FaceId other, double widest) {
    double moved = 0.0;
    const std::uint32_t first = mesh.face_first_corner[face], last = mesh.face_first_corner[face + 1];
    for (std::uint32_t corner = first; corner < last; ++corner) {
        const Vec3 p = vertex(mesh, corner), q = nearest_on_outline(mesh, other, p);
        const double motion = (q - p).norm();
        if (motion > widest || !(motion > 0.0)) continue;
        mesh.positions[mesh.corner_vertex[corner]] = q.cast<float>();
        moved = std::max(moved, motion);
    }
    return moved;
}

}  // namespace

double close_gap(Mesh& mesh, FaceId face, FaceId other, const Vec3& position, double widest) {
    // As wide as the gap is at its narrowest, and half as much again where it is wedged.
    const double at_place = 2.0 * std::max((nearest_on_outline(mesh, face, position) - position).norm(),
                                           (nearest_on_outline(mesh, other, position) - position).norm());
    const double reach = std::min(widest, 1.5 * at_place);
    const double one = move_onto(mesh, other, face, reach);
    // Where the other's edge is the longer one, its corners lie far off, and these go to it instead.
    const double two = move_onto(mesh, face, other, reach);
    update_bounds(mesh);
    return std::max(one, two);
}

void flip_face(Mesh& mesh, FaceId face) {
    const std::uint32_t first = mesh.face_first_corner[face], last = mesh.face_first_corner[face + 1];
    std::reverse(mesh.corner_vertex.begin() + first, mesh.corner_vertex.begin() + last);
    std::reverse(mesh.corner_uv.begin() + first, mesh.corner_uv.begin() + last);
    const std::uint32_t mirrored = first + last - 1;
    for (std::uint32_t i = mesh.face_first_triangle[face]; i < mesh.face_first_triangle[face + 1]; ++i) {
        std::array<std::uint32_t, 3>& t = mesh.triangles[i];
        t = {mirrored - t[0], mirrored - t[2], mirrored - t[1]};
    }
}

double flatten_riser(Mesh& mesh, FaceId face, double highest) {
    const std::uint32_t first = mesh.face_first_corner[face], last = mesh.face_first_corner[face + 1];
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::uint32_t corner = first; corner < last; ++corner) {
        low = std::min(low, vertex(mesh, corner).y());
        high = std::max(high, vertex(mesh, corner).y());
    }
    const double height = high - low;
    if (!(height > 0.0) || height > highest || std::abs(face_normal(mesh, face).y()) > 0.1) return 0.0;
    for (std::uint32_t corner = first; corner < last; ++corner) {
        Vec3f& position = mesh.positions[mesh.corner_vertex[corner]];
        if (double{position.y()} > low + 0.5 * height) position.y() = static_cast<float>(low);
    }
    update_bounds(mesh);
    return height;
}

namespace {

template <class Change>
void change_heights(Mesh& mesh, std::span<const FaceId> faces, Change change) {
    std::vector<std::uint32_t> vertices;
    for (const FaceId face : faces)
        for (std::uint32_t corner = mesh.face_first_corner[face]; corner < mesh.face_first_corner[face + 1];
             ++corner)
            vertices.push_back(mesh.corner_vertex[corner]);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const std::uint32_t vertex : vertices) {
        float& height = mesh.positions[vertex].y();
        height = static_cast<float>(change(double{height}));
    }
    update_bounds(mesh);
}

}  // namespace

void raise_faces(Mesh& mesh, std::span<const FaceId> faces, double metres) {
    change_heights(mesh, faces, [metres](double height) { return height + metres; });
}

void lower_faces(Mesh& mesh, std::span<const FaceId> faces, double to) {
    change_heights(mesh, faces, [to](double height) { return std::min(height, to); });
}

}  // namespace slipface
