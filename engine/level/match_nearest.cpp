// Faces that moved a little, or changed so much that only their place and material are left.
#include <algorithm>

#include "face_matcher.h"

namespace slipface {
namespace {

constexpr double max_sideways = 0.45;  // of the nearest face's centre, as a fraction of the old face's size

}  // namespace

bool FaceMatcher::is_refused(FaceId face, std::size_t i) const {
    return std::binary_search(refused_.begin(), refused_.end(), std::pair{face, i});
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
