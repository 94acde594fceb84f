// The motions of the parts together.
#include <algorithm>
#include <cmath>
#include <set>

#include "motion_finder.h"
#include "motion_fit.h"
#include "slipface/level/material_name.h"

namespace slipface {
// Equal crates can go to each other's new places, and symmetric parts can turn. The motion that explains
// the most parts is theirs, then the one that explains the most of the others.
void MotionFinder::vote() {
    struct Voter {
        std::size_t part;
        std::vector<std::size_t> motions;
        std::vector<PartMotion> exact;  // of `motions`, as they are for this part
    };
    std::vector<Voter> voters;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (!parts_[i].searched || parts_[i].best.is_identity()) continue;
        Voter voter{i, {}, {}};
        for (std::size_t k = 0; k < candidates_.size() && votes_ < max_guesses; ++k) {
            ++votes_;
            const auto allowed = [&](const PartMotion& motion) {
                const MotionSupport found = support_.support(i, motion, enough_anchors);
                // What puts every corner in its place may miss faces: they were extruded or deleted.
                const bool fits =
                    found.sum() >= parts_[i].best_support.sum() - vote_slack || found.corners > 1.0 - 1e-9;
                return found.corners >= enough_anchors && fits && !support_.is_taken(i, motion) &&
                       support_.fills_box(i, motion);
            };
            std::optional<PartMotion> motion = candidates_[k];
            if (!allowed(*motion)) motion = refitted(i, candidates_[k]);
            if (!motion || !allowed(*motion)) continue;
            voter.motions.push_back(k);
            voter.exact.push_back(*motion);
        }
        voters.push_back(std::move(voter));
    }
    while (!voters.empty()) {
        std::vector<std::size_t> votes(candidates_.size(), 0);
        for (const Voter& voter : voters)
            for (const std::size_t k : voter.motions)
                ++votes[k];
        std::size_t most = no_id;
        // Of motions of as many parts the one that does less.
        const auto rating = [&](std::size_t k) {
            return -effort(candidates_[k], stored_.bounds.centre(), stored_.bounds.size().norm());
        };
        double best = 0.0;
        for (std::size_t k = 0; k < votes.size(); ++k) {
            if (votes[k] < 2 || (most != no_id && votes[k] < votes[most])) continue;
            const double own = rating(k);
            if (most != no_id && votes[k] == votes[most] && own <= best) continue;
            most = k;
            best = own;
        }
        if (most == no_id) break;
        std::erase_if(voters, [&](const Voter& voter) {
            const auto own = std::find(voter.motions.begin(), voter.motions.end(), most);
            if (own == voter.motions.end()) return false;
            Part& part = parts_[voter.part];
            part.best = voter.exact[static_cast<std::size_t>(own - voter.motions.begin())];
            part.best_support = support_.support(voter.part, part.best, enough_anchors);
            part.voted = true;
            return true;
        });
    }
    // A part that is still there, damaged, and also looks like another one, has not become that one. But if
    // nothing of it is there, and all of it elsewhere in its size, the one in its place is only similar.
    for (const Voter& voter : voters) {
        Part& part = parts_[voter.part];
        const Aabb& box = stored_.parts[voter.part].box;
        const double moved = (part.best(box.centre()) - box.centre()).norm();
        const bool whole = part.best_support.sum() > 2.0 - 1e-9 && is_rigid(part.best);
        if (whole && part.staying.corners < lost_below) continue;
        if (moved <= box_slack * box.size().norm() || !support_.has_similar_box(voter.part)) continue;
        part.best = PartMotion{};
        part.best_support = part.staying;
    }
}

bool MotionFinder::is_unexplained(std::size_t i) {
    const Part& part = parts_[i];
    return !support_.points(i).empty() && !part.voted && part.best.is_identity() &&
           part.best_support.corners < lost_below && part.best_support.keys < lost_below &&
           !support_.has_similar_box(i);
}

