#include "correspondence.h"

#include <algorithm>
#include <map>
#include <optional>

#include "face_match.h"
#include "motion_fit.h"
#include "slipface/base/hash.h"
#include "token_reading.h"

namespace slipface {
namespace {

// Less of what the order explains is no second reading.
constexpr double rival_score = 0.5;
// Of the faces of all objects, so that the order alone can say that a symmetric object turned.
constexpr double level_in_order = 0.9;
// Faces of an object that is known without its name, by how they are joined.
constexpr std::uint32_t enough_faces = 24;

// Equal objects in one plane that are compared with one that moved there.
constexpr std::size_t max_side_by_side = 1000;

// Motions that are compared with what a symmetric object may have done, faces that they are fitted to, and
// how near they put the object's faces, in its size: what a small object did is not known exactly far away.
constexpr std::size_t max_seen = 64, max_fitted = 256;
constexpr double near_enough = 0.01;

struct ObjectPair {
    std::uint32_t old, now;  // objects
    bool named;
    Reading order;
    Aabb went_to = {};                      // the box of its faces in the new geometry
    std::vector<std::uint32_t> rival = {};  // as Correspondence, of the object; or empty
    bool by_place_too = false;              // the places explain as much, but differently
    std::vector<bool> open = {};            // as Correspondence, of the object
};

bool almost_all(std::size_t faces, std::size_t of) {
    return static_cast<double>(faces) >= level_in_order * static_cast<double>(of);
}

std::uint64_t joints(const MeshTokens& tokens, const TokenObject& object) {
    Hasher hasher;
    hasher.u64(object.count);
    for (std::uint32_t i = object.first; i < object.first + object.count; ++i)
        hasher.u64(std::uint64_t{tokens.faces[i].topology} << 8 | tokens.faces[i].corners);
    return hasher.value();
}

// [key] the object that alone has it, or no_id.
template <class KeyOf>
std::map<std::uint64_t, std::uint32_t> only_ones(const MeshTokens& tokens, const KeyOf& key_of) {
    std::map<std::uint64_t, std::uint32_t> only;
    for (std::uint32_t i = 0; i < tokens.objects.size(); ++i)
        if (const auto [place, added] = only.try_emplace(key_of(i), i); !added) place->second = no_id;
    return only;
}

class Comparison {
  public:
    Comparison(const MeshTokens& old, const MeshTokens& now, std::span<const std::optional<Vec3>> went)
        : old_(old), now_(now), went_(went) {}

    Correspondence run() && {
        pair_objects();
        for (ObjectPair& pair : pairs_)
            read(pair);
        trust_shared_motions();
        doubt_exchanged_names();
        Correspondence result;
        result.before.assign(now_.faces.size(), no_id);
        result.rival.assign(now_.faces.size(), no_id);
        result.moved.assign(now_.faces.size(), false);
        result.open.assign(now_.faces.size(), false);
        const bool in_order = level_is_in_order();
        for (const ObjectPair& pair : pairs_)
            if (!pair.by_place_too || in_order) add(pair, result);
        return result;
    }

  private:
    void pair_objects() {
        const auto pair_by = [&](const auto& olds, const auto& nows, bool named) {
            for (const auto& [key, old] : olds) {
                const auto now = nows.find(key);
                if (old == no_id || now == nows.end() || now->second == no_id) continue;
                if (paired_old_[old] || paired_now_[now->second]) continue;
                paired_old_[old] = paired_now_[now->second] = true;
                pairs_.push_back({old, now->second, named, {}});
            }
        };
        paired_old_.resize(old_.objects.size());
        paired_now_.resize(now_.objects.size());
        pair_by(only_ones(old_, [&](std::uint32_t i) { return old_.objects[i].name; }),
                only_ones(now_, [&](std::uint32_t i) { return now_.objects[i].name; }), true);
        for (std::uint32_t i = 0; i < old_.objects.size(); ++i)
            joints_.push_back(joints(old_, old_.objects[i]));
        pair_by(only_ones(old_, [&](std::uint32_t i) { return joints_[i]; }),
                only_ones(now_, [&](std::uint32_t i) { return joints(now_, now_.objects[i]); }), false);
        std::sort(pairs_.begin(), pairs_.end(),
                  [](const ObjectPair& a, const ObjectPair& b) { return a.now < b.now; });
    }

