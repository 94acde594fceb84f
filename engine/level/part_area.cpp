// Parts of whose corners an edit left too few, by their areas: first all parts together, as a level that was
// turned as a whole, then each by itself.
#include <algorithm>

#include "area_fit.h"
#include "motion_finder.h"

namespace slipface {
namespace {

constexpr double enough_area = 0.6;  // of the paint, after a motion
constexpr double less_area = 0.06;   // by which another motion is as good
constexpr double more_than_staying = 0.2;
constexpr double edited_area = 0.85;  // of a part's paint where it was: it was edited in its place

}  // namespace

// Whether too little of the part is where it was, and no motion explains it.
bool MotionFinder::is_missing(std::size_t i) {
    const Part& part = parts_[i];
    return !support_.points(i).empty() && !part.voted && !part.certain && part.best.is_identity() &&
           part.best_support.corners < lost_below && part.best_support.keys < lost_below;
}

void MotionFinder::fit_areas() {
    std::vector<std::size_t> missing, painted;
    std::optional<AreaFit> fit;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (support_.points(i).empty()) continue;
        painted.push_back(i);
        if (!is_missing(i)) continue;
        if (!fit) fit.emplace(lookup_, surfaces_, stored_, overrides_);
        if (!fit->may_search()) continue;
        if (fit->covered(std::span(&i, 1), PartMotion{}) < edited_area) missing.push_back(i);
    }
    if (missing.empty()) return;
    const MeshParts& all = support_.all();
    fit_level(*fit, painted);
    std::vector<bool> taken(all.parts.size(), false);
    const auto take = [&](std::size_t i) {
        for (const std::uint32_t part : support_.parts_at(i, parts_[i].best))
            taken[part] = true;
    };
    for (std::uint32_t part = 0; part < taken.size(); ++part)
        taken[part] = support_.is_occupied(part);
    for (const std::size_t i : painted)
        if (!is_missing(i)) take(i);
    std::vector<FaceId> places;
    for (const std::size_t i : missing) {
        if (!is_missing(i)) continue;
        const double size = stored_.parts[i].box.size().norm();
        std::vector<AreaMotion> found;
        for (std::uint32_t part = 0; part < taken.size(); ++part) {
            const double other = all.parts[part].box.size().norm();
            if (taken[part] || other < 0.5 * size || other > 2.0 * size || !fit->may_search()) continue;
            places.assign(all.sorted.begin() + all.first[part], all.sorted.begin() + all.first[part + 1]);
            const std::vector<AreaMotion> there = fit->motions(std::span(&i, 1), places);
            found.insert(found.end(), there.begin(), there.end());
        }
        std::stable_sort(found.begin(), found.end(),
                         [](const AreaMotion& a, const AreaMotion& b) { return a.covered > b.covered; });
        const PartMotion* const motion = clear_one(*fit, std::span(&i, 1), found);
        if (motion == nullptr) continue;
        accept_area(i, *motion);
        take(i);
    }
}

// The motion that all parts made, if they did.
void MotionFinder::fit_level(AreaFit& fit, const std::vector<std::size_t>& painted) {
    std::vector<FaceId> faces(mesh_.face_count());
    for (FaceId face = 0; face < faces.size(); ++face)
        faces[face] = face;
    const std::vector<AreaMotion> found = fit.motions(painted, faces);
    const PartMotion* const motion = clear_one(fit, painted, found);
    if (motion == nullptr) return;
    for (const std::size_t i : painted) {
        Part& part = parts_[i];
        const bool own = !part.best.is_identity() && part.best_support.sum() > 2.0 - 1e-9;
        const bool stays = part.best.is_identity() && !is_missing(i);
        if (own || stays || part.certain) continue;
        // Of what is missing little may be left.
        if (is_missing(i) || fit.covered(std::span(&i, 1), *motion) >= enough_area) accept_area(i, *motion);
    }
}

void MotionFinder::accept_area(std::size_t i, const PartMotion& motion) {
    Part& part = parts_[i];
    part.best = motion;
    part.best_support = support_.support(i, motion, 0.0);
    part.best.guessed = true;
    part.voted = true;
    places_[i] = support_.moved_box(i, motion);
}

// The first of the motions of these parts, or one of those that cover as much which keeps the order of the
// vertices as no other does; null if it is a question which of them is theirs, or if none covers clearly more
// than staying does.
const PartMotion* MotionFinder::clear_one(AreaFit& fit, std::span<const std::size_t> parts,
                                          const std::vector<AreaMotion>& motions) {
    constexpr double much_more = 0.4;
    if (motions.empty() || motions[0].covered < enough_area ||
        motions[0].covered < fit.covered(parts, PartMotion{}) + more_than_staying)
        return nullptr;
    struct Kind {
        const PartMotion* motion;
        double order;
    };
    std::vector<Kind> kinds;
    for (const AreaMotion& one : motions) {
        if (one.covered < motions[0].covered - less_area) continue;
        const bool known = std::any_of(kinds.begin(), kinds.end(), [&](const Kind& kind) {
            return std::none_of(parts.begin(), parts.end(),
                                [&](std::size_t i) { return types_.differ(i, *kind.motion, one.motion); });
        });
        if (known) continue;
        double kept = 0.0, all = 0.0;
        for (const std::size_t i : parts) {
            const auto anchors = static_cast<double>(stored_.parts[i].anchors.size());
            const std::optional<double> order = support_.vertex_order_kept(i, one.motion);
            if (order) kept += *order * anchors;
            if (order) all += anchors;
        }
        kinds.push_back({&one.motion, all > 0.0 ? kept / all : 0.0});
    }
    std::stable_sort(kinds.begin(), kinds.end(),
                     [](const Kind& a, const Kind& b) { return a.order > b.order; });
    if (kinds.size() > 1 &&
        (kinds[0].order < vertices_in_order || kinds[1].order > kinds[0].order - much_more))
        return nullptr;
    return kinds[0].motion;
}

}  // namespace slipface
