#include "token_reading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "face_match.h"
#include "point_grid.h"
#include "sequence_diff.h"
#include "slipface/base/key_sort.h"

namespace slipface {
namespace {

constexpr double enough_joined = 0.75;  // of the faces, so that their order counts as kept
constexpr double enough_as_triangles = 0.9;
// In the face's size: how far the mean of its corners is from the middle of its area.
constexpr double off_centre = 0.3;
constexpr double unlikely_bits = 6.0;         // what is as likely as a chance of one in 64 is none
constexpr std::size_t max_at_one_place = 64;  // faces compared there
// In steps between the positions of old faces; more than twice as wide as the new ones may be away.
constexpr double cell_of_places = 2.0;

// Whether one face may be the other after an edit that it was part of.
bool may_be(const FaceToken& a, const FaceToken& b) {
    return a.joined_as(b) || a.shaped_as(b);
}

// Different motions of faces that may have been others of their row.
constexpr std::size_t max_slides = 64;

double slack_of(const Vec3f& position) {
    return 2.0 * position_tolerance(position.cast<double>());
}

// Fills in score, matched, in_place and replaced.
void rate(const ObjectEdit& edit, Reading& reading) {
    constexpr std::uint32_t none = no_id;
    std::uint32_t last_a = none, last_b = none;
    bool ascending = true;
    std::size_t came = 0, all_came = 0, in_gaps = 0, different = 0;
    for (std::uint32_t b = 0; b < reading.before.size(); ++b) {
        const std::uint32_t a = reading.before[b];
        if (a == none) {
            ++came;
            ++all_came;
            continue;
        }
        const bool again = a == last_a;  // another triangle of the same face
        const std::uint32_t next = last_a == none ? 0 : last_a + (again ? 0 : 1);
        ascending = ascending && a >= next;
        if (a > next && came > 0 && ascending) {
            ++in_gaps;
            if (a - next == came) --in_gaps;
        }
        different += again ? 0 : 1;
        came = 0;
        ++reading.matched;
        const bool there = edit.in_place(a, b);
        reading.in_place += there ? 1 : 0;
        reading.score += edit.old[a].joined_as(edit.now[b]) ? 1 : 0;
        reading.score += edit.old[a].shaped_as(edit.now[b]) ? 1 : 0;
        if (there || (last_a != none && edit.moved_together(a, b, last_a, last_b))) ++reading.score;
        last_a = a;
        last_b = b;
    }
    const std::size_t gone = edit.old.size() - std::min(different, edit.old.size());
    const std::size_t tail = last_a == none ? edit.old.size() : edit.old.size() - 1 - last_a;
    if (tail > 0 && came > 0 && tail != came) ++in_gaps;
    reading.replaced = ascending ? in_gaps : std::size_t{gone > 0 && all_came > 0};
}

bool read_whole(const ObjectEdit& edit, Reading& reading) {
    if (edit.old.size() != edit.now.size()) return false;
    std::size_t joined = 0;
    for (std::size_t i = 0; i < edit.old.size(); ++i)
        joined += edit.old[i].joined_as(edit.now[i]) ? 1 : 0;
    if (static_cast<double>(joined) < enough_joined * static_cast<double>(edit.old.size())) return false;
    std::vector<bool> known(edit.old.size());
    std::size_t shaped = 0;
    for (std::uint32_t i = 0; i < edit.old.size(); ++i) {
        known[i] = may_be(edit.old[i], edit.now[i]);
        shaped += edit.old[i].shaped_as(edit.now[i]) ? 1 : 0;
    }
    // Of an object that was scaled, a single face between known ones is the old one there.
    for (std::uint32_t i = 0; i < edit.old.size(); ++i) {
        const bool single = 2 * shaped < known.size() && edit.old[i].corners == edit.now[i].corners &&
                            i > 0 && known[i - 1] && i + 1 < known.size() && known[i + 1];
        if (known[i] || single) reading.before[i] = i;
    }
    return true;
}

// Each face of n corners became n - 2 triangles, in the order of the faces: these have its area and its
// material, and are as far from those of the face before as the faces were.
bool read_triangles(const ObjectEdit& edit, Reading& reading) {
    std::size_t triangles = 0, fitting = 0;
    for (const FaceToken& token : edit.old)
        triangles += token.corners - 2U;
    if (triangles != edit.now.size() || triangles == edit.old.size()) return false;
    std::uint32_t b = 0;
    Vec3 last = Vec3::Zero();
    double last_size = 0.0;
    for (std::uint32_t a = 0; a < edit.old.size(); ++a) {
        const FaceToken& old = edit.old[a];
        double area = 0.0;
        Vec3 sum = Vec3::Zero();
        bool fits = true;
        for (std::uint32_t left = old.corners - 2U; left > 0; --left, ++b) {
            const FaceToken& now = edit.now[b];
            if (now.corners != 3) return false;
            area += now.square_metres();
            sum += now.square_metres() * now.position.cast<double>();
            fits = fits && now.material == old.material;
            reading.before[b] = a;
        }
        const Vec3 centre = area > 0.0 ? Vec3(sum / area) : edit.now[b - 1].position.cast<double>();
        const double old_area = old.square_metres(), size = std::sqrt(old_area);
        fits = fits && std::abs(area - old_area) <= 0.03 * std::max(area, old_area);
        if (a > 0) {
            const Vec3 away = (old.position - edit.old[a - 1].position).cast<double>();
            fits = fits && std::abs((centre - last).norm() - away.norm()) <=
                               off_centre * (size + last_size) + static_cast<double>(edit.box.step.norm());
        }
        last = centre;
        last_size = size;
        fitting += fits ? 1 : 0;
    }
    if (static_cast<double>(fitting) >= enough_as_triangles * static_cast<double>(edit.old.size()))
        return true;
    reading.before.assign(edit.now.size(), no_id);
    return false;
}

// [old face] how much it says that a new face is like it, in bits: the fewer are, the more.
std::vector<double> weights_of(std::span<const FaceToken> faces) {
    std::vector<KeyedIndex> order(faces.size());
    for (std::uint32_t i = 0; i < faces.size(); ++i)
        // Areas that are nearly equal count as equal.
        order[i] = {std::uint64_t{faces[i].topology} << 24 | std::uint64_t{faces[i].corners} << 20 |
                        std::uint64_t{faces[i].material} << 16 | (faces[i].area + 1U) / 3U,
                    i};
    sort_by_key(order);
    std::vector<double> weights(faces.size());
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        for (end = begin; end < order.size() && order[end].key == order[begin].key;)
            ++end;
        const double bits = std::log2(static_cast<double>(faces.size()) / static_cast<double>(end - begin));
        for (std::size_t i = begin; i < end; ++i)
            weights[order[i].index] = bits;
    }
    return weights;
}

// Faces in a row that moved count if so many that are so rare are not in that order by chance, and those that
// stayed if others count or they themselves are enough. Of equal tiles no number is enough.
void drop_chance(const ObjectEdit& edit, std::vector<std::uint32_t>& before) {
    const std::vector<double> weights = weights_of(edit.old);
    const double enough = unlikely_bits + std::log2(static_cast<double>(edit.old.size())) +
                          std::log2(static_cast<double>(edit.now.size()));
    double all = 0.0;
    for (std::size_t begin = 0, end = 0; begin < before.size(); begin = end) {
        end = begin + 1;
        const std::uint32_t a = before[begin];
        if (a == no_id) continue;
        double bits = weights[a];
        std::size_t in_place = edit.in_place(a, begin) ? 1 : 0;
        for (; end < before.size() && before[end] == a + (end - begin); ++end) {
            bits += weights[before[end]];
            in_place += edit.in_place(before[end], end) ? 1 : 0;
        }
        if (bits >= enough || in_place == end - begin)
            all += bits;
        else
            std::fill(before.begin() + static_cast<std::ptrdiff_t>(begin),
                      before.begin() + static_cast<std::ptrdiff_t>(end), no_id);
    }
    if (all < enough) before.assign(before.size(), no_id);
}

// Between many more faces that are known, as many new as old ones are these, changed.
void fill_gaps(const ObjectEdit& edit, std::vector<std::uint32_t>& before) {
    const auto known =
        before.size() - static_cast<std::size_t>(std::count(before.begin(), before.end(), no_id));
    std::uint32_t next_a = 0, next_b = 0;
    const auto fill = [&](std::uint32_t end_a, std::uint32_t end_b) {
        if (end_a < next_a || end_a - next_a != end_b - next_b || 4 * (end_b - next_b) > known) return;
        for (; next_b < end_b; ++next_a, ++next_b)
            if (may_be(edit.old[next_a], edit.now[next_b])) before[next_b] = next_a;
    };
    for (std::uint32_t b = 0; b < before.size(); ++b) {
        if (before[b] == no_id) continue;
        const std::uint32_t a = before[b];
        fill(a, b);
        next_a = a + 1;
        next_b = b + 1;
    }
    fill(static_cast<std::uint32_t>(edit.old.size()), static_cast<std::uint32_t>(edit.now.size()));
}

}  // namespace

