#include "token_reading.h"

#include <algorithm>
#include <cmath>

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
    for (std::uint32_t i = 0; i < edit.old.size(); ++i)
        if (may_be(edit.old[i], edit.now[i])) reading.before[i] = i;
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
    const PointGrid places(edit.old.size(), cell_of_places, [&](std::size_t a) { return scaled(edit.old[a]); });
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

std::vector<std::uint32_t> slid(const ObjectEdit& edit, const std::vector<std::uint32_t>& before) {
    // Only their shapes are compared: the first face of a row is joined to nothing, whichever it is.
    std::vector<std::uint32_t> other = before;
    // Between the old faces before `a0` and from `a1` on, and the new ones before `b0` and from `b1` on, one
    // of the two lists has more. That of the longer one is `length` longer.
    const auto slide = [&](std::uint32_t a0, std::uint32_t a1, std::uint32_t b0, std::uint32_t b1) {
        const auto known = [&](std::uint32_t b, std::uint32_t a) {
            return b < before.size() && before[b] == a;
        };
        if (a1 > a0) {  // removed
            for (std::uint32_t k = 1;
                 k <= a0 && k <= b0 && known(b0 - k, a0 - k) && edit.old[a0 - k].shaped_as(edit.old[a1 - k]);
                 ++k)
                other[b0 - k] = a1 - k;
            for (std::uint32_t k = 0; a1 + k < edit.old.size() && known(b0 + k, a1 + k) &&
                                      edit.old[a0 + k].shaped_as(edit.old[a1 + k]);
                 ++k)
                other[b0 + k] = a0 + k;
            return;
        }
        std::uint32_t k = 1;  // added
        for (; k <= a0 && k <= b0 && known(b0 - k, a0 - k) && edit.now[b0 - k].shaped_as(edit.now[b1 - k]);
             ++k)
            other[b1 - k] = a0 - k;
        for (std::uint32_t b = b0 - (k - 1); b < std::min(b0, b1 - (k - 1)); ++b)
            other[b] = no_id;
        for (k = 0; b1 + k < edit.now.size() && known(b1 + k, a0 + k) &&
                    edit.now[b0 + k].shaped_as(edit.now[b1 + k]);
             ++k)
            other[b0 + k] = a0 + k;
        for (std::uint32_t b = std::max(b1, b0 + k); b < b1 + k; ++b)
            other[b] = no_id;
    };
    std::uint32_t next_a = 0, next_b = 0;
    const auto end_gap = [&](std::uint32_t a, std::uint32_t b) {
        if (a >= next_a && (a == next_a) != (b == next_b)) slide(next_a, a, next_b, b);
    };
    for (std::uint32_t b = 0; b < before.size(); ++b) {
        if (before[b] == no_id) continue;
        end_gap(before[b], b);
        next_a = before[b] + 1;
        next_b = b + 1;
    }
    end_gap(static_cast<std::uint32_t>(edit.old.size()), static_cast<std::uint32_t>(before.size()));
    return other;
}

}  // namespace slipface
