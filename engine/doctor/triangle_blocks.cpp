#include "triangle_blocks.h"

#include <cmath>
#include <numeric>

#include "near_sort.h"
#include "slipface/base/parallel.h"

namespace slipface::doctor {
namespace {

constexpr double thinnest = 1.0 / 1000.0;  // height of a triangle as a fraction of its longest edge

std::array<Vec3f, 3> corners_of(const Mesh& mesh, TriangleId triangle) {
    const auto& corners = mesh.triangles[triangle];
    return {mesh.corner_position(corners[0]), mesh.corner_position(corners[1]),
            mesh.corner_position(corners[2])};
}

Box box_of(const std::array<Vec3f, 3>& c) {
    return {c[0].cwiseMin(c[1]).cwiseMin(c[2]), c[0].cwiseMax(c[1]).cwiseMax(c[2])};
}

// The triangles, of similar size and near each other one after the other. Sizes are apart so that no large
// triangle stands in a block of small ones, which would be looked at wherever the large one is.
std::vector<NearItem> sorted(const Mesh& mesh) {
    constexpr std::size_t sizes = 64;
    const std::size_t count = mesh.triangle_count();
    std::vector<NearItem> items(count), spare(count);
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
    for (const NearItem& item : spare)
        ++begin[item.key + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    auto next = begin;
    for (const NearItem& item : spare)
        items[next[item.key]++] = item;
    for (std::size_t i = 0; i < sizes; ++i)
        sort_near(std::span(items).subspan(begin[i], begin[i + 1] - begin[i]), spare, centre);
    return items;
}

void fill(TriangleBlock& block, const Mesh& mesh, std::span<const NearItem> items) {
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
        const double area = cross.norm();
        const double size = longest_edge({a, b, c});
        block.thin[lane] = int{!(area > thinnest * size * size)};
        const Vec3f normal = (cross / area).cast<float>();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            block.centre[axis][lane] = centre[static_cast<int>(axis)];
            block.normal[axis][lane] = normal[static_cast<int>(axis)];
        }
    }
    block.lowest = *std::min_element(block.id.begin(), block.id.end());
}

}  // namespace

TriangleBlocks::TriangleBlocks(const Mesh& mesh) {
    if (mesh.triangle_count() == 0) return;
    const std::vector<NearItem> items = sorted(mesh);
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
