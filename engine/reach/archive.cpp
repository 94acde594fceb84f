#include "slipface/reach/archive.h"

#include <algorithm>
#include <utility>

namespace slipface {
namespace {

// An entry of the table: the lower half of the cell's key, then the node. The upper half says where it
// stands.
constexpr std::uint64_t entry_of(std::uint64_t cell, NodeId node) {
    return (cell << 32) | (node + std::uint64_t{1});
}
constexpr NodeId node_of(std::uint64_t entry) {
    return static_cast<NodeId>((entry & 0xffffffffULL) - 1);
}
constexpr std::size_t place_of(std::uint64_t cell, std::size_t places) {
    return static_cast<std::size_t>(((cell >> 32) * places) >> 32);
}

// An edge that finds no room is found again by a later visit. docs/reach.md has what more of them cost and
// give.
constexpr std::size_t max_edges_per_node = 4;

}  // namespace

NodeId ReachArchive::find(std::uint64_t cell) const {
    if (table_.empty()) return no_id;
    for (std::size_t at = place_of(cell, table_.size()); table_[at] != 0; at = next(at)) {
        const NodeId node = node_of(table_[at]);
        if (table_[at] == entry_of(cell, node) && nodes[node].cell == cell) return node;
    }
    return no_id;
}

void ReachArchive::index(NodeId node) {
    if (4 * (cells_ + 1) > 3 * table_.size()) {
        std::vector<std::uint64_t> old(std::max<std::size_t>(1024, table_.size() + table_.size() / 2), 0);
        old.swap(table_);
        cells_ = 0;
        for (const std::uint64_t entry : old)
            if (entry != 0) index(node_of(entry));
    }
    const std::uint64_t cell = nodes[node].cell;
    std::size_t at = place_of(cell, table_.size());
    for (; table_[at] != 0; at = next(at)) {
        const NodeId known = node_of(table_[at]);
        if (nodes[known].cell != cell) continue;
        nodes[known].superseded = 1;
        table_[at] = entry_of(cell, node);
        return;
    }
    table_[at] = entry_of(cell, node);
    ++cells_;
}

void ReachArchive::rebuild_index() {
    table_.clear();
    cells_ = 0;
    for (NodeId node = 0; node < nodes.size(); ++node)
        if (nodes[node].is_cell && !nodes[node].superseded) index(node);
}

NodeId ReachArchive::add(ReachNode node, std::span<const Press> inputs) {
    node.first_press = static_cast<std::uint32_t>(presses.size());
    node.press_count = static_cast<std::uint16_t>(inputs.size());
    presses.insert(presses.end(), inputs.begin(), inputs.end());
    const auto id = static_cast<NodeId>(nodes.size());
    const NodeId before = find(node.cell);
    node.is_cell = before == no_id || node.tick < nodes[before].tick;
    nodes.push_back(node);
    first_edge.push_back(no_id);
    if (node.is_cell) index(id);
    if (node.returns) {
        nodes[id].returns = 0;
        mark_returning(id);
    }
    // States of one cell can do the same: that is what cells are for.
    if (before != no_id) {
        add_edge(id, before);
        add_edge(before, id);
    }
    return id;
}

void ReachArchive::add_edge(NodeId from, NodeId to) {
    if (nodes[from].returns || from == to) return;
    if (nodes[to].returns) return mark_returning(from);
    std::size_t count = 0;
    const bool same_cell = nodes[from].cell == nodes[to].cell;
    for (std::uint32_t at = first_edge[to]; at != no_id && !same_cell; at = edges[at].next)
        if (edges[at].from == from || ++count >= max_edges_per_node) return;
    std::uint32_t edge = free_edge;
    if (edge == no_id) {
        edge = static_cast<std::uint32_t>(edges.size());
        edges.emplace_back();
    } else {
        free_edge = edges[edge].next;
    }
    edges[edge] = {from, first_edge[to]};
    first_edge[to] = edge;
}

void ReachArchive::mark_returning(NodeId node) {
    std::vector<NodeId> open{node};
    while (!open.empty()) {
        const NodeId at = open.back();
        open.pop_back();
        if (nodes[at].returns) continue;
        nodes[at].returns = 1;
        if (nodes[at].parent != no_id) open.push_back(nodes[at].parent);
        for (std::uint32_t edge = first_edge[at]; edge != no_id;) {
            open.push_back(edges[edge].from);
            const std::uint32_t next = std::exchange(edges[edge].next, free_edge);
            free_edge = std::exchange(edge, next);
        }
        first_edge[at] = no_id;
    }
}

std::vector<Press> ReachArchive::way_to(NodeId node) const {
    std::vector<NodeId> chain;
    for (; node != no_id; node = nodes[node].parent)
        chain.push_back(node);
    std::vector<Press> motion;
    for (std::size_t i = chain.size(); i-- > 0;) {
        const ReachNode& one = nodes[chain[i]];
        const auto first = presses.begin() + one.first_press;
        motion.insert(motion.end(), first, first + one.press_count);
    }
    return motion;
}

std::size_t ReachArchive::bytes() const {
    return nodes.size() * (sizeof(ReachNode) + sizeof(std::uint32_t)) + presses.size() * sizeof(Press) +
           table_.size() * sizeof(std::uint64_t) + edges.size() * sizeof(Edge);
}

}  // namespace slipface
