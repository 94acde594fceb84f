#include "unpainted_faces.h"

#include <algorithm>
#include <cmath>

#include "face_cover.h"
#include "mesh_collision.h"
#include "slipface/base/parallel.h"

namespace slipface {
namespace {

constexpr double least_along = 0.5;  // the cosine of both normals
constexpr double part_of_it = 0.01;  // of the smaller face's area, that lies on the other one

// How far a face is from another on which it lies, in the larger one's size: if they are parallel, and more
// if they are tilted.
constexpr double max_off = 0.1, max_off_by_tilt = 0.7, max_metres = 0.5;

using Outline = std::vector<Vec3>;

Outline outline_of(const Mesh& mesh, FaceId face) {
    Outline outline;
    for (std::uint32_t c = mesh.face_first_corner[face]; c < mesh.face_first_corner[face + 1]; ++c)
        outline.emplace_back(mesh.corner_position(c).cast<double>());
    return outline;
}

// Whether the line of an edge of `a` has all of `a` on its one side and all of `b` on the other, seen along
// `normal`: neighbours do not lie on each other.
bool is_beside(const Outline& a, const Outline& b, const Vec3& normal) {
    constexpr double metres = 1e-5;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec3 edge = a[(i + 1) % a.size()] - a[i], inwards = normal.cross(edge);
        const double slack = metres * edge.norm();
        const auto is_inside = [&](const Vec3& corner) { return inwards.dot(corner - a[i]) >= -slack; };
        const auto is_outside = [&](const Vec3& corner) { return inwards.dot(corner - a[i]) <= slack; };
        if (std::all_of(b.begin(), b.end(), is_outside) && std::all_of(a.begin(), a.end(), is_inside))
            return true;
    }
    return false;
}

// The unpainted faces that lie on painted ones.
class Search {
  public:
    Search(const Mesh& mesh, const CollisionWorld& tree, std::span<const FaceId> painted)
        : mesh_(mesh), tree_(tree), painted_(mesh.face_count(), false) {
        for (const FaceId face : painted)
            painted_[face] = true;
    }

    std::vector<FaceId> faces_on(FaceId face) const;

  private:
    struct Painted {
        FaceId face;
        Vec3 normal, centroid;
        double area;
        Outline outline;
    };
    bool lies_on(FaceId face, const Painted& painted) const;

    const Mesh& mesh_;
    const CollisionWorld& tree_;
    std::vector<bool> painted_;  // [face]
};

std::vector<FaceId> Search::faces_on(FaceId face) const {
    const Painted painted{face, face_normal(mesh_, face), face_centroid(mesh_, face), face_area(mesh_, face),
                          outline_of(mesh_, face)};
    const double size = std::sqrt(painted.area);
    Aabb box;
    for (const Vec3& corner : painted.outline)
        box.add(corner);
    const Vec3 room = Vec3::Constant(std::min(size, max_metres));
    std::vector<FaceId> faces;
    for (const TriangleId triangle : tree_.triangles_in({box.min - room, box.max + room})) {
        const FaceId other = tree_.triangle_face(triangle);
        const bool known = !faces.empty() && faces.back() == other;
        if (!known && !painted_[other] && lies_on(other, painted)) faces.push_back(other);
    }
    return faces;
}

bool Search::lies_on(FaceId face, const Painted& painted) const {
    if (mesh_.face_group[face] != mesh_.face_group[painted.face]) return false;
    const Vec3 normal = face_normal(mesh_, face);
    if (!(normal.dot(painted.normal) > least_along)) return false;
    const double area = face_area(mesh_, face);
    const double size = std::sqrt(std::max(area, painted.area));
    const double most = (max_off + max_off_by_tilt * normal.cross(painted.normal).norm()) * size;
    const double off = std::abs(normal.dot(face_centroid(mesh_, face) - painted.centroid));
    if (off > std::min(most, max_metres)) return false;
    const Outline outline = outline_of(mesh_, face);
    if (is_beside(outline, painted.outline, normal) || is_beside(painted.outline, outline, normal))
        return false;
    const OldFace old{painted.outline, 0.0};
    return covered_areas(mesh_, face, {&old, 1}, 0.0)[0] > part_of_it * std::min(area, painted.area);
}

}  // namespace

std::vector<UnpaintedFace> unpainted_faces_on(const Mesh& mesh, std::span<const FaceId> painted) {
    if (painted.empty() || painted.size() == mesh.face_count()) return {};
    const Result<CollisionWorld> tree = build_mesh_collision(mesh);
    if (!tree) return {};
    const Search search(mesh, *tree, painted);
    std::vector<std::vector<FaceId>> found(painted.size());
    parallel_for(painted.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            found[i] = search.faces_on(painted[i]);
    });
    std::vector<FaceId> on(mesh.face_count(), no_id);
    for (std::size_t i = painted.size(); i-- > 0;)
        for (const FaceId face : found[i])
            on[face] = painted[i];
    std::vector<UnpaintedFace> result;
    for (FaceId face = 0; face < mesh.face_count(); ++face)
        if (on[face] != no_id) result.push_back({face, on[face]});
    return result;
}

}  // namespace slipface
