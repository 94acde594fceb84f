// Triangles in blocks of eight, to find all whose boxes touch.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "boxes.h"
#include "slipface/mesh/mesh.h"

namespace slipface::doctor {

// Of a triangle, metres.
inline double longest_edge(const std::array<Vec3, 3>& c) {
    return std::sqrt(
        std::max({(c[1] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm()}));
}

// Triangles near each other and of about one size. Rounded: good for a first look.
struct TriangleBlock {
    Boxes boxes;
    std::array<Lanes, 3> centre{};  // mean of a triangle's corners
    std::array<Lanes, 3> normal{};  // unit; not finite for a triangle without area
    LaneMask thin{};                // the triangle is so thin that it has no plane
    std::array<TriangleId, lanes> id;
    std::size_t count = 0;  // lanes in use; the other ids are no_id
    Box around;
    TriangleId lowest = no_id;  // of the ids
};

// Eight blocks near each other, or eight groups of them.
struct BlockGroup {
    Boxes boxes;
    std::array<TriangleId, lanes> lowest_of{};  // of the triangles in each
    Box around;
    TriangleId lowest = no_id;

    void add(std::size_t lane, const Box& box, TriangleId lowest_there) {
        boxes.set(lane, box);
        around.add(box.min, box.max);
        lowest_of[lane] = lowest_there;
        lowest = std::min(lowest, lowest_there);
    }
};

class TriangleBlocks {
  public:
    explicit TriangleBlocks(const Mesh& mesh);

    std::size_t group_count() const { return levels_.empty() ? 0 : levels_.front().size(); }
    const BlockGroup& group(std::size_t index) const { return levels_.front()[index]; }
    std::span<const TriangleBlock> blocks_of(std::size_t group) const {
        return std::span(blocks_).subspan(group * lanes, std::min(lanes, blocks_.size() - group * lanes));
    }

    // Calls visit(index) for the groups whose boxes touch `box` and that have a triangle below `limit`. What
    // visit returns is the limit from then on.
    template <class Visit>
    void each_group_touching(const Box& box, TriangleId limit, Visit visit) const {
        struct Open {
            std::size_t level, node;
        };
        std::array<Open, max_levels * lanes> open;
        std::size_t count = 0;
        if (!levels_.empty()) open[count++] = {levels_.size() - 1, 0};
        while (count > 0) {
            const Open at = open[--count];
            if (at.level == 0) {
                limit = visit(at.node);
                continue;
            }
            const BlockGroup& group = levels_[at.level][at.node];
            const std::size_t first = count;
            each_bit(bits_of(group.boxes.touching(box)), [&](std::size_t lane) {
                if (group.lowest_of[lane] < limit) open[count++] = {at.level - 1, at.node * lanes + lane};
            });
            std::reverse(open.begin() + first, open.begin() + count);
        }
    }

  private:
    static constexpr std::size_t max_levels = 11;  // 8^11 blocks are more than there are numbers of triangles

    std::vector<TriangleBlock> blocks_;
    std::vector<std::vector<BlockGroup>> levels_;  // the last has one
};

}  // namespace slipface::doctor