Vec3 ObjectEdit::away(std::size_t a, std::size_t b) const {
    return (now[b].position - old[a].position).cast<double>();
}

bool ObjectEdit::same_place(const Vec3& a, const Vec3& b, std::size_t face) const {
    return ((a - b).cwiseAbs().array() <=
            1.02 * box.step.cast<double>().array() + 2.0 * slack_of(now[face].position))
        .all();
}

bool ObjectEdit::in_place(std::size_t a, std::size_t b) const {
    const Vec3f away = (now[b].position - old[a].position).cwiseAbs();
    const auto slack = static_cast<float>(slack_of(now[b].position));
    return (away.array() <= 0.51f * box.step.array() + slack).all();
}

bool ObjectEdit::moved_together(std::size_t a, std::size_t b, std::size_t last_a, std::size_t last_b) const {
    const double was = static_cast<double>((old[a].position - old[last_a].position).norm());
    const double is = static_cast<double>((now[b].position - now[last_b].position).norm());
    return std::abs(was - is) <=
           static_cast<double>(box.step.norm()) + 1e-4 * was + slack_of(now[b].position);
}

Reading read_by_order(const ObjectEdit& edit) {
    Reading reading;
    reading.before.assign(edit.now.size(), no_id);
    reading.whole = read_whole(edit, reading) || read_triangles(edit, reading);
    if (!reading.whole) {
        reading.before = sequence_diff(edit.old, edit.now);
        drop_chance(edit, reading.before);
        fill_gaps(edit, reading.before);
    }
    rate(edit, reading);
    return reading;
}

