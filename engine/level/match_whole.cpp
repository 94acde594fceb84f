// Old faces of which only the key is known, and new faces that together are the whole of one.
#include <algorithm>
#include <cmath>

#include "face_matcher.h"
#include "face_union.h"
#include "slipface/level/material_name.h"

namespace slipface {
namespace {

// A part is smaller than this fraction of the old face; all parts together are at most the second fraction.
constexpr double part_fraction = 0.99;
constexpr double whole_fraction = 1.01;

constexpr double max_bent_area = 1.2;  // of the parts of a bent face, as a fraction of its vector's length

// A face in the plane of an old one, up to this fraction of its area and with nearly its centre, is that face
// with another outline.
constexpr double merged_fraction = 1.5;
constexpr double same_centre = 0.1;  // as a fraction of its size

constexpr double moved_centre = 0.3;  // by lost corners on straight edges

}  // namespace

bool FaceMatcher::match_plane(std::size_t i) {
    const FaceKey& key = this->key(i);
    const Vec3 normal = unit_or_zero(key.normal);
    if (normal.isZero() || !(key.area > 0.0)) return false;
    const double size = std::sqrt(key.area);
    const double tolerance = position_tolerance(key.centroid);

    struct Part {
        double distance;
        FaceId face;
    };
    std::vector<Part> parts;
    for (const FaceId face : faces_around(i, size + tolerance)) {
        const bool shared = claims_[face] == MatchStage::plane && result_.overrides[face] == types_[i];
        if (!is_free(face) && !shared) continue;
        const FaceKey& candidate = index_.key(face);
        if (candidate.normal.dot(normal) < 0.99) continue;
        const Vec3 candidate_normal = face_normal(mesh_, face);
        if (!(candidate_normal.dot(normal) > 0.999)) continue;
        const Vec3 offset = candidate.centroid - key.centroid;
        if (std::abs(candidate_normal.dot(offset)) > 1e-3 * size + tolerance) continue;
        if (candidate.area >= part_fraction * key.area) {
            if (!index_.covers(face, key.centroid, normal)) continue;
            // One of several that a larger face may cover.
            if (candidate.area > merged_fraction * key.area || offset.norm() > same_centre * size)
                return false;
            claim(face, i, MatchStage::plane);
            return true;
        }
        if (offset.norm() <= size) parts.push_back({offset.norm(), face});
    }
    std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.face < b.face;
    });
    double area = 0.0;
    std::vector<FaceId> faces;
    for (const Part& part : parts) {
        area += index_.key(part.face).area;
        if (area > whole_fraction * key.area) return false;
        faces.push_back(part.face);
        if (area < part_fraction * key.area) continue;
        if (!has_middle(mesh_, key, faces) || !cover_middle(index_, key, normal, faces)) return false;
        for (const FaceId face : faces)
            claim(face, i, MatchStage::plane);
        return true;
    }
    return false;
}

// A face that lost corners on straight edges has another mean of corners, which may lie outside of it. It
// is the only face of that area in the plane around.
bool FaceMatcher::match_area(std::size_t i) {
    const FaceKey& key = this->key(i);
    const Vec3 normal = unit_or_zero(key.normal);
    if (normal.isZero() || !(key.area > 0.0)) return false;
    const double size = std::sqrt(key.area);
    FaceId best = no_id;
    for (const FaceId face : faces_around(i, size)) {
        const FaceKey& candidate = index_.key(face);
        if (std::abs(candidate.area - key.area) > 1e-3 * key.area || candidate.normal.dot(normal) < 0.999 ||
            std::abs(normal.dot(candidate.centroid - key.centroid)) > 1e-3 * size)
            continue;
        if (best != no_id) return false;
        best = face;
    }
    if (best == no_id || !is_free(best)) return false;
    if ((index_.key(best).centroid - key.centroid).norm() > moved_centre * size) return false;
    claim(best, i, MatchStage::plane);
    return true;
}

// A long face that was cut into parts, whose centres are too far away for match_plane(): connected faces
// in its plane that together have its area and the mean of its corners. Starts at the faces at its
// centre; the number of attempts is limited. `bent`: the parts of a bent face, which lie near its plane
// and have its vector of area, because that depends on the outline alone.
bool FaceMatcher::match_union(std::size_t i, bool bent) {
    const FaceKey& key = this->key(i);
    const Vec3 normal = unit_or_zero(key.normal);
    if (normal.isZero() || !(key.area > 0.0)) return false;
    FaceNeighbours& neighbours = lookup_.neighbours;
    if (neighbours.first.empty()) neighbours = face_neighbours(mesh_);
    bent_ = bent;
    const double reach = plane_slack() * std::sqrt(key.area) + position_tolerance(key.centroid);
    union_visits_ = 0;
    for (const FaceId face : faces_around(i, reach)) {
        std::vector<FaceId> parts;
        if (!grow_union(key, normal, face, parts)) continue;
        for (const FaceId part : parts)
            claim(part, i, MatchStage::plane);
        return true;
    }
    return false;
}

// Adds `face` and further neighbours to the parts until they are complete; if that fails, removes it.
bool FaceMatcher::grow_union(const FaceKey& key, const Vec3& normal, FaceId face,
                             std::vector<FaceId>& parts) {
    const std::size_t max_parts = bent_ ? 6 : 12;
    const std::size_t max_tries = bent_ ? 300 : 2000;
    if (parts.size() == max_parts || ++union_visits_ > max_tries || !is_part(key, normal, face)) return false;
    ++lookup_.visits;
    parts.push_back(face);
    double area = 0.0;
    for (const FaceId part : parts)
        area += index_.key(part).area;
    if (area >= part_fraction * key.area &&
        (bent_ ? has_area_vector(index_, key, parts) : area <= whole_fraction * key.area) &&
        has_corner_mean(mesh_, key, parts, bent_ ? bent_mean_slack : mean_slack))
        return true;
    if (area < (bent_ ? max_bent_area : part_fraction) * key.area) {
        for (std::size_t k = 0; k < parts.size(); ++k) {
            for (const FaceId next : lookup_.neighbours.of(parts[k])) {
                if (std::find(parts.begin(), parts.end(), next) == parts.end() &&
                    grow_union(key, normal, next, parts))
                    return true;
            }
        }
    }
    parts.pop_back();
    return false;
}

bool FaceMatcher::is_part(const FaceKey& key, const Vec3& normal, FaceId face) const {
    const FaceKey& candidate = index_.key(face);
    // Around a bent face nearly every neighbour could be a part; only near ones are tried.
    if (bent_ && (candidate.centroid - key.centroid).norm() > 0.7 * std::sqrt(key.area)) return false;
    return is_free(face) && index_.base(face) == base_material(key.material, surfaces_) &&
           candidate.normal.dot(normal) > (bent_ ? 0.8 : 0.999) &&
           std::abs(normal.dot(candidate.centroid - key.centroid)) <=
               plane_slack() * std::sqrt(key.area) + position_tolerance(key.centroid);
}

}  // namespace slipface
