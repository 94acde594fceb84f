// What the order of a part's faces says about its motion.
#include <algorithm>
#include <cmath>

#include "motion_finder.h"
#include "motion_fit.h"

namespace slipface {

// How much of the order of the part's faces is kept, 1 if all are where they were in it; and as much again
// for its vertices, of which no wrong motion keeps the order by chance.
double MotionFinder::order(std::size_t i, const PartMotion& motion) {
    const double faces = std::max(support_.ranks_kept(i, motion), 0.9 * support_.order_kept(i, motion));
    const std::optional<double> vertices = support_.vertex_order_kept(i, motion);
    return faces + (vertices && *vertices >= vertices_in_order ? *vertices : 0.0);
}

double MotionFinder::ranks(std::size_t i, const PartMotion& motion) {
    return has_order_ ? order(i, motion) : 0.0;
}

// Whether the parts that stayed have their faces or vertices in the old order. If not, a tool has sorted
// them, and the order says nothing about the others.
bool MotionFinder::keeps_order() {
    double kept = 0.0, all = 0.0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (parts_[i].staying.corners < in_place) continue;
        const auto anchors = static_cast<double>(stored_.parts[i].anchors.size());
        kept += std::min(ranks(i, PartMotion{}), 1.0) * anchors;
        all += anchors;
    }
    return kept >= 0.75 * all;
}

// True if the motion puts the part's box onto itself; a layer close to a flat part is another place. Not a
// reflection in a diagonal, which is what sorting along another axis looks like.
bool MotionFinder::turns_in_place(std::size_t i, const PartMotion& motion) const {
    const Eigen::Matrix3d turn = motion.linear.array().round();
    const bool quarter = turn.determinant() > 0.0 && turn.trace() == 1.0;
    const Vec3 centre = stored_.parts[i].box.centre();
    return support_.hits(motion, centre, centre) && turn.isUnitary() && motion.linear.isApprox(turn, 1e-4) &&
           (turn.isDiagonal() || quarter) && !turn.isIdentity();
}

// A symmetric part that was turned or mirrored in its own place looks as if nothing had happened, but its
// faces come in another order. A tool that sorts faces has the same effect, so this is a guess.
void MotionFinder::try_order(std::size_t i) {
    Part& part = parts_[i];
    if (stored_.parts[i].anchors.size() < 4) return;
    const bool unclear = part.staying.sum() > 2.0 - 1e-9;  // else faces have other materials, or are gone
    const bool in_order = support_.order_kept(i, PartMotion{}) >= 1.0;
    ++(in_order ? in_order_ : out_of_order_);
    if (in_order && unclear) return;
    for (const PartMotion& motion : rank_motions(i)) {
        if (!turns_in_place(i, motion) || support_.support(i, motion, 1.0 - 1e-9).sum() < 2.0 - 1e-9 ||
            support_.ranks_kept(i, motion) < 1.0 - 1e-9)
            continue;
        part.best = motion;
        part.best.guessed = unclear;
        if (unclear) part.rival = PartMotion{};
        if (!in_order) --out_of_order_;
        return;
    }
}

// Where other parts are out of order too, a tool sorted the faces. The few faces of a box can come into
// the order of a turned one by chance.
void MotionFinder::trust_order() {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        Part& part = parts_[i];
        if (!part.best.guessed || part.certain) continue;
        const bool few = stored_.parts[i].anchors.size() < few_anchors;
        if (out_of_order_ == 0 && !(few && in_order_ == 0)) continue;
        part.turned = part.rival = part.best;
        part.best = PartMotion{};
    }
}

// A symmetric level that a tool turned or mirrored, and whose faces and vertices it sorted, looks as if it
// had stayed. How it did, if types would then be others.
std::optional<PartMotion> MotionFinder::motion_of_symmetric_level() {
    double faces = 0.0, vertices = 0.0, all = 0.0;  // of the anchors: in their order
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (support_.points(i).empty()) continue;
        if (!parts_[i].best.is_identity() || parts_[i].certain || parts_[i].staying.sum() < 2.0 - 1e-9)
            return std::nullopt;
        const auto anchors = static_cast<double>(stored_.parts[i].anchors.size());
        faces += support_.order_kept(i, PartMotion{}) * anchors;
        vertices += support_.vertex_order_kept(i, PartMotion{}).value_or(0.0) * anchors;
        all += anchors;
    }
    if (faces > in_place * all || vertices > vertices_in_order * all) return std::nullopt;
    const std::vector<PartMotion> motions = box_motions(stored_.bounds, stored_.bounds);
    const auto found = std::find_if(motions.begin(), motions.end(), [&](const PartMotion& motion) {
        if (motion.is_identity() || !is_rigid(motion)) return false;
        for (std::size_t i = 0; i < parts_.size(); ++i)
            if (!support_.points(i).empty() && support_.support(i, motion, 1.0 - 1e-9).sum() < 2.0 - 1e-9)
                return false;
        return types_.all_differ(PartMotion{}, motion);
    });
    return found == motions.end() ? std::nullopt : std::optional(*found);
}

std::vector<PartMotion> MotionFinder::rank_motions(std::size_t i) {
    std::vector<PartMotion> motions;
    const PaintPart& old = stored_.parts[i];
    const MeshParts& all_parts = support_.all();
    const auto count = static_cast<Eigen::Index>(old.anchors.size());
    Eigen::Matrix3Xd from(3, count), to(3, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const AnchorFace& anchor = old.anchors[static_cast<std::size_t>(k)];
        from.col(k).setZero();
        for (const Vec3f& corner : anchor.corners)
            from.col(k) += corner.cast<double>() / static_cast<double>(anchor.corners.size());
    }
    std::size_t tried = 0;
    for (std::size_t part = 0; part < all_parts.parts.size() && tried < 100; ++part) {
        if (all_parts.parts[part].faces != old.faces || guesses_ > max_guesses) continue;
        ++tried;
        bool fits = count >= 3;
        for (Eigen::Index k = 0; k < count && fits; ++k) {
            const AnchorFace& anchor = old.anchors[static_cast<std::size_t>(k)];
            fits = anchor.rank < old.faces;
            if (!fits) break;
            const FaceId face = all_parts.sorted[all_parts.first[part] + anchor.rank];
            fits = mesh_.face_corner_count(face) == anchor.corners.size();
            to.col(k) = index_.key(face).centroid;
        }
        if (!fits) continue;
        for (const bool mirrored : {false, true})
            if (const std::optional<PartMotion> motion = fit_affine(from, to, mirrored))
                motions.push_back(*motion);
    }
    return motions;
}

}  // namespace slipface
