// The search for the motion of one part: a motion is guessed from few faces or from boxes and then checked
// against all anchors and a sample of the painted faces.
#include <algorithm>
#include <cmath>

#include "motion_finder.h"
#include "motion_fit.h"

namespace slipface {
namespace {

constexpr std::size_t max_guesses_per_part = 8000;  // motions examined
constexpr std::size_t max_places = 1600;            // of three corners
constexpr double clearly_more = 0.15;               // than staying explains; the most is 2
constexpr double clearly_more_rim = 0.1;            // of the anchor corners alone
constexpr std::size_t max_candidates = 1000;        // motions to vote on

Eigen::Matrix3Xd columns(const std::vector<Vec3>& corners) {
    return Eigen::Map<const Eigen::Matrix3Xd>(corners.front().data(), 3,
                                              static_cast<Eigen::Index>(corners.size()));
}

}  // namespace

MotionFinder::MotionFinder(FaceLookup& lookup, SurfaceTable surfaces, const PaintParts& parts,
                           const std::vector<StoredOverride>& stored, const VertexMotions& of_vertices)
    : lookup_(lookup),
      mesh_(lookup.mesh),
      index_(lookup.index),
      surfaces_(surfaces),
      stored_(parts),
      of_vertices_(of_vertices),
      support_(mesh_, index_, surfaces, parts, stored),
      types_(parts, stored),
      similar_(mesh_),
      parts_(parts.parts.size()),
      painted_(parts.parts.size(), 0) {
    for (const std::uint16_t part : parts.of)
        if (part > 0 && part <= painted_.size()) ++painted_[part - 1u];
}

PartMotions MotionFinder::run() && {
    std::size_t painted = 0, gone = 0;
    for (std::size_t part = 0; part < parts_.size(); ++part) {
        parts_[part].staying = support_.support(part, PartMotion{}, 0.0);
        if (support_.points(part).empty()) continue;
        ++painted;
        const bool moved = of_vertices_[part] && !of_vertices_[part]->is_identity();
        if (parts_[part].staying.corners >= lost_below && !moved) continue;
        ++gone;
        support_.set_gone(part);
    }
    // Of parts without paint only the box is known: they do what most of the others do.
    for (std::size_t part = 0; part < parts_.size(); ++part)
        if (2 * gone > painted && support_.points(part).empty()) support_.set_gone(part);
    for (std::size_t part = 0; part < parts_.size(); ++part)
        find(part);
    choose();
    one_part_each_place();
    for (std::size_t part = 0; part < parts_.size(); ++part) {
        doubt(part);
        PartMotion& best = parts_[part].best;
        best.rest = support_.rest(part, best);
        if (!best.is_identity() && support_.is_another_object(part, best)) {
            best = PartMotion{.guessed = true};
            parts_[part].best_support = parts_[part].staying;
            parts_[part].rival.reset();
        }
        if (is_unexplained(part)) (lies_as_before(part) ? best.guessed : best.lost) = true;
    }
    doubt_rows();
    find_flipped();
    PartMotions motions;
    for (const Part& part : parts_)
        motions.first.push_back(part.best);
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (parts_[i].unclear) motions.unclear_objects.insert(stored_.parts[i].object);
    const auto is_asked = [](const Part& part) { return part.best.guessed && !part.best.lost && part.rival; };
    for (std::size_t i = 0; i < parts_.size() && std::ranges::any_of(parts_, is_asked); ++i) {
        motions.second.push_back(parts_[i].best);
        if (!is_asked(parts_[i])) continue;
        PartMotion& second = motions.second.back() = *parts_[i].rival;
        second.guessed = true;
        second.rest = support_.rest(i, second);
        second.flipped = parts_[i].best.flipped;
    }
    return motions;
}

// A part of which each face has one at its back looks as if nothing had happened. It did what most others
// did.
void MotionFinder::find_flipped() {
    using Looks = PartSupport::Looks;
    std::vector<std::size_t> unclear;
    std::size_t flipped = 0, others = 0;  // painted faces
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const Looks looks = support_.looks(i, parts_[i].best);
        parts_[i].best.flipped = looks == Looks::back;
        if (looks == Looks::both)
            unclear.push_back(i);
        else
            (looks == Looks::back ? flipped : others) += painted_[i];
    }
    for (const std::size_t i : unclear) {
        PartMotion& best = parts_[i].best;
        PartMotion back = best;
        back.flipped = true;
        const bool most = flipped > others;
        best.guessed = best.guessed || (most && types_.differ(i, best, back));
        best.flipped = most;
    }
}

