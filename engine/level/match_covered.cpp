// New faces that cover old ones, or parts of them: each has the type of most of its area.
#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "face_cover.h"
#include "face_matcher.h"
#include "slipface/base/parallel.h"

namespace slipface {
namespace {

// Of an old face without an outline by the new ones that it is to give its type to. One whose octagon holds
// little of the new faces has another outline, or is gone.
constexpr double filled_fraction = 0.35;

constexpr double more_than_half = 0.52;  // of a new face: half of it is a question

constexpr double part_of_it = 0.01;  // of a new face: what it has of one that it came from

constexpr double left_fraction = 0.1;  // of an old face, by what is still there
constexpr double nearly_whole = 0.97;

// A parallel face off the plane is another face, in the old face's size. A tilted one leaves the plane, in
// the larger one's size.
constexpr double off_plane = 0.02, off_plane_by_tilt = 0.7;

constexpr std::size_t few_pieces = 3;  // a bevel leaves one of a face; remeshing, many

// Cosine of old and new normal: of a face that turned over, one that is tilted more is another.
constexpr double least_bent = 0.99;

constexpr double wide = 0.1;  // in the old face's size: how far from its outline faces are looked for

// Of all its triangles, seen along its normal. The area of a face that crosses itself is only the difference
// of its sides.
double seen_area(const Mesh& mesh, FaceId face, const Vec3& normal) {
    double area = 0.0;
    for (std::uint32_t t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1]; ++t) {
        const auto& corners = mesh.triangles[t];
        const Vec3 from = mesh.corner_position(corners[0]).cast<double>();
        const Vec3 a = mesh.corner_position(corners[1]).cast<double>() - from;
        const Vec3 b = mesh.corner_position(corners[2]).cast<double>() - from;
        area += 0.5 * std::abs(normal.dot(a.cross(b)));
    }
    return area;
}

}  // namespace

bool FaceMatcher::is_covered(std::size_t i) const {
    return found_[i] == MatchStage::plane && !outlines_[i].empty() && !likely_[i];
}

bool FaceMatcher::lies_in_plane(FaceId face, std::size_t i) const {
    const FaceKey &old = key(i), &here = index_.key(face);
    return here.normal.dot(unit_or_zero(old.normal)) > 0.9995 &&
           std::abs(here.normal.dot(here.centroid - old.centroid)) <= in_plane(old);
}

// Whether a few new faces lie in the old one's plane and place, but look the other way, in a part with more
// faces than before: a bevel that is wider than the face turned it over.
bool FaceMatcher::has_turned_over(std::size_t i) {
    const std::size_t part = i < parts_.of.size() ? parts_.of[i] : 0;
    if (part == 0 || part > parts_.parts.size()) return false;
    const FaceKey& key = this->key(i);
    std::size_t over = 0;
    for (const FaceId face : faces_at_outline(i)) {
        const FaceKey& there = index_.key(face);
        const bool turned = is_free(face) && there.normal.dot(unit_or_zero(key.normal)) < -0.9995 &&
                            std::abs(there.normal.dot(there.centroid - key.centroid)) <= in_plane(key) &&
                            index_.covers(face, key.centroid, key.normal) &&
                            pieces().parts[pieces().of[face]].faces > parts_.parts[part - 1].faces;
        over += turned ? 1 : 0;
    }
    return over > 0 && over < few_pieces;
}

FaceMatcher::Covers FaceMatcher::find_covers(std::size_t i, double least_dot, bool any_material) const {
    Covers covers;
    const FaceKey& key = this->key(i);
    const double size = std::sqrt(key.area);
    const Vec3 normal = unit_or_zero(key.normal);
    Aabb box;
    for (const Vec3& corner : outlines_[i])
        box.add(corner);
    box.min -= Vec3::Constant(wide * size + position_tolerance(key.centroid));
    box.max += Vec3::Constant(wide * size + position_tolerance(key.centroid));
    for (const FaceId face : faces_in(i, box, any_material, covers.visits)) {
        const FaceKey& candidate = index_.key(face);
        const double along = candidate.normal.dot(normal);
        if (!is_free(face) || !(along > least_dot)) continue;
        const double tilt = candidate.normal.cross(normal).norm();
        const double off = std::abs(candidate.normal.dot(candidate.centroid - key.centroid));
        const double bend = tilt * std::max(size, std::sqrt(candidate.area));
        if (off > off_plane * size + off_plane_by_tilt * bend + position_tolerance(key.centroid)) continue;
        covers.visits += mesh_.face_corner_count(face);
        const bool flat = lies_in_plane(face, i);
        if (flat || (is_wanted(i) && !(turned_over_[i] && along < least_bent)))
            covers.found.push_back({face, i, off, 0.0, flat});
    }
    return covers;
}

// Whether all of the face lies before the plane, or all of it behind.
bool FaceMatcher::is_off_plane(FaceId face, const FaceKey& key) const {
    const Vec3 normal = unit_or_zero(key.normal);
    bool before = true, behind = true;
    for (std::uint32_t c = mesh_.face_first_corner[face]; c < mesh_.face_first_corner[face + 1]; ++c) {
        const double height = normal.dot(mesh_.corner_position(c).cast<double>() - key.centroid);
        before = before && height > in_plane(key);
        behind = behind && height < -in_plane(key);
    }
    return before || behind;
}

