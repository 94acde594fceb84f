// Faces that moved a little, or changed so much that only their place and material are left.
#include <algorithm>
#include <cmath>

#include "face_matcher.h"

namespace slipface {
namespace {

constexpr double max_sideways = 0.45;  // of the nearest face's centre, as a fraction of the old face's size

constexpr double max_extrusion = 2.0;  // in the face's extent

}  // namespace

bool FaceMatcher::is_refused(FaceId face, std::size_t i) const {
    return std::binary_search(refused_.begin(), refused_.end(), std::pair{face, i});
}

// How many corners of the face an edge joins to one of these positions.
std::size_t FaceMatcher::joined_corners(FaceId face, std::span<const Vec3> positions, double slack) {
    const auto corner_at = [&](std::uint32_t c) -> Vec3 { return mesh_.corner_position(c).cast<double>(); };
    std::vector<Vec3> free;  // not joined yet
    for (std::uint32_t c = mesh_.face_first_corner[face]; c < mesh_.face_first_corner[face + 1]; ++c)
        free.push_back(corner_at(c));
    for (const Vec3& position : positions) {
        const auto join = [&](const Vec3& a, const Vec3& b) {
            if ((a - position).norm() > slack) return;
            std::erase_if(free, [&](const Vec3& corner) { return (corner - b).norm() <= slack; });
        };
        const Vec3 room = Vec3::Constant(slack);
        for (const TriangleId triangle : lookup_.tree()->triangles_in({position - room, position + room})) {
            const FaceId side = lookup_.tree()->triangle_face(triangle);
            const std::uint32_t first = mesh_.face_first_corner[side], count = mesh_.face_corner_count(side);
            lookup_.visits += count;
            for (std::uint32_t k = 0; k < count && side != face; ++k) {
                const Vec3 here = corner_at(first + k), next = corner_at(first + (k + 1) % count);
                join(here, next);
                join(next, here);
            }
        }
    }
    return mesh_.face_corner_count(face) - free.size();
}

// How the edges lead away from the old face's corners along its normal.
std::vector<Vec3> FaceMatcher::edges_along(std::size_t i, const Vec3& normal) {
    constexpr double oblique = 2e-3;  // a level file rounds normals
    std::vector<Vec3> edges;
    const double reach = rounding(i) + position_tolerance(key(i).centroid);
    const Vec3 room = Vec3::Constant(reach);
    for (const Vec3& corner : outlines_[i]) {
        for (const TriangleId triangle : lookup_.tree()->triangles_in({corner - room, corner + room})) {
            ++lookup_.visits;
            for (std::size_t k = 0; k < 6; ++k) {
                const auto& corners = mesh_.triangles[triangle];
                const Vec3 from = mesh_.corner_position(corners[k % 3]).cast<double>();
                const Vec3 edge = mesh_.corner_position(corners[(k + 1 + k / 3) % 3]).cast<double>() - from;
                const double along = std::abs(normal.dot(edge));
                if ((from - corner).norm() <= reach &&
                    (edge - normal.dot(edge) * normal).norm() <= reach + oblique * along)
                    edges.push_back(edge);
            }
        }
    }
    std::stable_sort(edges.begin(), edges.end(),
                     [](const Vec3& a, const Vec3& b) { return a.squaredNorm() < b.squaredNorm(); });
    return edges;
}

// Whether the face's object has more faces than the old one's had. If not, a far face is the bottom of a pit
// that lost its lid.
bool FaceMatcher::has_grown(FaceId face, std::size_t i) const {
    const std::size_t part = i < parts_.of.size() ? parts_.of[i] : 0;
    return part > 0 && part <= parts_.parts.size() &&
           objects_.in_mesh.at(objects_.of_group[mesh_.face_group[face]]) >
               objects_.in_old.at(parts_.parts[part - 1].object);
}

// A face of the same outline that moved along the normal, with sides between: extruded. Nothing is where it
// was.
bool FaceMatcher::match_extruded(std::size_t i) {
    const FaceKey& key = this->key(i);
    const Vec3 normal = unit_or_zero(key.normal);
    const std::vector<Vec3>& outline = outlines_[i];
    if (outline.empty() || normal.isZero()) return false;
    double extent = 0.0;
    for (const Vec3& corner : outline)
        extent = std::max(extent, (corner - outline[0]).norm());
    const double exact = 1e-3 * std::sqrt(key.area) + position_tolerance(key.centroid);
    for (const FaceId face : faces_around(i, exact, true))
        if (index_.key(face).normal.dot(normal) > 0.9995 &&
            std::abs(normal.dot(index_.key(face).centroid - key.centroid)) <= exact &&
            index_.covers(face, key.centroid, normal))
            return false;
    for (const Vec3& edge : edges_along(i, normal)) {
        if (edge.norm() <= exact || lookup_.visits > max_visits) continue;
        for (const FaceId face : index_.near(key.centroid + edge, wide_slack(i))) {
            ++lookup_.visits;
            const FaceKey& candidate = index_.key(face);
            const Vec3 offset = candidate.centroid - key.centroid;
            if (!is_free(face) || index_.base(face) != bases_[i] || is_of_another_object(face, i) ||
                !(candidate.normal.dot(normal) > 0.9995) ||
                std::abs(candidate.area - key.area) > 0.01 * key.area ||
                mesh_.face_corner_count(face) != outline.size())
                continue;
            const std::uint32_t first = mesh_.face_first_corner[face];
            const auto has = [&](const Vec3& corner) {
                for (std::uint32_t c = 0; c < outline.size(); ++c)
                    if ((mesh_.corner_position(first + c).cast<double>() - corner - offset).norm() <
                        0.02 * extent)
                        return true;
                return false;
            };
            if (!std::all_of(outline.begin(), outline.end(), has)) continue;
            std::vector<Vec3> before;
            for (std::uint32_t c = first; c < first + outline.size(); ++c)
                before.emplace_back(mesh_.corner_position(c).cast<double>() - offset);
            const bool far = offset.norm() > max_extrusion * extent;
            if (joined_corners(face, before, exact) < (far ? outline.size() : 2) ||
                (far && !has_grown(face, i)))
                continue;
            claim(face, i, MatchStage::nearest);
            return true;
        }
    }
    return false;
}

// Those that touch the box of the outline.
std::vector<FaceId> FaceMatcher::faces_at_outline(std::size_t i) {
    Aabb box;
    for (const Vec3& corner : outlines_[i])
        box.add(corner);
    const Vec3 room = Vec3::Constant(position_tolerance(key(i).centroid));
    return faces_in(i, {box.min - room, box.max + room});
}

// A face of which one corner moved, perhaps farther than it is wide: the others come one after another as
// before.
bool FaceMatcher::match_corners(std::size_t i) {
    const std::size_t part = i < parts_.of.size() ? parts_.of[i] : 0;
    if (part == 0 || part > parts_.parts.size() || outlines_[i].empty() || likely_[i]) return false;
    const FaceKey& key = this->key(i);
    const std::vector<Vec3>& corners = outlines_[i];
    const std::size_t count = corners.size();
    std::vector<FaceId> faces = faces_at_outline(i);
    std::erase_if(faces, [&](FaceId face) {
        return !is_free(face) || mesh_.face_corner_count(face) != count ||
               pieces().parts[pieces().of[face]].faces != parts_.parts[part - 1].faces ||
               !(index_.key(face).normal.dot(key.normal) > 0.5);
    });
    const double reach = corner_reach(i);
    std::erase_if(faces, [&](FaceId face) {
        const std::uint32_t first = mesh_.face_first_corner[face];
        std::size_t most = 0;
        for (std::size_t turn = 0; turn < count; ++turn) {
            std::size_t same = 0;
            for (std::uint32_t c = 0; c < count; ++c) {
                const Vec3 position = mesh_.corner_position(first + c).cast<double>();
                same += (position - corners[(c + turn) % count]).norm() <= reach ? 1 : 0;
            }
            most = std::max(most, same);
        }
        return most + 1 < count;
    });
    if (faces.size() != 1) return false;
    claim(faces[0], i, MatchStage::nearest);
    return true;
}

// The vertices that are still where the old face had corners.
std::vector<Vec3> FaceMatcher::corners_left(std::size_t i) {
    std::vector<Vec3> left;
    if (outlines_[i].empty() || likely_[i]) return left;
    const double reach = corner_reach(i);
    for (const Vec3& corner : outlines_[i]) {
        const Vec3 room = Vec3::Constant(reach);
        std::optional<Vec3> nearest;
        for (const TriangleId triangle : lookup_.tree()->triangles_in({corner - room, corner + room})) {
            ++lookup_.visits;
            for (const std::uint32_t c : mesh_.triangles[triangle]) {
                const Vec3 position = mesh_.corner_position(c).cast<double>();
                const double distance = (position - corner).norm();
                if (distance <= (nearest ? (*nearest - corner).norm() : reach)) nearest = position;
            }
        }
        if (nearest) left.push_back(*nearest);
    }
    return left;
}

// Whether the face has one of these corners, or an edge joins them.
bool FaceMatcher::is_joined(FaceId face, std::span<const Vec3> corners) {
    const double slack = 2.0 * position_tolerance(index_.key(face).centroid);
    for (std::uint32_t c = mesh_.face_first_corner[face]; c < mesh_.face_first_corner[face + 1]; ++c)
        for (const Vec3& corner : corners)
            if ((mesh_.corner_position(c).cast<double>() - corner).norm() <= slack) return true;
    return joined_corners(face, corners, slack) > 0;
}

bool FaceMatcher::match_nearest(std::size_t i) {
    const FaceKey& key = this->key(i);
    const Vec3 normal = unit_or_zero(key.normal);
    if (normal.isZero() || !(key.area > 0.0) || turned_over_[i]) return false;
    const double size = std::sqrt(key.area);
    // A face of which half of the corners are where they were was deleted, not moved, if nothing joins
    // another one to them.
    const std::vector<Vec3> left = corners_left(i);
    const bool stays = !left.empty() && 2 * left.size() >= outlines_[i].size();
    FaceId best = no_id;
    double best_distance = 0.0;
    for (const FaceId face : faces_around(i, size)) {
        const FaceKey& candidate = index_.key(face);
        const double distance = (candidate.centroid - key.centroid).norm();
        const bool similar = candidate.area > 0.5 * key.area && candidate.area < 2.0 * key.area &&
                             candidate.normal.dot(normal) > 0.9 && distance <= size;
        if (!is_free(face) || is_refused(face, i) || !similar || (best != no_id && distance >= best_distance))
            continue;
        // A face that moved straight along its normal need not cover the centre: it may be concave.
        const Vec3 offset = candidate.centroid - key.centroid;
        const double sideways = (offset - normal.dot(offset) * normal).norm();
        if (sideways > 0.02 * size && !index_.covers(face, key.centroid, normal)) continue;
        if (sideways > max_sideways * size) continue;  // more of it is where a neighbour was
        if (stays && !is_joined(face, left)) continue;
        best = face;
        best_distance = distance;
    }
    if (best == no_id) return false;
    claim(best, i, MatchStage::nearest);
    return true;
}

}  // namespace slipface