void MotionFinder::find(std::size_t i) {
    Part& part = parts_[i];
    part.best_support = part.staying;
    if (of_vertices_[i]) {
        part.best = *of_vertices_[i];
        part.best_support = support_.support(i, part.best, 0.0);
        known_.push_back(part.best);
        return;
    }
    if (support_.points(i).size() < 3) return;
    if (part.staying.corners >= in_place) return;
    part.searched = true;
    try_known(i);
    try_boxes(i);
    // Of what is still there in part, equal tiles elsewhere say nothing.
    if (part.staying.corners < lost_below) try_corners(i);
    if (!part.best.is_identity()) known_.push_back(part.best);
}

void MotionFinder::consider(std::size_t i, const PartMotion& motion) {
    Part& part = parts_[i];
    ++guesses_;
    const MotionSupport found = support_.support(i, motion, enough_anchors);
    if (found.corners < enough_anchors || found.sum() < part.best_support.sum() - vote_slack) return;
    // What explains all needs to explain only a little more than staying does.
    const double more = found.sum() - part.staying.sum();
    const bool whole = found.sum() > 2.0 - 1e-9;
    if (more <= (whole ? 1e-9 : clearly_more) || !support_.fills_box(i, motion)) return;
    if (found.corners < part.staying.corners + clearly_more_rim) return;
    if (!whole && part.staying.corners >= 0.5 && support_.stays_inside(i, motion)) return;
    if (support_.is_taken(i, motion)) return;
    add_candidate(i, motion);
    const PaintPart& old = stored_.parts[i];
    const double cost = effort(motion, old.box.centre(), old.box.size().norm());
    // Deleted faces make one of a symmetric part's motions fit a little better by chance, so the effort
    // counts more than a little.
    const double rating = found.sum() - 0.1 * std::min(cost, 2.0);
    if (!part.best.is_identity() && rating <= part.best_rating) return;
    part.best = motion;
    part.best_support = found;
    part.best_rating = rating;
}

void MotionFinder::try_known(std::size_t i) {
    for (std::size_t k = 0; k < known_.size() && k < 64 && guesses_ < max_guesses; ++k)
        consider(i, known_[k]);
}

// The part's box became the box of a part with as many faces, or of the same shape; or the whole level's
// box became the mesh's.
void MotionFinder::try_boxes(std::size_t i) {
    const PaintPart& old = stored_.parts[i];
    if (!stored_.bounds.empty() && !mesh_.bounds.empty()) try_box(i, stored_.bounds, mesh_.bounds);
    const auto sorted_size = [](const Aabb& box) {
        Vec3 size = box.size();
        std::sort(size.data(), size.data() + 3);
        return size;
    };
    const Vec3 size = sorted_size(old.box);
    std::size_t tried = 0;
    for (const PaintPart& part : support_.all().parts) {
        if (part.faces != old.faces && !(sorted_size(part.box) - size).isZero(1e-4 * size.z())) continue;
        if (++tried > 100 || guesses_ > max_guesses) break;
        try_box(i, old.box, part.box);
    }
}

void MotionFinder::try_box(std::size_t i, const Aabb& from, const Aabb& to) {
    for (const PartMotion& motion : box_motions(from, to))
        consider(i, motion);
}

