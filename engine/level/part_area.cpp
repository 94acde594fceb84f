// Parts of whose corners an edit left too few: they did what most of the painted faces did. If that is not
// known, the faces that are left say it, then the areas of all parts together, then of each by itself.
#include <algorithm>
#include <map>
#include <numeric>

#include "area_fit.h"
#include "motion_finder.h"

namespace slipface {
namespace {

constexpr double enough_area = 0.6;  // of the paint, after a motion
constexpr double less_area = 0.06;   // by which another motion is as good
constexpr double more_than_staying = 0.2;
constexpr double some_faces = 0.1;    // of a part's painted ones, where they were before a motion
constexpr std::size_t many = 10;      // parts with as many faces as one are a level
constexpr double edited_area = 0.85;  // of a part's paint where it was: it was edited in its place

}  // namespace

// Whether too little of the part is where it was, and no motion explains it.
bool MotionFinder::is_missing(std::size_t i) {
    const Part& part = parts_[i];
    return !support_.points(i).empty() && !part.voted && !part.certain && part.best.is_identity() &&
           part.best_support.corners < lost_below && part.best_support.keys < lost_below;
}

void MotionFinder::fit_areas() {
    std::vector<std::size_t> painted, missing;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (support_.points(i).empty()) continue;
        painted.push_back(i);
        if (is_missing(i)) missing.push_back(i);
    }
    if (missing.empty()) return;
    AreaFit fit(lookup_, surfaces_, stored_, overrides_);
    const std::optional<PartMotion> most = motion_of_most();
    if (most && !most->is_identity()) return follow_areas(fit, painted, *most);
    std::erase_if(missing,
                  [&](std::size_t i) { return fit.covered(std::span(&i, 1), PartMotion{}) >= edited_area; });
    if (missing.empty()) return;
    std::optional<PartMotion> level = motion_of_kept(missing);
    if (!level && !most) {
        std::vector<FaceId> faces(mesh_.face_count());
        std::iota(faces.begin(), faces.end(), FaceId{0});
        level = clear_one(fit, painted, fit.motions(painted, faces));
    }
    if (level) follow_areas(fit, most ? missing : painted, *level);
    std::vector<bool> taken(support_.all().parts.size(), false);
    for (std::uint32_t part = 0; part < taken.size(); ++part)
        taken[part] = support_.is_occupied(part);
    for (const std::size_t i : painted)
        if (!is_missing(i)) take_places(i, taken);
    fit_objects(fit, missing, taken);
    fit_each(fit, missing, taken);
    follow_objects(fit, missing);
}

// The mesh's parts in which the part is now.
void MotionFinder::take_places(std::size_t i, std::vector<bool>& taken) {
    for (const std::uint32_t part : support_.parts_at(i, parts_[i].best))
        taken[part] = true;
}

// The missing parts of an object that is still there made one motion.
void MotionFinder::fit_objects(AreaFit& fit, std::span<const std::size_t> missing, std::vector<bool>& taken) {
    const MeshParts& all = support_.all();
    std::map<std::uint32_t, std::vector<std::size_t>> objects;
    for (const std::size_t i : missing)
        if (is_missing(i) && stored_.parts[i].object.name != 0)
            objects[stored_.parts[i].object.name].push_back(i);
    for (const auto& [name, parts] : objects) {
        std::vector<FaceId> places;
        for (std::uint32_t part = 0; part < taken.size(); ++part)
            if (!taken[part] && all.parts[part].object.name == name)
                places.insert(places.end(), all.sorted.begin() + all.first[part],
                              all.sorted.begin() + all.first[part + 1]);
        if (places.empty() || !fit.may_search()) continue;
        const std::optional<PartMotion> motion = clear_one(fit, parts, fit.motions(parts, places));
        if (!motion) continue;
        for (const std::size_t i : parts) {
            accept_area(i, *motion);
            take_places(i, taken);
        }
    }
}

