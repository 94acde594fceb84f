// What each part did, of all motions that are possible for it.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "motion_finder.h"
#include "motion_fit.h"
#include "slipface/level/material_name.h"

namespace slipface {

// Equal crates can go to each other's new places, and symmetric parts can turn: what explains most parts is
// theirs, and parts of which only one motion is possible decide for the others. To stay is a motion, too; a
// part that may have stayed did, unless there is none that must have.
void MotionFinder::choose() {
    moves_.assign(1, {PartMotion{}});
    for (const Part& part : parts_)
        if (!part.best.is_identity() && moves_.size() < max_guesses &&
            std::none_of(moves_.begin(), moves_.end(),
                         [&](const Move& known) { return same(stored_.bounds, known.motion, part.best); }))
            moves_.push_back({part.best});
    for (const PartMotion& motion : candidates_)
        moves_.push_back({motion});
    if (!stored_.tokens.empty())  // in an older file nobody knows whether a symmetric level was sorted
        for (const PartMotion& motion : box_motions(stored_.bounds, stored_.bounds))
            if (!motion.is_identity() && is_rigid(motion)) moves_.push_back({motion});
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (!support_.points(i).empty()) find_readings(i);
    const auto count = [&] {
        for (Move& move : moves_)
            move.parts = move.only = 0;
        for (const Part& part : parts_)
            for (const Reading& reading : part.readings) {
                ++moves_[reading.move].parts;
                moves_[reading.move].only += part.readings.size() == 1 ? 1 : 0;
            }
    };
    count();
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (!support_.points(i).empty()) add_shared_readings(i);
    count();
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (!parts_[i].readings.empty()) choose(i);
}

// All that explain nearly as much as the best one, or all that explain as much as staying does.
void MotionFinder::find_readings(std::size_t i) {
    Part& part = parts_[i];
    const bool stays = part.best.is_identity();
    if (of_vertices_[i]) {
        const auto made = std::ranges::find_if(
            moves_, [&](const Move& move) { return same(stored_.parts[i].box, move.motion, part.best); });
        const auto move = static_cast<std::size_t>(made - moves_.begin());
        part.readings.push_back({made == moves_.end() ? 0 : move, part.best, part.best_support});
        return;
    }
    if (stays && part.staying.corners >= lost_below) part.readings.push_back({0, PartMotion{}, part.staying});
    if (stays && part.searched) return;
    for (std::size_t k = 1; k < moves_.size() && votes_ < max_guesses; ++k) {
        ++votes_;
        MotionSupport found;
        const auto allowed = [&](const PartMotion& motion) {
            found = support_.support(i, motion, enough_anchors);
            if (stays) return found.sum() >= part.staying.sum() - 1e-9;
            // What puts every corner in its place may miss faces: they were extruded or deleted.
            const bool fits =
                found.sum() >= part.best_support.sum() - vote_slack || found.corners > 1.0 - 1e-9;
            return found.corners >= enough_anchors && fits && !support_.is_taken(i, motion) &&
                   support_.fills_box(i, motion);
        };
        std::optional<PartMotion> motion = moves_[k].motion;
        if (!allowed(*motion)) motion = stays ? std::nullopt : refitted(i, moves_[k].motion);
        if (motion && (stays || allowed(*motion))) part.readings.push_back({k, *motion, found});
    }
}

// Of a part that an edit damaged, a motion that others made explains less.
void MotionFinder::add_shared_readings(std::size_t i) {
    Part& part = parts_[i];
    if (part.best.is_identity() || part.best_support.sum() > 2.0 - 1e-9) return;
    for (std::size_t k = 1; k < moves_.size(); ++k) {
        if (moves_[k].parts <= few_parts ||
            std::any_of(part.readings.begin(), part.readings.end(),
                        [&](const Reading& known) { return known.move == k; }))
            continue;
        const PartMotion& motion = moves_[k].motion;
        const MotionSupport found = support_.support(i, motion, lost_below);
        if (found.corners >= lost_below && found.sum() >= part.best_support.sum() - vote_slack &&
            !support_.is_taken(i, motion) && support_.becomes_box(i, motion, box_slack))
            part.readings.push_back({k, motion, found});
    }
}

void MotionFinder::choose(std::size_t i) {
    Part& part = parts_[i];
    const Aabb& box = stored_.parts[i].box;
    if (of_vertices_[i]) {
        // Of what may have turned onto itself, the vertices may have been sorted instead.
        if (part.staying.sum() > 2.0 - 1e-9 &&
            (part.best(box.centre()) - box.centre()).norm() <= box_slack * box.size().norm() &&
            types_.differ(i, PartMotion{}, part.best))
            part.rival = PartMotion{};
        return;
    }
    const auto likelier = [&](const Reading& a, const Reading& b) {
        const auto rank = [&](const Reading& reading) {
            const Move& move = moves_[reading.move];
            const bool stays = reading.move == 0 && move.only > 0;
            return std::tuple(stays, move.only > few_parts, move.parts,
                              -effort(move.motion, stored_.bounds.centre(), stored_.bounds.size().norm()));
        };
        return rank(a) > rank(b);
    };
    std::stable_sort(part.readings.begin(), part.readings.end(), likelier);
    const Reading& best = part.readings.front();
    const Move& move = moves_[best.move];
    part.shared = move.parts - 1;
    part.best = best.exact;
    part.best_support = best.support;
    // A part that is still there, damaged, and also looks like another one, has not become that one. But if
    // nothing of it is there, and all of it elsewhere in its size, the one in its place is only similar.
    const bool whole = best.support.sum() > 2.0 - 1e-9 && is_rigid(best.exact);
    if (part.shared == 0 && !(whole && part.staying.corners < lost_below) &&
        (part.best(box.centre()) - box.centre()).norm() > box_slack * box.size().norm() &&
        support_.has_similar_box(i)) {
        part.best = PartMotion{};
        part.best_support = part.staying;
        return;
    }
    const bool sure = move.only > few_parts || (best.move == 0 && move.only > 0);
    for (const Reading& other : part.readings) {
        const Move& rival = moves_[other.move];
        if (&other == &best || (sure && rival.only == 0) ||
            (part.searched && part.shared > 0 && rival.parts < move.parts) ||
            other.support.sum() < best.support.sum() - as_much || !types_.differ(i, best.exact, other.exact))
            continue;
        part.rival = other.exact;
        part.unclear = !part.searched && (best.move != 0 || rival.only > 0);
        break;
    }
    // What only this part did is a question if what others did explains some of it, too.
    part.best.guessed =
        part.shared == 0 && best.move != 0 &&
        std::any_of(moves_.begin() + 1, moves_.end(), [&](const Move& other) {
            return other.parts > 1 && support_.support(i, other.motion, lost_below).corners >= lost_below;
        });
}

// Whether another part is where the motion puts this one, by a motion of its own. Parts that lay on each
// other may stay so.
bool MotionFinder::is_claimed(std::size_t i, const PartMotion& motion) const {
    const Aabb box = support_.moved_box(i, motion);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        if (k == i || places_[k].empty() || same(stored_.parts[i].box, parts_[k].best, motion)) continue;
        if (similar_box(places_[k], box, box_slack) &&
            !similar_box(stored_.parts[k].box, stored_.parts[i].box, box_slack))
            return true;
    }
    return false;
}