Reading read_by_place(const ObjectEdit& edit) {
    const Vec3 step = edit.box.step.cast<double>();
    const auto scaled = [&](const FaceToken& face) -> Vec3 {
        return face.position.cast<double>().cwiseQuotient(step);
    };
    const PointGrid places(edit.old.size(), cell_of_places,
                           [&](std::size_t a) { return scaled(edit.old[a]); });
    Reading reading;
    reading.before.assign(edit.now.size(), no_id);
    std::vector<bool> taken(edit.old.size(), false);
    std::uint32_t last = no_id;
    for (std::uint32_t b = 0; b < edit.now.size(); ++b) {
        std::uint32_t best = no_id;
        int best_rank = -1;
        std::size_t tried = 0;
        places.near(scaled(edit.now[b]), 0.5 * cell_of_places, [&](std::uint32_t a) {
            if (taken[a] || ++tried > max_at_one_place || !edit.old[a].shaped_as(edit.now[b]) ||
                !edit.in_place(a, b))
                return;
            const int rank = 2 * int{edit.old[a].joined_as(edit.now[b])} + int{a == last + 1};
            if (rank <= best_rank) return;
            best = a;
            best_rank = rank;
        });
        if (best == no_id) continue;
        taken[best] = true;
        reading.before[b] = last = best;
    }
    fill_gaps(edit, reading.before);
    rate(edit, reading);
    return reading;
}

namespace {

// In a row of equal faces others of the row may have gone or come: what the faces before or behind a gap were
// then, all as far away from where they are.
struct Slide {
    bool added;
    Vec3 by;
    std::vector<std::uint32_t> now, old;
};

// Between the old faces from `a0` to `a1`, and the new ones from `b0` to `b1`, one of the two lists is empty.
void add_slides(const ObjectEdit& edit, const std::vector<std::uint32_t>& before, std::uint32_t a0,
                std::uint32_t a1, std::uint32_t b0, std::uint32_t b1, std::vector<Slide>& slides) {
    const bool added = a0 == a1;
    // Only their shapes are compared: the first face of a row is joined to nothing, whichever it is.
    const auto slide = [&](const auto& face_at) {
        Slide found{added, {}, {}, {}};
        for (std::uint32_t k = 0;; ++k) {
            const auto [known_a, known_b, a, b] = face_at(k);
            if (known_a >= edit.old.size() || known_b >= before.size() || before[known_b] != known_a ||
                a >= edit.old.size() || b >= edit.now.size() || !edit.old[a].shaped_as(edit.now[b]))
                break;
            if (k == 0) found.by = edit.away(a, b);
            if (!edit.same_place(edit.away(a, b), found.by, b)) break;
            found.now.push_back(b);
            found.old.push_back(a);
        }
        if (!found.now.empty()) slides.push_back(std::move(found));
    };
    using Faces = std::array<std::uint32_t, 4>;  // below 0 is more than there are
    slide([&](std::uint32_t k) -> Faces {
        return {a0 - 1 - k, b0 - 1 - k, (added ? a0 : a1) - 1 - k, (added ? b1 : b0) - 1 - k};
    });
    slide([&](std::uint32_t k) -> Faces { return {a1 + k, b1 + k, a0 + k, b0 + k}; });
}

}  // namespace