// Whether most of the part's painted faces, or of their area, have faces of their material a little off their
// place, or half of them exactly in their planes, in directions that leave no way to slide: all corners moved
// a little, or all edges were bevelled, which turns narrow faces over. A floor that was moved by a tile has,
// too, but can slide.
bool MotionFinder::lies_as_before(std::size_t i) {
    constexpr double most = 0.75, most_in_plane = 0.5;    // of the faces or the area
    constexpr double a_little = 0.12, can_slide = 0.005;  // `a_little`: of a face's size
    const CollisionWorld* const tree = lookup_.tree();
    if (tree == nullptr || is_claimed(i, PartMotion{})) return false;
    double found = 0.0, faces = 0.0, in_plane_area = 0.0, in_plane_faces = 0.0, all = 0.0;
    Eigen::Matrix3d by_area = Eigen::Matrix3d::Zero(), by_face = by_area;  // directions
    for (const FaceKey* key : support_.keys(i)) {
        const double reach = a_little * std::sqrt(key->area) + position_tolerance(key->centroid);
        Aabb box;
        box.add(key->centroid - Vec3::Constant(reach));
        box.add(key->centroid + Vec3::Constant(reach));
        const std::string base = base_material(key->material, surfaces_);
        all += key->area;
        for (const TriangleId triangle : tree->triangles_in(box)) {
            ++lookup_.visits;
            const FaceId face = tree->triangle_face(triangle);
            const FaceKey& there = index_.key(face);
            const double along = there.normal.dot(key->normal);
            const bool in_its_plane =
                std::abs(along) > 0.9995 &&
                std::abs(there.normal.dot(there.centroid - key->centroid)) <= in_plane(*key);
            if (!(along > 0.9 || in_its_plane) || index_.base(face) != base ||
                support_.differ(i, support_.all().of[face]) ||
                !index_.covers(face, key->centroid, key->normal))
                continue;
            found += key->area;
            faces += 1.0;
            in_plane_area += in_its_plane ? key->area : 0.0;
            in_plane_faces += in_its_plane ? 1.0 : 0.0;
            by_area += key->area * there.normal * there.normal.transpose();
            by_face += there.normal * there.normal.transpose();
            break;
        }
    }
    const auto painted = static_cast<double>(support_.keys(i).size());
    const bool enough = found > most * all || faces >= most * painted;
    const bool enough_in_plane =
        in_plane_area > most_in_plane * all || in_plane_faces > most_in_plane * painted;
    if (faces == 0.0 || !(enough || enough_in_plane)) return false;
    // The narrow sides of a board hold it, too.
    return std::max((by_area / found).determinant(), (by_face / faces).determinant()) > can_slide;
}

// Two equal parts that a motion of others put into each other's place look as if they had stayed. If all
// could have made it, they did; else that is a question.
void MotionFinder::exchange(std::size_t i) {
    Part& part = parts_[i];
    if (part.searched || !part.best.is_identity() || support_.points(i).size() < 3) return;
    for (const Move& move : moves_) {
        const PartMotion& motion = move.motion;
        if (motion.is_identity() || !types_.differ(i, PartMotion{}, motion)) continue;
        const MotionSupport found = support_.support(i, motion, enough_anchors);
        if (found.sum() < part.staying.sum() - 1e-9) continue;
        part.best.guessed = true;
        part.rival = motion;
        if (!move.of_all) continue;
        std::swap(part.best, *part.rival);
        part.best.guessed = true;
        part.best_support = found;
        part.voted = true;
        return;
    }
}

// A symmetric level that a tool turned or mirrored, and whose faces it sorted, looks as if it had stayed. How
// it did, if types would then be others.
std::optional<PartMotion> MotionFinder::motion_of_symmetric_level() {
    if (stored_.tokens.empty()) return std::nullopt;  // an older file: nobody knows whether they are sorted
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (!support_.points(i).empty() &&
            (!parts_[i].best.is_identity() || parts_[i].staying.sum() < 2.0 - 1e-9))
            return std::nullopt;
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

// Whether the motion of the part is a question: it explains little, or others explain as much and give faces
// other types. A motion of which both is true, or that explains hardly anything, is none.
void MotionFinder::doubt(std::size_t i) {
    constexpr double little = 1.5, hardly = 0.9, few_faces = 0.3;
    constexpr double more_effort = 0.5;  // than of a part that was only moved, which is the likeliest
    constexpr double as_much = 0.1;
    Part& part = parts_[i];
    if (support_.points(i).size() < 3) return;
    const bool stays = part.best.is_identity();
    if (stays && part.searched) part.best.guessed = part.best_support.keys < few_faces;
    if (!stays && part.best_support.sum() < little) part.best.guessed = true;
    if (part.voted || stays) return;
    const bool few = stored_.parts[i].anchors.size() < few_anchors;
    const Aabb& box = stored_.parts[i].box;
    const auto rival = std::find_if(part.others.begin(), part.others.end(), [&](const Rated& other) {
        return other.sum >= part.best_support.sum() - as_much && !same(box, other.motion, part.best) &&
               types_.differ(i, part.best, other.motion);
    });
    const bool unclear = rival != part.others.end();
    if (unclear) part.rival = rival->motion;
    // A few faces of which some were deleted also look like a whole piece elsewhere. What only they did is a
    // question if the motion of others explains some of them, too.
    const bool alone =
        few && parts_with_motion(i) < 2 && std::any_of(moves_.begin(), moves_.end(), [&](const Move& move) {
            return move.parts > 1 && !move.motion.is_identity() &&
                   support_.support(i, move.motion, lost_below).corners >= lost_below;
        });
    const bool turned = effort(part.best, box.centre(), box.size().norm()) > more_effort;
    part.best.lost =
        part.best.guessed && ((unclear && turned) || part.best_support.sum() < hardly);
    part.best.guessed = part.best.guessed || unclear || alone;
}

}  // namespace slipface