    ObjectEdit edit_of(const ObjectPair& pair) const {
        const TokenObject &old = old_.objects[pair.old], &now = now_.objects[pair.now];
        return {std::span(old_.faces).subspan(old.first, old.count),
                std::span(now_.faces).subspan(now.first, now.count), old};
    }

    void read(ObjectPair& pair) {
        const ObjectEdit edit = edit_of(pair);
        pair.order = read_by_order(edit);
        Reading& order = pair.order;
        for (const FaceToken& face : edit.now)
            pair.went_to.add(face.position.cast<double>());
        const std::size_t fewer = std::min(edit.old.size(), edit.now.size());
        const bool all_stay = order.in_place == order.matched && order.matched == fewer;
        const Reading place = all_stay ? order : read_by_place(edit);
        if (!order.whole && !all_stay) {
            Reading kept = in_order(edit, place);
            if (kept.score > order.score && almost_all(kept.matched, fewer)) order = std::move(kept);
        }
        // Of three witnesses, order, place and vertices, the two that agree are right. What all moved, as the
        // vertices say, is searched for there if none of the others agrees.
        const Vertices vertices = all_stay ? Vertices{} : vertices_of(pair, edit, order);
        const bool kept = vertices.agree;
        if (vertices.stay && !kept && vertices_of(pair, edit, place).agree) order = place;
        const bool too_small = !pair.named && edit.old.size() < enough_faces;
        // A tool sorted the faces, or they are in that order by chance.
        const bool sorted =
            !almost_all(order.score, place.score) ||
            (!order.whole && !almost_all(order.matched, edit.now.size()) && place.in_place >= order.matched);
        if (!kept && (vertices.moved || (order.in_place < order.matched && (too_small || sorted)))) {
            order.before.assign(edit.now.size(), no_id);
            order.matched = 0;
            return;
        }
        pair.open.resize(edit.now.size(), false);
        pair.rival = slid(edit, order.before, pair.open);
        if (order.in_place == order.matched || (kept && place.matched == edit.now.size())) return;
        prefer_places(edit, pair);
        const auto least = rival_score * static_cast<double>(order.score);
        if (place.replaced <= order.replaced && static_cast<double>(place.score) >= least)
            doubt(edit, place, pair);
    }

    // What the vertices say of nearly all faces of which they know.
    struct Vertices {
        bool agree = false;  // that they are where the reading has them
        bool stay = false, moved = false;
    };
    Vertices vertices_of(const ObjectPair& pair, const ObjectEdit& edit, const Reading& reading) const {
        const auto went = went_.subspan(old_.objects[pair.old].first, edit.old.size());
        std::size_t known = 0, agree = 0, stay = 0;
        for (std::size_t a = 0; a < went.size(); ++a) {
            known += went[a] ? 1 : 0;
            stay += went[a] && ((*went[a] - edit.old[a].position.cast<double>()).cwiseAbs().array() <=
                                edit.box.step.cast<double>().array())
                                   .all()
                        ? 1
                        : 0;
        }
        for (std::uint32_t b = 0; b < reading.before.size(); ++b) {
            const Vec3 here = edit.now[b].position.cast<double>();
            if (const std::uint32_t a = reading.before[b]; a != no_id && went[a])
                agree += (*went[a] - here).norm() <= 8.0 * position_tolerance(here) ? 1 : 0;
        }
        return {known > 0 && almost_all(agree, known), known > 0 && almost_all(stay, known),
                known > 0 && almost_all(known - stay, known)};
    }

    // Of equal faces that may have been added or removed, those that leave the others in their places.
    static void prefer_places(const ObjectEdit& edit, ObjectPair& pair) {
        std::vector<std::uint32_t>& before = pair.order.before;
        std::vector<bool> stayed(edit.old.size(), false);
        const auto there = [&](std::uint32_t a, std::size_t b) { return a != no_id && edit.in_place(a, b); };
        for (std::size_t b = 0; b < before.size(); ++b) {
            if (there(before[b], b) || !there(pair.rival[b], b)) continue;
            std::swap(before[b], pair.rival[b]);
            stayed[before[b]] = true;
        }
        for (std::size_t b = 0; b < before.size(); ++b)
            if (before[b] != no_id && stayed[before[b]] && !edit.in_place(before[b], b)) before[b] = no_id;
    }

