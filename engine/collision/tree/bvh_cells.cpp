#include "tree/bvh_cells.h"

#include <memory>

#include "slipface/base/parallel.h"
#include "tree/bvh_split.h"

namespace slipface::detail {
namespace {

// Roughly cubic cells by repeated halving. A few items lie in each, because surfaces leave most cells empty.
// All ones if the centres differ too little, or too much, for a float.
std::array<std::uint32_t, 3> grid_size(const Box& centres, std::size_t items) {
    std::array<std::uint32_t, 3> parts{1, 1, 1};
    alignas(16) float size[4];
    (centres.max - centres.min).store(size);
    while (std::size_t{parts[0]} * parts[1] * parts[2] < items / 4) {
        const auto axis = static_cast<std::size_t>(std::max_element(size, size + 3) - size);
        if (!(size[axis] > 0.0F && std::isfinite(size[axis]))) return {1, 1, 1};
        parts[axis] *= 2;
        size[axis] *= 0.5F;
    }
    return parts;
}

}  // namespace

std::vector<Cell> sort_into_cells(std::span<const Item> items, const Box& centres, std::span<Item> sorted) {
    const auto parts = grid_size(centres, items.size());
    const Grid grid(centres, parts);
    const auto cell_of_item = std::make_unique_for_overwrite<std::uint32_t[]>(items.size());
    parallel_for(items.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto [x, y, z] = grid.part(centre_of(items[i]));
            cell_of_item[i] = (z * parts[1] + y) * parts[0] + x;
        }
    });
    // A counting sort; items of one cell preserve their order.
    std::vector<std::uint32_t> starts(std::size_t{parts[0]} * parts[1] * parts[2] + 1);
    for (std::size_t i = 0; i < items.size(); ++i)
        ++starts[cell_of_item[i] + 1];
    const auto filled = static_cast<std::size_t>(
        std::count_if(starts.begin(), starts.end(), [](std::uint32_t count) { return count > 0; }));
    if (filled < cells_worth_it) return {};
    std::vector<Cell> cells;
    cells.reserve(filled);
    for (std::size_t cell = 1; cell < starts.size(); ++cell) {
        if (starts[cell] > 0) cells.push_back({{}, starts[cell - 1], {}, starts[cell]});
        starts[cell] += starts[cell - 1];
    }
    for (std::size_t i = 0; i < items.size(); ++i)
        sorted[starts[cell_of_item[i]]++] = items[i];
    parallel_for(cells.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (Cell& cell : std::span(cells).subspan(begin, end - begin)) {
            Box box;
            for (const Item& item : sorted.subspan(cell.first, cell.count))
                box.add(box_of(item));
            alignas(16) float corner[4];
            box.min.store(corner);
            std::copy_n(corner, 3, cell.min);
            box.max.store(corner);
            std::copy_n(corner, 3, cell.max);
        }
    });
    return cells;
}

}  // namespace slipface::detail
