// Whether the tree of a world is what queries rely on: every triangle in one leaf, with its corners, in boxes
// that fit.
#pragma once

#include <fmt/format.h>

#include "impl.h"

namespace slipface::scenes {

// Empty if all is well, else what is wrong. `soup`: the triangles as they are now.
class SoundTree {
  public:
    SoundTree(const detail::Bvh& bvh, const TriangleSoup& soup)
        : bvh_(bvh), soup_(soup), seen_(soup.triangles.size()) {}

    std::string fault() {
        if (seen_.empty()) return bvh_.nodes.empty() ? "" : "nodes without triangles";
        const Box all = check_node(0, 0, 1);
        for (std::size_t axis = 0; axis < 3; ++axis)
            require(all.low[axis] == bvh_.low[axis] && all.high[axis] == bvh_.high[axis], "bounds");
        require(nodes_ == bvh_.nodes.size(), "nodes that are not in the tree");
        require(depth_ <= bvh_.depth && depth_ <= detail::max_depth, "depth");
        const auto lost = static_cast<std::size_t>(std::ranges::count(seen_, false));
        require(lost == 0, fmt::format("{} triangles in no leaf", lost));
        return fault_;
    }

  private:
    struct Box {
        std::array<float, 3> low{HUGE_VALF, HUGE_VALF, HUGE_VALF};
        std::array<float, 3> high{-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};
        void add(const Box& other) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], other.low[axis]);
                high[axis] = std::max(high[axis], other.high[axis]);
            }
        }
    };

    void require(bool holds, const std::string& what) {
        if (!holds && fault_.empty()) fault_ = what;
    }

    Box check_node(std::uint32_t index, std::uint32_t parent, int level) {
        ++nodes_;
        depth_ = std::max(depth_, level);
        Box all;
        if (nodes_ > bvh_.nodes.size() || level > detail::max_depth) {
            require(false, "a node has two parents");
            return all;
        }
        if (!bvh_.parents.empty())
            require(bvh_.parents[index] == parent, fmt::format("parent of node {}", index));
        const detail::BvhNode& node = bvh_.nodes[index];
        for (std::size_t k = 0; k < 8; ++k) {
            if (is_missing(node, k)) continue;
            const std::uint32_t child = node.child[k];
            const Box box = (child & detail::leaf_bit) != 0
                                ? check_leaf(child & detail::leaf_index_mask, index)
                                : check_node(child, index, level + 1);
            for (std::size_t axis = 0; axis < 3; ++axis)
                require(box.low[axis] == node.bound[axis][k] && box.high[axis] == node.bound[axis + 3][k],
                        fmt::format("box of child {} of node {}", k, index));
            all.add(box);
        }
        return all;
    }

    Box check_leaf(std::uint32_t index, std::uint32_t parent) {
        const detail::Leaf& leaf = bvh_.leaf_at(index);
        if (!bvh_.parents.empty()) {
            const auto above =
                std::ranges::lower_bound(bvh_.leaf_parents, index, {}, &detail::Bvh::LeafParent::leaf);
            require(above != bvh_.leaf_parents.end() && above->leaf == index && above->parent == parent,
                    fmt::format("parent of leaf {}", index));
        }
        require(leaf_size(leaf) >= 1 && leaf_size(leaf) <= detail::leaf_capacity, "triangles of a leaf");
        Box all;
        for (std::size_t lane = 0; lane < leaf_size(leaf); ++lane) {
            const detail::LeafTriangle triangle = leaf_triangle(leaf, lane);
            if (triangle.id >= seen_.size()) {
                require(false, fmt::format("triangle number {}", triangle.id));
                continue;
            }
            require(!seen_[triangle.id], fmt::format("triangle {} is in two places", triangle.id));
            seen_[triangle.id] = true;
            require(bvh_.leaf_of[triangle.id] == index && lane_of(leaf, triangle.id) == lane,
                    fmt::format("place of triangle {}", triangle.id));
            require(soup_.bodies.empty() || soup_.bodies[triangle.id] == soup_.bodies[leaf_id(leaf, 0)],
                    fmt::format("two bodies in leaf {}", index));
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const float at = soup_.positions[soup_.triangles[triangle.id][k]][static_cast<int>(axis)];
                    require(triangle.at[axis][k] == at, fmt::format("corner of triangle {}", triangle.id));
                    all.low[axis] = std::min(all.low[axis], at);
                    all.high[axis] = std::max(all.high[axis], at);
                }
            }
        }
        return all;
    }

    const detail::Bvh& bvh_;
    const TriangleSoup& soup_;
    std::vector<bool> seen_;
    std::size_t nodes_ = 0;
    int depth_ = 0;
    std::string fault_;
};

}  // namespace slipface::scenes
