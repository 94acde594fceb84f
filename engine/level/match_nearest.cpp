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
    Aabb box;
    for (const double side : {best_distance, -best_distance}) {
        box.add(key.centroid + side * normal - Vec3::Constant(exact));
        box.add(key.centroid + side * normal + Vec3::Constant(exact));
    }
    for (const FaceId face : faces_in(i, box, true)) {
        const FaceKey& candidate = index_.key(face);
        if (!(candidate.normal.dot(normal) > 0.9995)) continue;
        const Vec3 offset = candidate.centroid - key.centroid;
        const double along = std::abs(normal.dot(offset));
        if (along <= exact) {
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

// Those that touch the box of the outline.
std::vector<FaceId> FaceMatcher::faces_at_outline(std::size_t i) {
    Aabb box;
    for (const Vec3& corner : outlines_[i])
        box.add(corner);
    const Vec3 room = Vec3::Constant(position_tolerance(key(i).centroid));
    return faces_in(i, {box.min - room, box.max + room});
}

// A face that had a corner twice, which a tool took out. Of several with the same corners it is the one that
// comes as late as before.
bool FaceMatcher::match_repeated(std::size_t i) {
    const FaceKey& key = this->key(i);
    std::vector<Vec3> corners = outlines_[i];
    const auto same = [&](const Vec3& a, const Vec3& b) {
        return (a - b).norm() <= 2.0 * position_tolerance(key.centroid);
    };
    corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
    while (corners.size() > 1 && same(corners.front(), corners.back()))
        corners.pop_back();
    if (corners.size() < 3 || corners.size() == outlines_[i].size()) return false;
    std::vector<FaceId> found;
    for (const FaceId face : faces_at_outline(i)) {
        if (mesh_.face_corner_count(face) != corners.size() ||
            !(index_.key(face).normal.dot(key.normal) > 0.0))
            continue;
        const std::uint32_t first = mesh_.face_first_corner[face];
        const auto has = [&](const Vec3& corner) {
            for (std::uint32_t c = 0; c < corners.size(); ++c)
                if (same(mesh_.corner_position(first + c).cast<double>(), corner)) return true;
            return false;
        };
        if (std::all_of(corners.begin(), corners.end(), has)) found.push_back(face);
    }
    if (key.copy >= found.size() || !is_free(found[key.copy])) return false;
    claim(found[key.copy], i, MatchStage::nearest);
    return true;
}

// A face of which one corner moved, perhaps farther than it is wide: the others come one after another as
// before.
bool FaceMatcher::match_corners(std::size_t i) {
    const std::size_t part = i < parts_.of.size() ? parts_.of[i] : 0;
    if (part == 0 || part > parts_.parts.size()) return false;
    if (outlines_[i].empty() || likely_[i] || !sharpen(i)) return false;
    const FaceKey& key = this->key(i);
    const std::vector<Vec3>& corners = outlines_[i];
    const std::size_t count = corners.size();
    FaceId best = no_id;
    for (const FaceId face : faces_at_outline(i)) {
        if (!is_free(face) || mesh_.face_corner_count(face) != count ||
            pieces().parts[pieces().of[face]].faces != parts_.parts[part - 1].faces ||
            !(index_.key(face).normal.dot(key.normal) > 0.5))
            continue;
        const std::uint32_t first = mesh_.face_first_corner[face];
        std::size_t most = 0;
        for (std::size_t turn = 0; turn < count; ++turn) {
            std::size_t same = 0;
            for (std::uint32_t c = 0; c < count; ++c) {
                const Vec3 position = mesh_.corner_position(first + c).cast<double>();
                const double distance = (position - corners[(c + turn) % count]).norm();
                same += distance <= 2.0 * position_tolerance(key.centroid) ? 1 : 0;
            }
            most = std::max(most, same);
        }
        if (most + 1 < count) continue;
        if (best != no_id) return false;
        best = face;
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