// Of parts that look as if they had all moved to one place, the one did whose motion is others', too, or that
// did the least. The others were edited.
void MotionFinder::one_part_each_place() {
    places_.resize(parts_.size());
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const Part& part = parts_[i];
        if (part.best.is_identity()) continue;
        places_[i] = support_.moved_box(i, part.best);
        if (of_vertices_[i]) continue;
        const Aabb& box = stored_.parts[i].box;
        order.push_back({10.0 * static_cast<double>(part.shared) + part.best_support.sum() -
                             0.1 * std::min(effort(part.best, box.centre(), box.size().norm()), 2.0),
                         i});
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [rating, i] : order) {
        Part& part = parts_[i];
        if (!is_claimed(i, part.best)) continue;
        part.best = PartMotion{};
        part.best_support = part.staying;
        part.best_rating = 0.0;
        part.rival.reset();
        places_[i] = Aabb{};
    }
}

// Of equal parts in a row, of which one place was left and another one taken, all between may have moved on.
void MotionFinder::doubt_rows() {
    constexpr std::size_t max_pairs = 256;
    const std::vector<PaintPart>&now = support_.all().parts, &old = stored_.parts;
    const auto alike = [](const PaintPart& a, const PaintPart& b) {
        return a.faces == b.faces && (a.box.size() - b.box.size()).norm() <= 1e-3 * a.box.size().norm();
    };
    const auto is_in = [&](const std::vector<PaintPart>& parts, const PaintPart& one) {
        return std::any_of(parts.begin(), parts.end(), [&](const PaintPart& part) {
            return alike(part, one) && similar_box(part.box, one.box, 1e-3);
        });
    };
    std::vector<const PaintPart*> left, taken;
    for (const PaintPart& part : old)
        if (!is_in(now, part)) left.push_back(&part);
    for (const PaintPart& part : now)
        if (!left.empty() && !is_in(old, part)) taken.push_back(&part);
    std::size_t pairs = 0;
    for (const PaintPart* from : left)
        for (const PaintPart* to : taken) {
            if (!alike(*from, *to) || ++pairs > max_pairs) continue;
            const Vec3 way = to->box.centre() - from->box.centre();
            const double slack = box_slack * from->box.size().norm();
            for (std::size_t i = 0; i < parts_.size(); ++i) {
                if (of_vertices_[i] || support_.points(i).empty() || !alike(old[i], *from)) continue;
                const Vec3 off = old[i].box.centre() - from->box.centre();
                const double along = off.dot(way) / way.squaredNorm();
                if (along > 0.0 && along < 1.0 && (off - along * way).norm() <= slack)
                    parts_[i].best.guessed =
                        parts_[static_cast<std::size_t>(from - old.data())].best.guessed = true;
            }
        }
}

bool MotionFinder::is_unexplained(std::size_t i) {
    const Part& part = parts_[i];
    return !support_.points(i).empty() && part.best.is_identity() && part.best_support.corners < lost_below &&
           part.best_support.keys < lost_below && !support_.has_similar_box(i);
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

// Whether the motion of the part is a question: it explains little, or others explain as much and give faces
// other types. A motion of which both is true, or that explains hardly anything, is none.
void MotionFinder::doubt(std::size_t i) {
    constexpr double little = 1.5, hardly = 0.9, few_faces = 0.3;
    constexpr double more_effort = 0.5;  // than of a part that was only moved, which is the likeliest
    Part& part = parts_[i];
    if (support_.points(i).size() < 3) return;
    const bool stays = part.best.is_identity();
    const Aabb& box = stored_.parts[i].box;
    if (stays ? part.searched && part.best_support.keys < few_faces : part.best_support.sum() < little)
        part.best.guessed = true;
    const bool turned = effort(part.best, box.centre(), box.size().norm()) > more_effort;
    part.best.lost = !stays && !of_vertices_[i] && part.best.guessed &&
                     ((part.rival && turned) || part.best_support.sum() < hardly);
    part.best.guessed = part.best.guessed || part.rival;
}

}  // namespace slipface