// Three corners of an anchor became three of the same shape, turned, mirrored and scaled: first those that
// are rare.
void MotionFinder::try_corners(std::size_t i) {
    constexpr std::size_t max_used = 4;
    struct Three {
        ThreeCorners corners;
        std::size_t places;
    };
    std::vector<Three> threes;
    for (const AnchorFace& face : stored_.parts[i].anchors) {
        for (std::size_t c = 0; c < face.size(); ++c) {
            const auto at = [&](std::size_t k) { return face[(c + k) % face.size()].cast<double>().eval(); };
            const ThreeCorners corners{at(0), at(1), at(2)};
            if (const std::size_t places = similar_.count(corners); places > 0)
                threes.push_back({corners, places});
        }
    }
    std::stable_sort(threes.begin(), threes.end(),
                     [](const Three& a, const Three& b) { return a.places < b.places; });
    const std::size_t begin = guesses_;
    for (std::size_t used = 0; used < threes.size() && used < max_used; ++used) {
        const ThreeCorners& from = threes[used].corners;
        for (const ThreeCorners& to : similar_.of(from, max_places)) {
            if (guesses_ - begin > max_guesses_per_part || guesses_ > max_guesses) return;
            for (const PartMotion& motion : SimilarCorners::motions(from, to))
                refine_and_consider(i, motion);
        }
        if (parts_[i].best_support.sum() > 1.9 && !parts_[i].best.is_identity()) break;
    }
}

// A motion from one small face is not exact far from it: it is fitted again to all corners that it nearly
// hits.
void MotionFinder::refine_and_consider(std::size_t i, const PartMotion& rough) {
    ++guesses_;
    std::vector<Vec3> from, to;
    if (!near_vertices(i, rough, from, to) || from.size() < 3) return;
    const Eigen::Matrix3Xd old_points = columns(from);
    const bool flat = (stored_.parts[i].box.size().minCoeff() <= 0.0);
    consider(i, rough);
    // A flat part's reflection is lost in a fit, so it is put back after it.
    if (const std::optional<PartMotion> fitted =
            fit_similarity(old_points, columns(to), rough.linear.determinant() < 0.0);
        fitted && !flat)
        consider(i, *fitted);
    if (flat) {
        if (const std::optional<PartMotion> fitted = fit_similarity(old_points, columns(to), false))
            consider(i, *fitted);
    }
}

bool MotionFinder::same(const Aabb& box, const PartMotion& a, const PartMotion& b) {
    const double size = 1e-4 * (box.size().norm() + 1.0);
    return (a(box.min) - b(box.min)).norm() < size && (a(box.max) - b(box.max)).norm() < size &&
           (a(box.centre()) - b(box.centre())).norm() < size &&
           (a.linear - b.linear).norm() < 1e-3 * (a.linear.norm() + b.linear.norm());
}

void MotionFinder::add_candidate(std::size_t i, const PartMotion& motion) {
    constexpr std::size_t max_of_part = 100;
    if (i != candidates_part_) candidates_of_part_ = 0;
    candidates_part_ = i;
    if (candidates_.size() == max_candidates || candidates_of_part_ == max_of_part) return;
    for (const PartMotion& known : candidates_)
        if (same(stored_.parts[i].box, known, motion)) return;
    candidates_.push_back(motion);
    ++candidates_of_part_;
}

// `rough`, which was fitted to a part far away and is less exact here, fitted to this part. Nothing if it
// does not put the part's corners near vertices.
std::optional<PartMotion> MotionFinder::refitted(std::size_t i, const PartMotion& rough) const {
    std::vector<Vec3> from, to;
    if (!near_vertices(i, rough, from, to) || from.size() < 4) return std::nullopt;
    return fit_affine(columns(from), columns(to), rough.linear.determinant() < 0.0);
}

// The part's corners that are near vertices after the motion; false if too few are.
bool MotionFinder::near_vertices(std::size_t i, const PartMotion& rough, std::vector<Vec3>& from,
                                 std::vector<Vec3>& to) const {
    const std::vector<Vec3>& points = support_.points(i);
    const auto allowed =
        static_cast<std::size_t>((1.0 - enough_anchors) * static_cast<double>(points.size()));
    std::size_t misses = 0;
    for (const Vec3& point : points) {
        const std::uint32_t vertex = support_.nearest(rough(point), support_.widest());
        if (vertex == no_id) {
            if (++misses > allowed) return false;
            continue;
        }
        from.push_back(point);
        to.push_back(mesh_.positions[vertex].cast<double>());
    }
    return true;
}

}  // namespace slipface