    // The places explain as much as the order.
    static void doubt(const ObjectEdit& edit, const Reading& place, ObjectPair& pair) {
        std::vector<bool> placed(edit.old.size(), false);
        for (const std::uint32_t a : place.before)
            if (a != no_id) placed[a] = true;
        for (std::size_t b = 0; b < edit.now.size(); ++b) {
            const std::uint32_t a = pair.order.before[b];
            // A face that the places know nothing of is what the order says.
            if (a == no_id || a == place.before[b] || (!placed[a] && place.before[b] == no_id)) continue;
            pair.rival[b] = place.before[b];
            pair.by_place_too = true;
        }
    }

    // An object that may have turned in its place or stayed did what others did that cannot have stayed.
    void trust_shared_motions() {
        std::vector<PartMotion> seen;
        for (const ObjectPair& pair : pairs_)
            if (pair.order.whole && pair.order.in_place == 0 && !pair.by_place_too && seen.size() < max_seen)
                if (const std::optional<PartMotion> motion = motion_of(pair)) seen.push_back(*motion);
        for (ObjectPair& pair : pairs_) {
            const auto made_by = [&](const PartMotion& motion) { return makes(motion, pair); };
            if (!pair.by_place_too || std::none_of(seen.begin(), seen.end(), made_by)) continue;
            pair.rival.clear();
            pair.by_place_too = false;
        }
    }

    // How the object moved, if it kept its shape.
    std::optional<PartMotion> motion_of(const ObjectPair& pair) const {
        const ObjectEdit edit = edit_of(pair);
        const std::size_t step = 1 + edit.now.size() / max_fitted;
        std::vector<std::size_t> fitted;
        for (std::size_t b = 0; b < edit.now.size(); b += step)
            if (pair.order.before[b] != no_id) fitted.push_back(b);
        if (fitted.size() < 4) return std::nullopt;
        Eigen::Matrix3Xd from(3, static_cast<Eigen::Index>(fitted.size())), to = from;
        for (std::size_t i = 0; i < fitted.size(); ++i) {
            const auto column = static_cast<Eigen::Index>(i);
            from.col(column) = edit.old[pair.order.before[fitted[i]]].position.cast<double>();
            to.col(column) = edit.now[fitted[i]].position.cast<double>();
        }
        for (const bool mirrored : {false, true})
            if (const std::optional<PartMotion> motion = fit_similarity(from, to, mirrored);
                motion && makes(*motion, pair))
                return motion;
        return std::nullopt;
    }

    // Whether the motion puts the old faces of the object where they are now.
    bool makes(const PartMotion& motion, const ObjectPair& pair) const {
        const ObjectEdit edit = edit_of(pair);
        const double size = (pair.went_to.max - pair.went_to.min).norm();
        const double slack = 2.0 * static_cast<double>(edit.box.step.norm()) + near_enough * size;
        for (std::size_t b = 0; b < edit.now.size(); ++b) {
            const std::uint32_t a = pair.order.before[b];
            if (a == no_id) continue;
            const Vec3 there = motion(edit.old[a].position.cast<double>());
            if (!((there - edit.now[b].position.cast<double>()).norm() <= slack)) return false;
        }
        return true;
    }

