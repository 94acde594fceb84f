// New faces of a part that was remeshed: its edges are rounded, and what is neither in the plane of an old
// face nor near it has the type of the nearest one.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "face_matcher.h"
#include "part_support.h"

namespace slipface {
namespace {

constexpr double least_along = 0.5;             // the cosine of new and old normal
constexpr double max_depth = 0.5;               // of the old face's size
constexpr double most_of_it = 0.55;             // of a new face's points
constexpr std::size_t max_pairs = 100'000'000;  // of new and old faces of a piece; edges matter to small ones

struct Near {
    double distance = 0.0;
    bool inside = false;  // the point is above or below the polygon
};

Near distance_to(const Vec3& point, std::span<const Vec3> polygon, const Vec3& normal) {
    Near near{std::numeric_limits<double>::infinity(), true};
    bool left = false, right = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i], from = point - polygon[i];
        const double side = edge.cross(from).dot(normal);
        (side >= 0.0 ? left : right) = true;
        const double share = std::clamp(edge.dot(from) / std::max(edge.squaredNorm(), 1e-30), 0.0, 1.0);
        near.distance = std::min(near.distance, (from - share * edge).norm());
    }
    near.inside = !(left && right);
    if (near.inside) near.distance = std::abs(normal.dot(point - polygon[0]));
    return near;
}

}  // namespace

void FaceMatcher::match_remeshed() {
    std::vector<std::vector<std::size_t>> painted(parts_.parts.size());
    std::vector<bool> is_left(parts_.parts.size(), false);
    std::vector<std::size_t> in_plane(parts_.parts.size(), 0);
    for (std::size_t i = 0; i < stored_.size() && i < parts_.of.size(); ++i) {
        const std::size_t part = parts_.of[i];
        if (part == 0 || part > painted.size() || !types_[i]) continue;
        painted[part - 1].push_back(i);
        if (found_[i] == MatchStage::exact || flat_[i] == Flat::whole_in_few || turned_over_[i] || lost_[i] ||
            likely_[i] || outlines_[i].size() < 3)
            is_left[part - 1] = true;
        in_plane[part - 1] += flat_[i] != Flat::none ? 1 : 0;
    }
    std::vector<std::size_t> searched;
    std::vector<Aabb> around;  // of these, where a piece of them may be
    for (std::size_t part = 0; part < painted.size(); ++part) {
        const bool object = remeshed_objects().contains(parts_.parts[part].object.name);
        // A bevel leaves one piece of nearly every face in its plane.
        if (painted[part].empty() || (is_left[part] && !object) ||
            4 * in_plane[part] > 3 * painted[part].size())
            continue;
        const PartMotion* const motion = motion_of(painted[part][0]);
        const bool all = painted[part].size() >= parts_.parts[part].faces;
        if (!all && motion != nullptr && !motion->is_identity()) continue;  // its box moved, too
        searched.push_back(part);
        const Aabb box = moved_box(part);
        const Vec3 slack = Vec3::Constant(remeshed_slack * box.size().norm());
        around.push_back({box.min - slack, box.max + slack});
    }
    for (std::uint32_t piece = 0; piece < pieces().parts.size() && lookup_.visits < max_visits; ++piece) {
        const Aabb& box = pieces().parts[piece].box;
        lookup_.visits += searched.size();
        if (std::none_of(around.begin(), around.end(), [&](const Aabb& other) { return touch(box, other); }))
            continue;
        const std::vector<std::size_t>& from = remeshed_from(piece);
        std::vector<Nearby> old;
        std::vector<Aabb> partly_painted;
        for (const std::size_t part : from) {
            if (pieces().parts[piece].faces == parts_.parts[part].faces) continue;
            if (std::binary_search(searched.begin(), searched.end(), part))
                for (const std::size_t i : painted[part])
                    old.push_back(nearby(i));
            if (painted[part].size() < parts_.parts[part].faces) partly_painted.push_back(moved_box(part));
        }
        const std::span<const FaceId> faces(&pieces().sorted[pieces().first[piece]],
                                            pieces().first[piece + 1] - pieces().first[piece]);
        if (old.empty() || faces.size() * old.size() > max_pairs) continue;
        for (const FaceId face : faces)
            if (is_free(face) && lookup_.visits < max_visits) claim_nearest(face, old, partly_painted);
    }
}

FaceMatcher::Nearby FaceMatcher::nearby(std::size_t i) const {
    Nearby old{i, unit_or_zero(key(i).normal), max_depth * std::sqrt(key(i).area), {}};
    for (const Vec3& corner : outlines_[i]) {
        old.reach.add(corner - Vec3::Constant(old.depth));
        old.reach.add(corner + Vec3::Constant(old.depth));
    }
    return old;
}

// `boxes`: of the old parts of which not all faces were painted. A side of a box that is nearer than any
// painted face was not painted.
void FaceMatcher::claim_nearest(FaceId face, std::span<const Nearby> painted, std::span<const Aabb> boxes) {
    const std::uint32_t first = mesh_.face_first_corner[face], count = mesh_.face_corner_count(face);
    const FaceKey& key = index_.key(face);
    Aabb around;
    for (std::uint32_t c = 0; c < count; ++c)
        around.add(mesh_.corner_position(first + c).cast<double>());
    lookup_.visits += painted.size() / 8;
    std::vector<Nearby> near_it;
    for (const Nearby& old : painted)
        if (touch(old.reach, around) && key.normal.dot(old.normal) > least_along) near_it.push_back(old);
    std::map<SurfaceId, double> votes;
    std::vector<std::size_t> voters;
    double points = 0.0;
    for (std::uint32_t c = 0; c < count; ++c) {
        for (const double share : {0.2, 0.5, 0.8}) {
            const Vec3 corner = mesh_.corner_position(first + c).cast<double>();
            const Vec3 point = key.centroid + share * (corner - key.centroid);
            points += 1.0;
            double nearest = std::numeric_limits<double>::infinity();
            for (const Aabb& box : boxes) {
                const double slack = 1e-3 * box.size().norm();
                for (int axis = 0; axis < 3; ++axis) {
                    if (std::abs(key.normal[axis]) <= least_along) continue;
                    Vec3 side = point.cwiseMax(box.min).cwiseMin(box.max);
                    side[axis] = key.normal[axis] > 0.0 ? box.max[axis] : box.min[axis];
                    nearest = std::min(nearest, (side - point).norm() + slack);
                }
            }
            std::size_t best = no_id;
            for (const Nearby& old : near_it) {
                ++lookup_.visits;
                const Near near = distance_to(point, outlines_[old.i], old.normal);
                if ((!boxes.empty() && !near.inside) || near.distance >= nearest || near.distance > old.depth)
                    continue;
                nearest = near.distance;
                best = old.i;
            }
            if (best == no_id) continue;
            votes[*types_[best]] += 1.0;
            voters.push_back(best);
        }
    }
    for (const auto& [type, found] : votes) {
        if (found <= most_of_it * points) continue;
        claims_[face] = MatchStage::plane;
        result_.overrides[face] = type;
        for (const std::size_t i : voters)
            if (types_[i] == type) found_[i] = MatchStage::plane;
    }
}

}  // namespace slipface
