// What a search has reached: cells, each with the state that came there fastest and the inputs that led to
// it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slipface/reach/press.h"

namespace slipface {

using NodeId = std::uint32_t;  // index into ReachArchive::nodes

// A state that was reached. Nodes never change what led to them: a faster way to a cell is another node.
struct ReachNode {
    PlayerState state;
    std::uint64_t cell = 0;            // cell_key(); which states count as the same
    NodeId parent = no_id;             // no_id: the start
    std::uint32_t tick = 0;            // since the start
    std::uint32_t first_press = 0;     // the inputs from the parent to here: presses[first_press] ...
    std::uint16_t press_count = 0;     // ... so many
    std::uint16_t visits : 13 = 0;     // how often roll-outs began here
    std::uint16_t superseded : 1 = 0;  // another node is faster in its cell
    std::uint16_t returns : 1 = 0;     // from here the start was reached again
    std::uint16_t is_cell : 1 = 0;     // stands for its cell; else it only proves that a face was reached
};
static_assert(sizeof(ReachNode) - sizeof(PlayerState) <= 32);

class ReachArchive {
  public:
    std::vector<ReachNode> nodes;
    std::vector<Press> presses;

    NodeId find(std::uint64_t cell) const;  // the node that stands for the cell, or no_id
    // The last of a way. Makes it the cell's node if the cell is new or its node slower.
    NodeId add(ReachNode node, std::span<const Press> inputs);
    void rebuild_index();  // after `nodes` was filled by hand
    std::size_t cell_count() const { return cells_; }

    // From `from` the player came into `to`'s cell. A player that reaches a node that returns can return.
    void add_edge(NodeId from, NodeId to);
    void mark_returning(NodeId node);

    // All inputs from the start to `node`, the first ones first.
    std::vector<Press> way_to(NodeId node) const;
    std::size_t bytes() const;  // of memory

    // Edges between nodes that are not known to lead back to the start: for each node a list.
    struct Edge {
        NodeId from = no_id;
        std::uint32_t next = no_id;  // index into edges
    };
    std::vector<Edge> edges;
    std::uint32_t free_edge = no_id;        // the first of those that are used no more
    std::vector<std::uint32_t> first_edge;  // [node] of those that lead to it

  private:
    void index(NodeId node);
    std::size_t next(std::size_t place) const { return place + 1 < table_.size() ? place + 1 : 0; }

    std::vector<std::uint64_t> table_;  // lower half of the cell's key, then node + 1; 0 is empty
    std::size_t cells_ = 0;
};

}  // namespace slipface