Reading in_order(const ObjectEdit& edit, const Reading& place) {
    Reading reading;
    reading.before.assign(edit.now.size(), no_id);
    std::vector<Stretch> known;
    for (std::uint32_t b = 0; b < place.before.size(); ++b)
        if (place.before[b] != no_id) known.push_back({place.before[b], b});
    for (const Stretch& face : longest_ascending(known))
        reading.before[face.b] = face.a;
    fill_gaps(edit, reading.before);
    rate(edit, reading);
    return reading;
}

std::vector<std::uint32_t> slid(const ObjectEdit& edit, const std::vector<std::uint32_t>& before,
                                std::vector<bool>& open) {
    std::vector<Slide> slides;
    std::uint32_t next_a = 0, next_b = 0;
    const auto end_gap = [&](std::uint32_t a, std::uint32_t b) {
        if (a >= next_a && (a == next_a) != (b == next_b))
            add_slides(edit, before, next_a, a, next_b, b, slides);
    };
    for (std::uint32_t b = 0; b < before.size(); ++b) {
        if (before[b] == no_id) continue;
        end_gap(before[b], b);
        next_a = before[b] + 1;
        next_b = b + 1;
    }
    end_gap(static_cast<std::uint32_t>(edit.old.size()), static_cast<std::uint32_t>(before.size()));

    std::vector<std::uint32_t> other = before;
    std::vector<bool> done(slides.size(), false);
    std::size_t motions = 0;
    for (std::size_t first = 0; first < slides.size(); ++first) {
        if (done[first]) continue;
        if (++motions > max_slides) break;
        const bool added = slides[first].added;
        const Vec3 by = slides[first].by;
        std::vector<bool> moves(before.size(), false);
        for (std::size_t i = first; i < slides.size(); ++i) {
            if (slides[i].added != added || !edit.same_place(slides[i].by, by, slides[i].now[0])) continue;
            done[i] = true;
            for (const std::uint32_t b : slides[i].now)
                moves[b] = true;
        }
        // What has no other past lies ahead of those that closed up, and behind those that made room.
        double limit = std::numeric_limits<double>::infinity();
        const auto ahead = [&](std::uint32_t b) {
            return (added ? -1.0 : 1.0) * by.dot(edit.now[b].position.cast<double>());
        };
        for (std::uint32_t b = 0; b < before.size(); ++b)
            if (before[b] != no_id && !moves[b] && !edit.same_place(edit.away(before[b], b), by, b))
                limit = std::min(limit, ahead(b));
        const double room = by.norm() * static_cast<double>(edit.box.step.norm());
        const bool stays = edit.same_place(by, Vec3::Zero(), slides[first].now[0]);
        for (std::size_t i = first; i < slides.size(); ++i) {
            if (slides[i].added != added || !edit.same_place(slides[i].by, by, slides[i].now[0])) continue;
            for (std::size_t k = 0; k < slides[i].now.size(); ++k) {
                const std::uint32_t b = slides[i].now[k];
                if (!stays && ahead(b) + room >= limit) continue;
                other[b] = slides[i].old[k];
                open[b] = open[b] || added;
            }
        }
    }
    // An old face is only one of the new ones.
    std::vector<bool> taken(edit.old.size(), false);
    for (std::uint32_t b = 0; b < before.size(); ++b)
        if (other[b] != before[b] && other[b] != no_id) taken[other[b]] = true;
    for (std::uint32_t b = 0; b < before.size(); ++b)
        if (other[b] == before[b] && other[b] != no_id && taken[other[b]]) {
            other[b] = no_id;
            open[b] = true;
        }
    return other;
}

}  // namespace slipface