    // Two equal objects at each other's places, in the order of the places: their names were exchanged, or
    // they were, and their order, too. And several of which each is where the next one was: they have moved,
    // or one was deleted and the others got the names before theirs.
    void doubt_exchanged_names() {
        std::map<std::uint64_t, std::vector<std::size_t>> equal;       // [joints] the pairs
        std::map<std::uint64_t, std::vector<std::uint32_t>> by_place;  // [joints] old objects
        std::vector<std::uint32_t> now_of(old_.objects.size(), no_id);
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            now_of[pairs_[i].old] = pairs_[i].now;
            if (pairs_[i].named && pairs_[i].order.whole) equal[joints_[pairs_[i].old]].push_back(i);
        }
        for (std::uint32_t old = 0; old < old_.objects.size(); ++old)
            by_place[joints_[old]].push_back(old);
        for (auto& [key, list] : by_place)
            std::sort(list.begin(), list.end(),
                      [&](std::uint32_t a, std::uint32_t b) { return low(a) < low(b); });
        for (const auto& [key, list] : equal) {
            std::vector<std::uint32_t> at;  // [of list] the old object whose place it has; no_id: none
            std::size_t moved = 0;
            bool ascending = true;  // `list` is in the order of the new objects
            std::uint32_t next = 0;
            for (const std::size_t i : list) {
                at.push_back(stood_at(pairs_[i], by_place[key]));
                if (at.back() == no_id) continue;
                ascending = ascending && at.back() >= next;
                next = at.back() + 1;
                moved += at.back() != pairs_[i].old ? 1 : 0;
            }
            for (std::size_t k = 0; k < list.size(); ++k) {
                ObjectPair& pair = pairs_[list[k]];
                if (at[k] == no_id || at[k] == pair.old) continue;
                const bool exchanged =
                    now_of[at[k]] != no_id && (pair.old < at[k]) != (pair.now < now_of[at[k]]);
                if (!exchanged && !(ascending && moved > 1)) continue;
                const std::uint32_t from = old_.objects[pair.old].first, to = old_.objects[at[k]].first;
                if (pair.rival.empty()) pair.rival = pair.order.before;
                for (std::uint32_t& before : pair.rival)
                    if (before != no_id) before = before + to - from;  // indices into the object, below
            }
        }
    }

    // The old object that was where that of the pair is now; no_id: none. `by_place`: in the order of low().
    std::uint32_t stood_at(const ObjectPair& pair, const std::vector<std::uint32_t>& by_place) const {
        const double slack = 2.0 * static_cast<double>(old_.objects[pair.old].step.norm());
        const Aabb& is = pair.went_to;
        auto other = std::lower_bound(by_place.begin(), by_place.end(), is.min.x() - slack,
                                      [&](std::uint32_t one, double x) { return low(one) < x; });
        for (std::size_t tried = 0;
             other != by_place.end() && tried < max_side_by_side && low(*other) <= is.min.x() + slack;
             ++other, ++tried) {
            const Aabb& was = old_.objects[*other].box;
            if ((was.min - is.min).norm() <= slack && (was.max - is.max).norm() <= slack) return *other;
        }
        return no_id;
    }

    double low(std::uint32_t old) const { return old_.objects[old].box.min.x(); }

    bool level_is_in_order() const {
        std::size_t faces = 0, in_order = 0;
        for (const ObjectPair& pair : pairs_) {
            faces += now_.objects[pair.now].count;
            in_order += pair.order.matched;
        }
        return almost_all(in_order, faces);
    }

    void add(const ObjectPair& pair, Correspondence& result) const {
        const std::uint32_t first = now_.objects[pair.now].first, old = old_.objects[pair.old].first;
        const ObjectEdit edit = edit_of(pair);
        for (std::uint32_t b = 0; b < pair.order.before.size(); ++b) {
            const std::uint32_t before = pair.order.before[b];
            const std::uint32_t rival = pair.rival.empty() ? before : pair.rival[b];
            result.rival[first + b] = rival == no_id ? no_id : old + rival;
            result.open[first + b] = b < pair.open.size() && pair.open[b];
            if (before == no_id) continue;
            result.before[first + b] = old + before;
            result.moved[first + b] = !edit.in_place(before, b);
        }
    }

    const MeshTokens &old_, &now_;
    const std::span<const std::optional<Vec3>> went_;
    std::vector<ObjectPair> pairs_;
    std::vector<bool> paired_old_, paired_now_;
    std::vector<std::uint64_t> joints_;  // [old object]
};

}  // namespace

Correspondence correspond(const MeshTokens& old, const MeshTokens& now,
                          std::span<const std::optional<Vec3>> went) {
    return Comparison(old, now, went).run();
}

}  // namespace slipface
