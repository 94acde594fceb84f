// Faces that are what they were: the same corners, or the same place and size.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "face_matcher.h"

namespace slipface {
namespace {

bool same_plane_direction(const Vec3& a, const Vec3& b) {
    if (a.isZero() || b.isZero()) return a.isZero() && b.isZero();
    return a.dot(b) > 0.999;
}

}  // namespace

// `own`: only faces of its own material, so that of faces at one place none takes another's.
bool FaceMatcher::match_hash(std::size_t i, bool own) {
    const FaceKey& key = this->key(i);
    if (key.loop_hash == 0) return false;  // a moved key
    std::vector<FaceId> faces = index_.with_hash(key.loop_hash);
    lookup_.visits += faces.size() + 1;
    const double tolerance = position_tolerance(key.centroid);
    std::vector<Candidate> found;
    bool twin = false;
    for (const FaceId face : faces) {
        const double distance = (index_.key(face).centroid - key.centroid).norm();
        if (distance > tolerance || moved_here(face)) continue;
        found.push_back(candidate(i, face, distance));
        if (index_.key(face).material != key.material) continue;
        if (!is_free(face)) {
            twin = twin || result_.overrides[face] == types_[i];
        } else if (index_.key(face).copy == key.copy) {
            claim(face, i, MatchStage::exact);
            return true;
        }
    }
    if (own) return false;
    if (claim_best(i, found)) return true;
    twin_[i] = twin;
    return twin;
}

FaceMatcher::Candidate FaceMatcher::candidate(std::size_t i, FaceId face, double distance) const {
    const double radius = index_.radius(face), area = std::abs(index_.key(face).area - key(i).area);
    return {face, radius > 0.0 ? distance + area / radius : distance};
}

// Whether the face has the stored one's area and looks as it does, or is too narrow to tell.
bool FaceMatcher::is_as_before(std::size_t i, FaceId face, double slack) const {
    const FaceKey &key = this->key(i), &there = index_.key(face);
    if (index_.is_sliver(face, std::min(4.0 * slack, position_tolerance(key.centroid)))) return true;
    return same_plane_direction(unit_or_zero(there.normal), unit_or_zero(key.normal)) &&
           std::abs(there.area - key.area) <= 0.02 * std::max(there.area, key.area);
}

bool FaceMatcher::match_location(std::size_t i, double slack) {
    const FaceKey& key = this->key(i);
    const std::vector<FaceId> faces = index_.near(key.centroid, slack);
    lookup_.visits += faces.size() + 1;
    std::vector<Candidate> found;
    for (const FaceId face : faces)
        if (is_as_before(i, face, slack))
            found.push_back(candidate(i, face, (index_.key(face).centroid - key.centroid).norm()));
    if (may_repeat(i)) add_repeated(i, slack, found);
    return claim_best(i, found);
}

// Whether two corners of the face may have been at one place, as far as its outline is known.
bool FaceMatcher::may_repeat(std::size_t i) const {
    if (i >= parts_.outlines.count()) return false;
    const std::vector<Vec3> outline = parts_.outlines.corners(i, stored_[i].key);
    const double reach = 2.0 * parts_.outlines.rounding(i, stored_[i].key);
    for (std::size_t c = 0; c < outline.size(); ++c)
        if ((outline[c] - outline[(c + 1) % outline.size()]).norm() <= reach) return true;
    return outline.empty();
}

// Faces that had a corner twice, which a tool took out: with it, the mean of corners is where it was.
void FaceMatcher::add_repeated(std::size_t i, double slack, std::vector<Candidate>& found) {
    if (lookup_.tree() == nullptr) return;
    const FaceKey& key = this->key(i);
    Aabb box;
    box.add(key.centroid - Vec3::Constant(slack));
    box.add(key.centroid + Vec3::Constant(slack));
    for (const FaceId face : faces_in(i, box)) {
        if (!is_as_before(i, face, slack)) continue;
        const std::uint32_t first = mesh_.face_first_corner[face], count = mesh_.face_corner_count(face);
        const Vec3 sum = count * face_centroid(mesh_, face);
        double nearest = slack;
        for (std::uint32_t c = first; c < first + count; ++c) {
            const Vec3 mean = (sum + mesh_.corner_position(c).cast<double>()) / (count + 1);
            nearest = std::min(nearest, (mean - key.centroid).norm());
        }
        if (nearest < slack) found.push_back(candidate(i, face, nearest));
    }
}

// Claims the best free face of `faces`: the same material before the same base name before any other, then
// one with the same corners as far as they are known, then one that looks the same way, then the likest, then
// the one with as many before it that are the same, then the lowest index.
bool FaceMatcher::claim_best(std::size_t i, const std::vector<Candidate>& faces) {
    const FaceKey& key = this->key(i);
    using Rank = std::tuple<int, double, bool>;
    const auto rank_of = [&](const Candidate& candidate) {
        const FaceKey& there = index_.key(candidate.face);
        const int material = there.material == key.material             ? 0
                             : index_.base(candidate.face) == bases_[i] ? 1
                                                                        : 2;
        const bool other = has_other_corners(i, candidate.face), back = there.normal.dot(key.normal) < 0.0;
        return Rank{4 * material + 2 * int{other} + int{back}, candidate.misfit, there.copy != key.copy};
    };
    FaceId best = no_id, taken = no_id;
    Rank best_rank{};
    for (const Candidate& candidate : faces) {
        if (moved_here(candidate.face)) continue;  // the face of another place, however alike
        if (!is_free(candidate.face)) {
            // Of faces at one place a tool has left one: whose type it has is a question.
            if (result_.overrides[candidate.face] != types_[i]) taken = candidate.face;
            continue;
        }
        const Rank rank = rank_of(candidate);
        if (best == no_id || rank < best_rank) {
            best = candidate.face;
            best_rank = rank;
        }
    }
    if (best == no_id) {
        if (taken != no_id) result_.guessed.push_back(taken);
        return false;
    }
    claim(best, i, MatchStage::exact);
    const auto [rank, misfit, copy] = best_rank;
    // A sliver, which rounding may turn over, or the one behind it; or a face that only is as large; or a
    // sliver for a face that had no area.
    const bool opened = !(key.area > 0.0) && index_.key(best).area > 0.0;
    if (rank % 4 != 0 || opened) result_.guessed.push_back(best);
    const double likely = std::max(0.5 * slack(i), misfit);
    for (const Candidate& other : faces)  // a sliver that looks the other way may be turned over
        if (other.face != best && other.misfit <= likely && std::get<0>(rank_of(other)) / 2 <= rank / 2)
            rivals_.push_back({best, other.face});
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
    const double reach = rounding(i) + 4.0 * slack(i);
    for (std::uint32_t c = mesh_.face_first_corner[face]; c < mesh_.face_first_corner[face + 1]; ++c) {
        const Vec3 corner = mesh_.corner_position(c).cast<double>();
        if (std::none_of(outline.begin(), outline.end(), [&](const Vec3& old) {
                const Vec3 offset = corner - old;
                return (offset - normal.dot(offset) * normal).norm() <= reach;
            }))
            return true;
    }
    return false;
}

}  // namespace slipface
