// The bodies of a crowd that are near each other.
#pragma once

#include <span>
#include <vector>

#include "slipface/base/types.h"

namespace slipface {

// Cells of a grid, in a table by the hash of the cell: no axis comes first, and where the bodies are does not
// matter. A body lies in the grid whose cells are at least as large as its room; larger bodies have grids of
// their own, each of twice the edge.
class NearBodies {
  public:
    // A body touches up to some twelve of its size. In a pile the rest comes later.
    static constexpr std::size_t most = 16;

    // `rooms`: [body] the box of all places of its tick. `places`: the order of what of() returns goes by
    // them, then by the number of the body.
    void find(std::span<const Aabb> rooms, std::span<const Vec3> places);
    // Those whose rooms touch the body's; in a pile `most` of them, and then one may list the other alone.
    std::span<const std::uint32_t> of(std::size_t body) const { return lists_[body]; }

  private:
    struct Cell {
        std::int32_t x, y, z, level;
        friend bool operator==(const Cell&, const Cell&) = default;
    };
    struct Level {
        int level;
        Vec3 reach;  // from a body's middle to the end of the largest room
    };
    Vec3 edge(int level) const;
    Cell cell_of(const Vec3& at, int level) const;
    std::size_t bucket(const Cell& cell) const;
    void list(std::uint32_t body, std::span<const Aabb> rooms);
    void add(std::uint32_t body, std::uint32_t other) {
        if (lists_[body].size() < most) lists_[body].push_back(other);
    }

    Vec3 least_ = Vec3::Ones();                      // edges of the smallest cells, m
    std::vector<Level> levels_;                      // that have bodies
    std::vector<Cell> cells_;                        // [body]
    std::vector<std::uint32_t> starts_, bodies_;     // [bucket] where its bodies begin, and those
    std::vector<std::vector<std::uint32_t>> lists_;  // [body]
};

// Numbers of the places in an order in which near ones mostly follow each other.
std::vector<std::uint32_t> spatial_order(std::span<const Vec3> places);

}  // namespace slipface
