// Faces that are what they were: the same corners, or the same place and size.
#include <algorithm>
#include <cmath>

#include "face_matcher.h"

namespace slipface {
namespace {

bool same_plane_direction(const Vec3& a, const Vec3& b) {
    if (a.isZero() || b.isZero()) return a.isZero() && b.isZero();
    return a.dot(b) > 0.999;
}

}  // namespace

bool FaceMatcher::match_hash(std::size_t i) {
    const FaceKey& key = this->key(i);
    if (key.loop_hash == 0) return false;  // a moved key
    std::vector<FaceId> faces = index_.with_hash(key.loop_hash);
    lookup_.visits += faces.size() + 1;
    const double tolerance = position_tolerance(key.centroid);
    std::erase_if(faces,
                  [&](FaceId face) { return (index_.key(face).centroid - key.centroid).norm() > tolerance; });
    for (const FaceId face : faces) {
        if (index_.key(face).material != key.material || index_.key(face).copy != key.copy) continue;
        if (!is_free(face)) return result_.overrides[face] == types_[i];
        claim(face, i, MatchStage::exact);
        return true;
    }
    return claim_best(i, faces);
}

bool FaceMatcher::match_location(std::size_t i) {
    const FaceKey& key = this->key(i);
    const double tolerance = position_tolerance(key.centroid);
    std::vector<FaceId> faces = index_.near(key.centroid, tolerance);
    lookup_.visits += faces.size() + 1;
    const Vec3 normal = unit_or_zero(key.normal);
    std::erase_if(faces, [&](FaceId face) {
        if (index_.is_sliver(face, tolerance)) return false;
        const double area = index_.key(face).area;
        return !same_plane_direction(unit_or_zero(index_.key(face).normal), normal) ||
               std::abs(area - key.area) > 0.02 * std::max(area, key.area);
    });
    return claim_best(i, faces);
}

// Claims the best free face of `faces`: the same material before the same base name before any other,
// then one that looks the same way, then the nearest, then the lowest index.
bool FaceMatcher::claim_best(std::size_t i, const std::vector<FaceId>& faces) {
    const FaceKey& key = this->key(i);
    const auto looks_back = [&](FaceId face) { return index_.key(face).normal.dot(key.normal) < 0.0; };
    FaceId best = no_id, taken = no_id;
    int best_rank = 0;
    double best_distance = 0.0;
    for (const FaceId face : faces) {
        if (!is_free(face)) {
            // Of faces at one place a tool has left one: whose type it has is a question.
            if (result_.overrides[face] != types_[i]) taken = face;
            continue;
        }
        const int material = index_.key(face).material == key.material ? 0
                             : index_.base(face) == bases_[i]          ? 1
                                                                       : 2;
        const int rank = 2 * material + (looks_back(face) ? 1 : 0);
        const double distance = (index_.key(face).centroid - key.centroid).norm();
        if (best == no_id || rank < best_rank || (rank == best_rank && distance < best_distance)) {
            best = face;
            best_rank = rank;
            best_distance = distance;
        }
    }
    if (best == no_id) {
        if (taken != no_id) result_.guessed.push_back(taken);
        return false;
    }
    claim(best, i, MatchStage::exact);
    // A sliver, which rounding may turn over, or the one behind it; or a face that only is as large.
    if (looks_back(best) || has_other_corners(i, best)) result_.guessed.push_back(best);
    return true;
}

// Whether a corner of the face is none of the stored face's, as far as its outline is known.
bool FaceMatcher::has_other_corners(std::size_t i, FaceId face) const {
    const FaceKey& key = this->key(i);
    if (i >= parts_.outlines.count() || index_.key(face).loop_hash == key.loop_hash) return false;
    std::vector<Vec3> outline = parts_.outlines.corners(i, stored_[i].key);
    if (outline.empty()) return false;
    if (const PartMotion* motion = motion_of(i))
        for (Vec3& corner : outline)
            corner = (*motion)(corner);
    const Vec3 normal = unit_or_zero(key.normal);
    for (std::uint32_t c = mesh_.face_first_corner[face]; c < mesh_.face_first_corner[face + 1]; ++c) {
        const Vec3 corner = mesh_.corner_position(c).cast<double>();
        const double reach = rounding(i) + 4.0 * position_tolerance(corner);
        if (std::none_of(outline.begin(), outline.end(), [&](const Vec3& old) {
                const Vec3 offset = corner - old;
                return (offset - normal.dot(offset) * normal).norm() <= reach;
            }))
            return true;
    }
    return false;
}

}  // namespace slipface