// Of which an old face must cover half. The area of a face that crosses itself is only the difference of its
// sides, which is enough if it is joined to an old face's corners and these are all left: the rim of an
// inset.
double FaceMatcher::area_to_cover(FaceId face, std::span<const Cover> covers) {
    constexpr double crossing = 1.02;
    const FaceKey& key = index_.key(face);
    const double seen = seen_area(mesh_, face, key.normal);
    const auto joined = [&](const Cover& cover) {
        const std::vector<Vec3> left = corners_left(cover.i);
        return left.size() >= outlines_[cover.i].size() && is_joined(face, left);
    };
    if (seen <= crossing * key.area || std::any_of(covers.begin(), covers.end(), joined)) return key.area;
    return seen;
}

void FaceMatcher::match_covered(double least_dot, bool any_material) {
    std::vector<Cover> all;
    const bool is_first = turned_over_.empty();
    turned_over_.resize(stored_.size(), false);
    std::vector<std::size_t> searched;
    for (std::size_t i = 0; i < stored_.size(); ++i) {
        if (!is_wanted(i) && !twin_[i] && !is_covered(i)) continue;
        if (!(key(i).area > 0.0) || unit_or_zero(key(i).normal).isZero()) continue;
        if (outlines_[i].empty()) {
            outlines_[i] = likely_outline(key(i));
            likely_[i] = true;
        }
        if (is_first && lookup_.visits < max_visits) turned_over_[i] = is_wanted(i) && has_turned_over(i);
        searched.push_back(i);
    }
    constexpr std::size_t at_once = 256;  // then the work is counted
    for (std::size_t begin = 0; begin < searched.size() && lookup_.visits < max_visits; begin += at_once) {
        std::vector<Covers> covers(std::min(at_once, searched.size() - begin));
        parallel_for(covers.size(), 32, [&](std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k)
                covers[k] = find_covers(searched[begin + k], least_dot, any_material);
        });
        for (std::size_t k = 0; k < covers.size(); ++k) {
            for (const Cover& cover : covers[k].found)
                all.push_back(cover);
            lookup_.visits += covers[k].visits;
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const Cover& a, const Cover& b) { return a.face < b.face; });
    const auto each_face = [&](const auto& apply) {
        for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
            for (end = begin; end < all.size() && all[end].face == all[begin].face;)
                ++end;
            apply(std::span(all).subspan(begin, end - begin));
        }
    };
    // Of each old face, covered by new ones, and by those of them in its plane.
    std::vector<double> total(stored_.size(), 0.0), flat(stored_.size(), 0.0);
    each_face([&](std::span<Cover> covers) {
        std::vector<OldFace> old;
        for (const Cover& cover : covers)
            old.push_back({outlines_[cover.i], cover.distance});
        const FaceId face = covers[0].face;
        const double slack = 4.0 * position_tolerance(index_.key(face).centroid);
        const std::vector<double> areas = covered_areas(mesh_, face, old, slack);
        for (std::size_t k = 0; k < covers.size(); ++k) {
            covers[k].area = areas[k];
            total[covers[k].i] += areas[k];
            flat[covers[k].i] += covers[k].flat ? areas[k] : 0.0;
        }
    });
    // Beside what is left of a face in its plane, small tilted faces are not it: its edges were bevelled. Nor
    // are faces that lie before or behind it, or across it, or any if all of it is left.
    for (Cover& cover : all) {
        const double area = key(cover.i).area;
        const FaceKey& face = index_.key(cover.face);
        const double along = face.normal.dot(unit_or_zero(key(cover.i).normal));
        const bool across = along < 0.97;
        const bool another = flat[cover.i] > nearly_whole * area ||
                             (along > 0.9995 && is_off_plane(cover.face, key(cover.i))) ||
                             (across && flat[cover.i] > 0.5 * area) ||
                             face.area < (across ? 0.25 : 0.08) * area;
        if (!cover.flat && flat[cover.i] > left_fraction * area && another) {
            total[cover.i] -= cover.area;
            cover.area = 0.0;
        }
    }
    const auto is_other = [&](std::size_t i) {
        return likely_[i] && total[i] < filled_fraction * key(i).area;
    };
    std::vector<double> given(stored_.size(), 0.0);  // of `total`: by faces that have its type now
    each_face([&](std::span<Cover> covers) {
        const FaceId face = covers[0].face;
        std::map<SurfaceId, double> shares;
        double own = 0.0;  // on faces of its material: a merged face has that of one of them
        for (const Cover& cover : covers) {
            if (is_other(cover.i)) continue;
            shares[*types_[cover.i]] += cover.area;
            own += bases_[cover.i] == index_.base(face) ? cover.area : 0.0;
        }
        const double area = area_to_cover(face, covers);
        if (own <= part_of_it * area) return;
        for (const auto& [type, share] : shares) {
            if (share <= more_than_half * area) continue;
            claims_[face] = MatchStage::plane;
            result_.overrides[face] = type;
        }
        for (const Cover& cover : covers)
            if (result_.overrides[face] == types_[cover.i]) given[cover.i] += cover.area;
    });
    for (const Cover& cover : all)
        if (cover.area > part_of_it * index_.key(cover.face).area && !is_other(cover.i))
            refused_.push_back({cover.face, cover.i});
    std::sort(refused_.begin(), refused_.end());
    for (std::size_t i = 0; i < stored_.size(); ++i) {
        if (twin_[i] || total[i] <= left_fraction * key(i).area) continue;
        if (given[i] > 0.5 * total[i])
            found_[i] = MatchStage::plane;
        else if (any_material && total[i] > 0.5 * key(i).area)
            lost_[i] = true;  // left for the user
    }
}

}  // namespace slipface
