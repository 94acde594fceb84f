// Finds the platforms near a place among many.
#pragma once

#include <span>
#include <vector>

#include "slipface/base/types.h"

namespace slipface {

// A tree of boxes, one for each platform. Its shape stays; its boxes follow the platforms.
class PlatformTree {
  public:
    // `places`: [platform] where it is, or may be at any time; an empty one counts as the origin.
    void build(std::span<const Aabb> places);
    // `rooms`: [platform] the box of its whole tick; as many as build() was given. Allocates nothing.
    void refit(std::span<const Aabb> rooms);
    // The same for one platform alone.
    void move(std::uint32_t platform, const Aabb& room);

    // Calls visit(platform) for those whose rooms touch `box`, in the order of the tree.
    template <class Visit>
    void visit(const Aabb& box, Visit&& visit) const {
        for (std::size_t i = 0; i < nodes_.size();) {
            const Node& node = nodes_[i];
            const bool apart = (node.box.min.array() > box.max.array()).any() ||
                               (node.box.max.array() < box.min.array()).any();
            if (!apart && node.platform != no_id) visit(node.platform);
            i = apart ? node.next : i + 1;
        }
    }

  private:
    // Before its children, which are at the next index and at the `next` of that one.
    struct Node {
        Aabb box;
        std::uint32_t platform = no_id;  // of a leaf
        std::uint32_t next = 0;          // after all nodes below this one
        std::uint32_t parent = 0;        // the root's own
    };
    void add(std::span<std::uint32_t> platforms, std::span<const Aabb> places, std::size_t parent);
    void unite(std::size_t node);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> leaf_;  // [platform]
};

}  // namespace slipface
