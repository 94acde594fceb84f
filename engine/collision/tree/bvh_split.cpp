#include "tree/bvh_split.h"

namespace slipface::detail {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

// Half the surface areas of three boxes side by side.
Four half_surfaces(const std::array<Box, 3>& boxes) {
    const Four empty = Four::all(0.0F);
    const auto [x, y, z] =
        transposed(four_max(boxes[0].max - boxes[0].min, empty), four_max(boxes[1].max - boxes[1].min, empty),
                   four_max(boxes[2].max - boxes[2].min, empty));
    return x * y + y * z + z * x;
}

}  // namespace

// All three axes side by side, first from above and then from below.
Split cheapest_split(const Grid& grid, const Bins& table, std::size_t bins) {
    alignas(16) float right_cost[max_bins][4];
    alignas(16) float left_blocks[max_bins][4] = {};
    std::array<std::uint32_t, 3> all{};
    for (std::size_t bin = 0; bin < bins; ++bin) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            left_blocks[bin][axis] = static_cast<float>(blocks(all[axis]));
            all[axis] += table.weight[bin][axis];
        }
    }
    std::array<Box, 3> boxes;
    std::array<std::uint32_t, 3> above{};
    for (std::size_t bin = bins - 1; bin > 0; --bin) {
        alignas(16) float right_blocks[4] = {};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            boxes[axis].add(table.box[axis][bin]);
            above[axis] += table.weight[bin][axis];
            // A split with everything on one side is not a split.
            const bool none = above[axis] == 0 || above[axis] == all[axis];
            right_blocks[axis] = none ? inf : static_cast<float>(blocks(above[axis]));
        }
        (half_surfaces(boxes) * Four::load(right_blocks)).store(right_cost[bin]);
    }
    boxes = {};
    Four cost = Four::all(inf);
    Four at = Four::all(0.0F);
    for (std::size_t bin = 1; bin < bins; ++bin) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            boxes[axis].add(table.box[axis][bin - 1]);
        const Four here = half_surfaces(boxes) * Four::load(left_blocks[bin]) + Four::load(right_cost[bin]);
        const Four better = four_less(here, cost);
        cost = four_pick(better, here, cost);
        at = four_pick(better, Four::all(static_cast<float>(bin)), at);
    }
    alignas(16) float costs[4];
    alignas(16) float places[4];
    cost.store(costs);
    at.store(places);
    Split best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!grid.usable(axis) || !(costs[axis] < best.cost)) continue;
        best.axis = axis;
        best.bin = static_cast<std::uint32_t>(places[axis]);
        best.cost = costs[axis];
    }
    for (std::size_t bin = 0; bin < bins; ++bin)
        (bin < best.bin ? best.left : best.right).add(table.box[best.axis][bin]);
    return best;
}

}  // namespace slipface::detail
