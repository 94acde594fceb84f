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
    // A sliver, which rounding may turn over, or the one behind it.
    if (looks_back(best)) result_.guessed.push_back(best);
    return true;
}

}  // namespace slipface
