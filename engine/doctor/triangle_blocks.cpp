#include "triangle_blocks.h"

#include <cmath>
#include <numeric>

#include "slipface/base/parallel.h"

namespace slipface::doctor {
namespace {

struct Item {
    std::uint32_t key;
    TriangleId id;
};

std::array<Vec3f, 3> corners_of(const Mesh& mesh, TriangleId triangle) {
    const auto& corners = mesh.triangles[triangle];
    return {mesh.corner_position(corners[0]), mesh.corner_position(corners[1]),
            mesh.corner_position(corners[2])};
}

Box box_of(const std::array<Vec3f, 3>& c) {
    return {c[0].cwiseMin(c[1]).cwiseMin(c[2]), c[0].cwiseMax(c[1]).cwiseMax(c[2])};
}

// Stable, by ten bits of the keys.
void sort_by_digit(std::span<const Item> from, std::span<Item> to, unsigned shift) {
    std::array<std::uint32_t, 1025> begin{};
    const auto digit = [&](const Item& item) { return (item.key >> shift) & 1023U; };
    for (const Item& item : from)
        ++begin[digit(item) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (const Item& item : from)
        to[begin[digit(item)]++] = item;
}

// Ten bits of each coordinate in turns: what has consecutive keys is near each other.
std::uint32_t interleaved(const Vec3f& cell) {
    std::uint32_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
        std::uint32_t bits = std::min(static_cast<std::uint32_t>(cell[axis]), 1023U);
        bits = (bits | bits << 16U) & 0x030000ffU;
        bits = (bits | bits << 8U) & 0x0300f00fU;
        bits = (bits | bits << 4U) & 0x030c30c3U;
        bits = (bits | bits << 2U) & 0x09249249U;
        key |= bits << static_cast<unsigned>(axis);
    }
    return key;
}

// Puts items that are near each other together. `spare` has room for as many.
void sort_near(std::span<Item> items, std::span<Item> spare, std::span<const Vec3f> centre) {
    Box box;
    for (const Item& item : items)
        box.add(centre[item.id], centre[item.id]);
    const float extent = (box.max - box.min).maxCoeff();
    if (!(extent > 0.0f)) return;
    for (Item& item : items)
        item.key = interleaved((centre[item.id] - box.min) * (1024.0f / extent));
    if (items.size() < 1024) {
        std::sort(items.begin(), items.end(),
                  [](const Item& a, const Item& b) { return a.key != b.key ? a.key < b.key : a.id < b.id; });
    } else {
        spare = spare.first(items.size());
        sort_by_digit(items, spare, 0);
        sort_by_digit(spare, items, 10);
        sort_by_digit(items, spare, 20);
        std::copy(spare.begin(), spare.end(), items.begin());
    }
    constexpr std::size_t many = 64;  // in one cell, a thousandth of the extent
    for (std::size_t first = 0, last = 0; first < items.size(); first = last) {
        while (last < items.size() && items[last].key == items[first].key)
            ++last;
        if (last - first > many) sort_near(items.subspan(first, last - first), spare, centre);
    }
}

// The triangles, of similar size and near each other one after the other. Sizes are apart so that no large
// triangle stands in a block of small ones, which would be looked at wherever the large one is.
std::vector<Item> sorted(const Mesh& mesh) {
    constexpr std::size_t sizes = 64;
    const std::size_t count = mesh.triangle_count();
    std::vector<Item> items(count), spare(count);
    std::vector<Vec3f> centre(count);
    parallel_for(count, 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) {
            const Box box = box_of(corners_of(mesh, static_cast<TriangleId>(t)));
            centre[t] = 0.5f * (box.min + box.max);
            // A factor of four from one size to the next.
            const float extent = std::max((box.max - box.min).maxCoeff(), 1e-30f);
            const int size = std::clamp(std::ilogb(extent) / 2 + 50, 0, int{sizes} - 1);
            spare[t] = {static_cast<std::uint32_t>(size), static_cast<TriangleId>(t)};
        }
    });
    std::array<std::uint32_t, sizes + 1> begin{};
    for (const Item& item : spare)
        ++begin[item.key + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    auto next = begin;
    for (const Item& item : spare)
        items[next[item.key]++] = item;
    for (std::size_t i = 0; i < sizes; ++i)
        sort_near(std::span(items).subspan(begin[i], begin[i + 1] - begin[i]), spare, centre);
    return items;
}

void fill(TriangleBlock& block, const Mesh& mesh, std::span<const Item> items) {
    block.count = items.size();
    block.id.fill(no_id);
    for (std::size_t lane = 0; lane < items.size(); ++lane) {
        block.id[lane] = items[lane].id;
        const auto corners = corners_of(mesh, items[lane].id);
        const Box box = box_of(corners);
        block.boxes.set(lane, box);
        block.around.add(box.min, box.max);
        const Vec3 a = corners[0].cast<double>(), b = corners[1].cast<double>(),
                   c = corners[2].cast<double>();
        const Vec3f centre = ((a + b + c) / 3.0).cast<float>();
        const Vec3 cross = (b - a).cross(c - a);
        const Vec3f normal = (cross / cross.norm()).cast<float>();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            block.centre[axis][lane] = centre[static_cast<int>(axis)];
            block.normal[axis][lane] = normal[static_cast<int>(axis)];
        }
    }
    block.lowest = *std::min_element(block.id.begin(), block.id.end());
}

}  // namespace

Boxes::Boxes() {
    for (std::size_t lane = 0; lane < lanes; ++lane)
        set(lane, Box());
}

void Boxes::set(std::size_t lane, const Box& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        min[axis][lane] = box.min[static_cast<int>(axis)];
        max[axis][lane] = box.max[static_cast<int>(axis)];
    }
}

TriangleBlocks::TriangleBlocks(const Mesh& mesh) {
    if (mesh.triangle_count() == 0) return;
    const std::vector<Item> items = sorted(mesh);
    blocks_.resize((items.size() + lanes - 1) / lanes);
    parallel_for(blocks_.size(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b)
            fill(blocks_[b], mesh,
                 std::span(items).subspan(b * lanes, std::min(lanes, items.size() - b * lanes)));
    });
    const auto add_level = [&](const auto& below) {
        std::vector<BlockGroup> level((below.size() + lanes - 1) / lanes);
        for (std::size_t i = 0; i < below.size(); ++i)
            level[i / lanes].add(i % lanes, below[i].around, below[i].lowest);
        levels_.push_back(std::move(level));
    };
    add_level(blocks_);
    while (levels_.back().size() > 1)
        add_level(levels_.back());
}

}  // namespace slipface::doctor
