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

// A face of the same outline that moved along the normal: extruded. Nothing is where it was.
bool FaceMatcher::match_extruded(std::size_t i) {
    const FaceKey& key = this->key(i);
    const Vec3 normal = unit_or_zero(key.normal);
    const std::vector<Vec3>& outline = outlines_[i];
    if (outline.empty() || normal.isZero()) return false;
    double extent = 0.0;
    for (const Vec3& corner : outline)
        extent = std::max(extent, (corner - outline[0]).norm());
    const double exact = 1e-3 * std::sqrt(key.area) + position_tolerance(key.centroid);
    FaceId best = no_id;
    double best_distance = max_extrusion * extent;
    for (const FaceId face : faces_around(i, best_distance, true)) {
        const FaceKey& candidate = index_.key(face);
        if (!(candidate.normal.dot(normal) > 0.9995)) continue;
        const Vec3 offset = candidate.centroid - key.centroid;
        const double along = std::abs(normal.dot(offset));
        if (std::abs(along) <= exact) {
            if (index_.covers(face, key.centroid, normal)) return false;
            continue;
        }
        if (!is_free(face) || index_.base(face) != bases_[i] || along > best_distance ||
            (offset - normal.dot(offset) * normal).norm() > exact ||
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
        best = face;
        best_distance = along;
    }
    if (best == no_id) return false;
    claim(best, i, MatchStage::nearest);
    return true;
}

bool FaceMatcher::match_nearest(std::size_t i) {
    const FaceKey& key = this->key(i);
    const Vec3 normal = unit_or_zero(key.normal);
    if (normal.isZero() || !(key.area > 0.0)) return false;
    const double size = std::sqrt(key.area);
    FaceId best = no_id;
    double best_distance = 0.0;
    for (const FaceId face : faces_around(i, size)) {
        const FaceKey& candidate = index_.key(face);
        const double distance = (candidate.centroid - key.centroid).norm();
        const bool similar = candidate.area > 0.25 * key.area && candidate.area < 4.0 * key.area &&
                             candidate.normal.dot(normal) > 0.9 && distance <= size;
        if (!is_free(face) || is_refused(face, i) || !similar || (best != no_id && distance >= best_distance))
            continue;
        // A face that moved straight along its normal need not cover the centre: it may be concave.
        const Vec3 offset = candidate.centroid - key.centroid;
        const double sideways = (offset - normal.dot(offset) * normal).norm();
        if (sideways > 0.02 * size && !index_.covers(face, key.centroid, normal)) continue;
        if (sideways > max_sideways * size) continue;  // more of it is where a neighbour was
        best = face;
        best_distance = distance;
    }
    if (best == no_id) return false;
    claim(best, i, MatchStage::nearest);
    return true;
}

}  // namespace slipface
