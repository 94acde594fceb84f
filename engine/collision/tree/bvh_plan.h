// A binary tree over the triangles, and how its inner nodes are given to nodes of eight children. A query
// tests the eight boxes of a node at once, so a node costs the same however many children it has; the plan is
// the one in which queries visit the fewest nodes (H. Ylitie, T. Karras, S. Laine, "Efficient incoherent ray
// traversal on GPUs through compressed wide BVHs", 2017).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "tree/bvh_items.h"
#include "tree/bvh_layout.h"

namespace slipface::detail {

struct BinaryNode {
    std::array<BinaryNode*, 2> half;  // null for a leaf
    float min[3];
    float max[3];
    std::uint32_t first;  // of its items
    std::uint32_t count;
    // [slots - 2] how many of two to eight slots the first half gets; 0: one slot, as a node of its own.
    std::array<std::uint8_t, 7> left;

    bool is_leaf() const { return half[0] == nullptr; }
    Box box() const { return {Four::of(min[0], min[1], min[2]), Four::of(max[0], max[1], max[2])}; }
};

// Memory for nodes of many tasks.
class BinaryBlocks {
  public:
    static constexpr std::size_t size = 128;

    BinaryNode* add() {
        auto block = std::make_unique_for_overwrite<BinaryNode[]>(size);
        const std::scoped_lock lock(mutex_);
        return blocks_.emplace_back(std::move(block)).get();
    }

  private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<BinaryNode[]>> blocks_;
};

// The nodes of one task.
class BinaryNodes {
  public:
    explicit BinaryNodes(BinaryBlocks& blocks) : blocks_(blocks) {}

    // Adds a leaf.
    BinaryNode& add(const Box& box, std::uint32_t first, std::uint32_t count) {
        if (next_ == end_) {
            next_ = blocks_.add();
            end_ = next_ + BinaryBlocks::size;
        }
        BinaryNode& node = *next_++;
        node.half = {};
        alignas(16) float corner[4];
        box.min.store(corner);
        std::copy_n(corner, 3, node.min);
        box.max.store(corner);
        std::copy_n(corner, 3, node.max);
        node.first = first;
        node.count = count;
        return node;
    }

  private:
    BinaryBlocks& blocks_;
    BinaryNode* next_ = nullptr;
    BinaryNode* end_ = nullptr;
};

// [slots] the area of all nodes below a binary node that gets one to eight slots of the node above it.
using Plan = std::array<float, 9>;

// A query that moves a body of about a metre reaches a small box almost as often as one that is smaller
// still, so boxes count with such a body around them.
inline float visited_area(const Box& box) {
    const Four half = Four::of(0.5F, 0.5F, 0.5F);
    return Box{box.min - half, box.max + half}.area();
}

// The plan of a node by those of its halves.
inline Plan planned(BinaryNode& node, const Plan& first, const Plan& second) {
    Plan plan{};
    plan[1] = visited_area(node.box());
    node.left.fill(1);
    if (node.half[0]->is_leaf() && node.half[1]->is_leaf()) return plan;
    for (std::size_t slots = 8; slots >= 2; --slots) {
        // A leaf needs one slot.
        const std::size_t least = node.half[1]->is_leaf() ? slots - 1 : 1;
        const std::size_t most = node.half[0]->is_leaf() ? 1 : slots - 1;
        std::size_t best = least;
        for (std::size_t left = least + 1; left <= most; ++left) {
            if (first[left] + second[slots - left] < first[best] + second[slots - best]) best = left;
        }
        plan[slots] = first[best] + second[slots - best];
        node.left[slots - 2] = static_cast<std::uint8_t>(best);
    }
    plan[1] += plan[8];
    for (std::size_t slots = 2; slots <= 8; ++slots) {
        if (plan[slots] < plan[1] || slots == 8) continue;
        plan[slots] = plan[1];
        node.left[slots - 2] = 0;
    }
    plan[8] = plan[8] < plan[1] ? plan[8] : plan[1];
    return plan;
}

// What becomes the children of a node, ordered by their items.
struct Parts {
    std::array<const BinaryNode*, 8> part;
    std::array<Box, 8> box;
    std::array<std::uint32_t, 8> size;  // triangles
    std::uint32_t count = 0;

    // The leaf takes in the next one.
    void join_next(std::uint32_t leaf, const Box& both) {
        box[leaf] = both;
        size[leaf] += size[leaf + 1];
        --count;
        for (std::uint32_t i = leaf + 1; i < count; ++i) {
            part[i] = part[i + 1];
            box[i] = box[i + 1];
            size[i] = size[i + 1];
        }
    }
};

// Divides a node among slots by its plan.
inline void take_parts(const BinaryNode& node, std::size_t slots, Parts& parts) {
    if (node.is_leaf() || slots == 1 || node.left[slots - 2] == 0) {
        parts.part[parts.count] = &node;
        parts.box[parts.count] = node.box();
        parts.size[parts.count++] = node.count;
        return;
    }
    const std::size_t left = node.left[slots - 2];
    take_parts(*node.half[0], left, parts);
    take_parts(*node.half[1], slots - left, parts);
}

}  // namespace slipface::detail
