// One split of the construction: finds the plane that divides a list of boxes at the lowest cost, and divides
// the list. Binned surface area heuristic after I. Wald, "On fast construction of SAH-based bounding volume
// hierarchies", 2007. Each element (a triangle, or a cell of several) counts by its weight().
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "tree/bvh_items.h"
#include "tree/bvh_layout.h"

namespace slipface::detail {

// The number of leaves that `count` triangles fill.
inline std::uint32_t blocks(std::uint32_t count) {
    return (count + leaf_capacity - 1) / leaf_capacity;
}

// Divides a box into equal parts along each axis and finds the part in which a centre lies.
class Grid {
  public:
    // `parts`: 1 to 2^23 along each axis. An axis along which all centres are equal has one part.
    Grid(const Box& centres, std::array<std::uint32_t, 3> parts) : origin_(centres.min) {
        alignas(16) float size[4];
        (centres.max - centres.min).store(size);
        alignas(16) float factor[4] = {};
        alignas(16) float last[4] = {};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float quotient = static_cast<float>(parts[axis]) / size[axis];
            usable_[axis] = quotient > 0.0F && std::isfinite(quotient);
            factor[axis] = usable_[axis] ? quotient : 0.0F;
            last[axis] = static_cast<float>(parts[axis] - 1);
        }
        scale_ = Four::load(factor);
        last_ = Four::load(last);
    }

    bool usable(std::size_t axis) const { return usable_[axis]; }
    std::array<std::uint32_t, 3> part(Four centre) const {
        return four_min(four_max((centre - origin_) * scale_, Four::all(0.0F)), last_).truncated();
    }

  private:
    Four origin_;
    Four scale_;
    Four last_;
    std::array<bool, 3> usable_;
};

inline constexpr std::size_t max_bins = 16;
inline std::uint32_t bin_count(std::size_t boxes) {
    return boxes < 96 ? 8 : max_bins;
}
inline Grid bin_grid(const Box& centres, std::size_t boxes) {
    const std::uint32_t bins = bin_count(boxes);
    return {centres, {bins, bins, bins}};
}

struct Bins {
    std::array<std::array<Box, max_bins>, 3> box;   // [axis][bin]
    alignas(16) std::uint32_t weight[max_bins][4];  // [bin][axis]

    explicit Bins(std::size_t bins) {
        for (auto& axis : box)
            std::fill_n(axis.begin(), bins, Box());
        std::fill_n(&weight[0][0], 4 * bins, 0U);
    }
    template <class Boxed>
    void add(const Grid& grid, const Boxed& boxed) {
        const Box its = box_of(boxed);
        const auto [x, y, z] = grid.part(centre_of(boxed));
        box[0][x].add(its);
        box[1][y].add(its);
        box[2][z].add(its);
        weight[x][0] += boxed.weight();
        weight[y][1] += boxed.weight();
        weight[z][2] += boxed.weight();
    }
    void add(const Bins& other, std::size_t bins) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t bin = 0; bin < bins; ++bin)
                box[axis][bin].add(other.box[axis][bin]);
        }
        for (std::size_t bin = 0; bin < bins; ++bin) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                weight[bin][axis] += other.weight[bin][axis];
        }
    }
};

struct Split {
    std::size_t axis = 0;
    std::uint32_t bin = 0;  // boxes in this bin and above go right
    float cost = std::numeric_limits<float>::infinity();
    Box left;
    Box right;
};

// The cheapest split between two of the first `bins` bins; its cost is infinite if there is none.
Split cheapest_split(const Grid& grid, const Bins& table, std::size_t bins);

template <class Boxed>
Split best_split(std::span<const Boxed> list, const Grid& grid) {
    const std::size_t bins = bin_count(list.size());
    Bins table(bins);
    // Two tables in alternation: neighbours mostly fall into the same bin, and one addition would wait for
    // the other. For a short list a second table costs more than it saves.
    if (list.size() < 64) {
        for (const Boxed& boxed : list)
            table.add(grid, boxed);
    } else {
        Bins other(bins);
        for (std::size_t i = 0; i + 1 < list.size(); i += 2) {
            table.add(grid, list[i]);
            other.add(grid, list[i + 1]);
        }
        if (list.size() % 2 == 1) table.add(grid, list.back());
        table.add(other, bins);
    }
    return cheapest_split(grid, table, bins);
}

struct Side {
    std::size_t size = 0;
    std::uint32_t weight = 0;
    Box centres;
};

// Reorders the list so that the left part comes first.
template <class Boxed>
std::pair<Side, Side> part(std::span<Boxed> list, const Grid& grid, const Split& split) {
    Side left;
    Side right;
    const auto goes_left = [&](const Boxed& boxed) {
        return grid.part(centre_of(boxed))[split.axis] < split.bin;
    };
    const auto take = [](Side& side, const Boxed& boxed) {
        side.centres.add(centre_of(boxed));
        side.weight += boxed.weight();
        ++side.size;
    };
    std::size_t low = 0;
    std::size_t high = list.size();
    while (true) {
        while (low < high && goes_left(list[low]))
            take(left, list[low++]);
        while (low < high && !goes_left(list[high - 1]))
            take(right, list[--high]);
        if (low >= high) return {left, right};
        std::swap(list[low], list[high - 1]);
    }
}

}  // namespace slipface::detail
