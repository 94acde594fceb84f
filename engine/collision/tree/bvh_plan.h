// A binary tree over the triangles, and how it becomes nodes of eight children and leaves of up to eight
// triangles. A query tests the eight boxes of a node, or the eight triangles of a leaf, at once, so both cost
// the same however full they are; the plan is the one in which queries visit the fewest (H. Ylitie, T.
// Karras, S. Laine, "Efficient incoherent ray traversal on GPUs through compressed wide BVHs", 2017).
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

struct alignas(64) BinaryNode {
    std::array<BinaryNode*, 2> half;  // null: not divided
    BinaryNode* parent;               // null: the first
    float min[3];
    std::uint32_t first;  // of its items
    float max[3];
    std::uint32_t count;
    // [slots - 2] how many of two to eight slots the first half gets; 0: one slot, as a node or leaf of its
    // own.
    std::array<std::uint8_t, 7> left;
    bool fits_leaf : 1;
    std::uint8_t height : 7;  // levels of nodes below it; set while nodes are moved (bvh_moves.h)

    bool divided() const { return half[0] != nullptr; }
    void set_box(const Box& box) {
        alignas(16) float corner[4];
        box.min.store(corner);
        std::copy_n(corner, 3, min);
        box.max.store(corner);
        std::copy_n(corner, 3, max);
    }
};
static_assert(sizeof(BinaryNode) == 64);

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

    // Adds a node that is not divided.
    BinaryNode& add(const Box& box, std::uint32_t first, std::uint32_t count, bool fits_leaf) {
        if (next_ == end_) {
            next_ = blocks_.add();
            end_ = next_ + BinaryBlocks::size;
        }
        BinaryNode& node = *next_++;
        node.half = {};
        node.parent = nullptr;
        node.set_box(box);
        node.first = first;
        node.count = count;
        node.fits_leaf = fits_leaf;
        return node;
    }

  private:
    BinaryBlocks& blocks_;
    BinaryNode* next_ = nullptr;
    BinaryNode* end_ = nullptr;
};

// How often queries reach a box, in cubic metres: where the centre of a body of about a metre can be for it
// to touch the box before it has moved by two metres. That is the volume of the box with the body around it,
// and the move times its area as seen from there, a quarter of its surface on average. Rays alone would count
// surfaces, but most bodies are in the middle of a room when they move.
inline float reached(const Box& box) {
    const Four body = Four::all(1.0F);
    alignas(16) float d[4];
    (box.max - box.min + body).store(d);
    return d[0] * d[1] * d[2] + (d[0] * d[1] + d[1] * d[2] + d[2] * d[0]);
}
// A leaf also takes memory, which must be worth it.
inline constexpr float leaf_worth = 16.0F;
inline float leaf_cost(const Box& box) {
    return reached(box) + leaf_worth;
}

// [slots] what queries visit of a binary node that gets one to eight slots of the node above it.
using Plan = std::array<float, 9>;

inline Plan plan_of_leaf(const Box& box) {
    Plan plan;
    plan.fill(leaf_cost(box));
    return plan;
}

// The plan of a node by those of its halves.
inline Plan planned(BinaryNode& node, const Plan& first, const Plan& second) {
    Plan plan{};
    for (std::size_t slots = 2; slots <= 8; ++slots) {
        std::size_t best = 1;
        for (std::size_t left = 2; left < slots; ++left) {
            if (first[left] + second[slots - left] < first[best] + second[slots - best]) best = left;
        }
        plan[slots] = first[best] + second[slots - best];
        node.left[slots - 2] = static_cast<std::uint8_t>(best);
    }
    plan[1] = node.fits_leaf ? leaf_cost(box_of(node)) : reached(box_of(node)) + plan[8];
    for (std::size_t slots = 2; slots <= 8; ++slots) {
        // A node has the eight slots below it.
        if (plan[slots] < plan[1] || (slots == 8 && !node.fits_leaf)) continue;
        plan[slots] = plan[1];
        node.left[slots - 2] = 0;
    }
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
    if (!node.divided() || slots == 1 || node.left[slots - 2] == 0) {
        parts.part[parts.count] = &node;
        parts.box[parts.count] = box_of(node);
        parts.size[parts.count++] = node.count;
        return;
    }
    const std::size_t left = node.left[slots - 2];
    take_parts(*node.half[0], left, parts);
    take_parts(*node.half[1], slots - left, parts);
}

}  // namespace slipface::detail
