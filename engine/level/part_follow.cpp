// Parts that move with the others of their object, though an edit left little of them.
#include <algorithm>
#include <map>
#include <string>

#include "motion_finder.h"
#include "motion_fit.h"
#include "slipface/level/material_name.h"

namespace slipface {
namespace {

constexpr double enough_of_edited = 0.25;  // anchor corners of a part that an edit changed, too
constexpr std::size_t others = 2;          // parts with a motion that say what the rest did

}  // namespace

// What the parts did, those of most parts first. To stay is a motion, too.
void MotionFinder::collect_moves() {
    constexpr std::size_t max_moves = 64;
    moves_.clear();
    for (const Part& part : parts_) {
        if (!is_explained(part) || moves_.size() == max_moves) continue;
        if (std::none_of(moves_.begin(), moves_.end(),
                         [&](const Move& known) { return same(stored_.bounds, known.motion, part.best); }))
            moves_.push_back({part.best});
    }
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (is_explained(parts_[i]))
            for (Move& move : moves_) {
                if (!same(stored_.parts[i].box, move.motion, parts_[i].best)) continue;
                ++move.parts;
            }
    std::stable_sort(moves_.begin(), moves_.end(),
                     [](const Move& a, const Move& b) { return a.parts > b.parts; });
}

// Whether all parts made the motion, or could have.
bool MotionFinder::is_of_all(const PartMotion& motion) {
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (!support_.points(i).empty() && !same(stored_.parts[i].box, motion, parts_[i].best) &&
            support_.support(i, motion, enough_anchors).sum() < parts_[i].best_support.sum() - 1e-9)
            return false;
    return true;
}

// The number of parts that made the part's motion.
std::size_t MotionFinder::parts_with_motion(std::size_t i) const {
    for (const Move& move : moves_)
        if (same(stored_.parts[i].box, move.motion, parts_[i].best)) return move.parts;
    return 1;
}

// A damaged part also looks like another one, turned, which is whole. If the motion of most parts explains it
// nearly as well, that is its own.
void MotionFinder::yield_to_most(std::size_t i) {
    Part& part = parts_[i];
    if (part.best.is_identity() || part.best_support.sum() > 2.0 - 1e-9) return;
    const std::size_t own = parts_with_motion(i);
    for (const Move& move : moves_) {
        if (move.parts <= std::max(own, others)) return;
        if (move.motion.is_identity()) continue;
        const MotionSupport found = support_.support(i, move.motion, enough_of_edited);
        if (found.corners < enough_of_edited || found.sum() < part.best_support.sum() - vote_slack ||
            support_.is_taken(i, move.motion) || !support_.becomes_box(i, move.motion, box_slack))
            continue;
        part.best = move.motion;
        part.best_support = found;
        part.voted = true;
        return;
    }
}

// What most parts did of which that is known, the others did that it explains entirely, though they look like
// another part, too, or rounding joined them to their neighbours.
void MotionFinder::follow_level() {
    std::size_t explained = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i)
        explained += !support_.points(i).empty() && is_explained(parts_[i]) ? 1 : 0;
    if (moves_.empty() || moves_[0].motion.is_identity() ||
        moves_[0].parts <= std::max(few_parts, explained / 2))
        return;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        Part& part = parts_[i];
        if (support_.points(i).empty() || part.staying.corners >= 0.5 ||
            same(stored_.parts[i].box, moves_[0].motion, part.best))
            continue;
        PartMotion motion = moves_[0].motion;
        MotionSupport found = support_.support(i, motion, 1.0 - 1e-9);
        if (const std::optional<PartMotion> fitted = refitted(i, motion)) {
            // Of a few corners that rounding moved a fit can be worse.
            const MotionSupport better = support_.support(i, *fitted, 1.0 - 1e-9);
            if (better.sum() >= found.sum()) {
                motion = *fitted;
                found = better;
            }
        }
        if (found.sum() < 2.0 - 1e-9) continue;
        const bool own = !part.best.is_identity() && part.best_support.sum() > 2.0 - 1e-9;
        const bool unclear = own && types_.differ(i, part.best, motion);
        part.best = motion;
        part.best.guessed = unclear;
        part.best_support = found;
        part.voted = true;
    }
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
        const Aabb& box = stored_.parts[i].box;
        const auto shared = static_cast<double>(parts_with_motion(i) - 1);
        order.push_back({10.0 * shared + part.best_support.sum() -
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
        part.voted = false;
        places_[i] = Aabb{};
    }
}

}  // namespace slipface