void MotionFinder::fit_each(AreaFit& fit, std::span<const std::size_t> missing, std::vector<bool>& taken) {
    const MeshParts& all = support_.all();
    std::vector<FaceId> places;
    for (const std::size_t i : missing) {
        if (!is_missing(i)) continue;
        const double size = stored_.parts[i].box.size().norm();
        std::vector<AreaMotion> found;
        for (std::uint32_t part = 0; part < taken.size(); ++part) {
            const double other = all.parts[part].box.size().norm();
            if (taken[part] || support_.differ(i, part) || other < 0.5 * size || other > 2.0 * size ||
                !fit.may_search())
                continue;
            places.assign(all.sorted.begin() + all.first[part], all.sorted.begin() + all.first[part + 1]);
            const std::vector<AreaMotion> there = fit.motions(std::span(&i, 1), places);
            found.insert(found.end(), there.begin(), there.end());
        }
        std::stable_sort(found.begin(), found.end(),
                         [](const AreaMotion& a, const AreaMotion& b) { return a.covered > b.covered; });
        const std::optional<PartMotion> motion = clear_one(fit, std::span(&i, 1), found);
        if (!motion) continue;
        accept_area(i, *motion);
        take_places(i, taken);
    }
}

// What is still missing did what another part of its object did, if faces are there then.
void MotionFinder::follow_objects(AreaFit& fit, std::span<const std::size_t> missing) {
    for (const std::size_t i : missing) {
        const std::uint32_t name = stored_.parts[i].object.name;
        for (std::size_t k = 0; k < parts_.size() && name != 0 && is_missing(i); ++k)
            if (stored_.parts[k].object.name == name && !parts_[k].best.is_identity() && fit.may_search() &&
                fit.covered(std::span(&i, 1), parts_[k].best) >= enough_area)
                accept_area(i, parts_[k].best);
    }
}

// What the parts with most of the painted faces did, if they have half of them.
std::optional<PartMotion> MotionFinder::motion_of_most() const {
    std::size_t all = 0;
    for (const std::size_t faces : painted_)
        all += faces;
    for (const Move& move : moves_)
        if (2 * move.faces > all) return move.motion;
    return std::nullopt;
}

// Parts that no motion of their own explains did what the level did. One with many faces does so only if it
// puts some of them onto faces; an edit may leave too little of a model to tell.
void MotionFinder::follow_areas(AreaFit& fit, std::span<const std::size_t> parts, const PartMotion& level) {
    std::size_t all = 0;
    for (const std::size_t i : parts)
        all += painted_[i];
    for (const std::size_t i : parts) {
        Part& part = parts_[i];
        const bool own = !part.best.is_identity() && part.best_support.sum() > 2.0 - 1e-9;
        const bool stays = part.best.is_identity() && !is_missing(i);
        if (own || stays || part.certain || same(stored_.parts[i].box, part.best, level) ||
            support_.is_another_object(i, level))  // a copy of it
            continue;
        const double there = fit.covered(std::span(&i, 1), level);
        const bool small = many * painted_[i] < all;
        if (there >= enough_area || support_.support(i, level, 0.0).keys >= some_faces ||
            (small && there >= fit.covered(std::span(&i, 1), part.best)))
            accept_area(i, level);
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

// One of the motions of these parts; none if it is a question which of them is theirs, or if none covers
// clearly more than staying does.
std::optional<PartMotion> MotionFinder::clear_one(AreaFit& fit, std::span<const std::size_t> parts,
                                                  const std::vector<AreaMotion>& motions) {
    if (motions.empty() || motions[0].covered < enough_area ||
        motions[0].covered < fit.covered(parts, PartMotion{}) + more_than_staying)
        return std::nullopt;
    return of_one_kind(parts, motions, motions[0].covered - less_area);
}

// The first of the motions that cover at least as much, or that of them which keeps the order of the vertices
// as no other does; none if they give faces different types.
std::optional<PartMotion> MotionFinder::of_one_kind(std::span<const std::size_t> parts,
                                                    const std::vector<AreaMotion>& motions, double least) {
    constexpr double much_more = 0.25;
    struct Kind {
        const PartMotion* motion;
        double order;
    };
    std::vector<Kind> kinds;
    for (const AreaMotion& one : motions) {
        if (one.covered < least) continue;
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
        return std::nullopt;
    return *kinds[0].motion;
}

}  // namespace slipface
