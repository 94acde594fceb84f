// Top-down construction of a binary tree by cost: each range of triangles is split in two, in tasks. Nodes
// are moved to better places (bvh_moves.h), and the cheapest way to give the inner ones to nodes of eight
// children is planned from below (bvh_plan.h). Afterwards memory is assigned in a fixed order, and nodes and
// leaves are written in parallel. No step depends on the order of the tasks. Items are many and large: a list
// of them ends as soon as another takes its place, and of a leaf's items only the numbers of the triangles
// stay.

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>

#include "slipface/base/parallel.h"
#include "tree/bvh.h"
#include "tree/bvh_cells.h"
#include "tree/bvh_moves.h"
#include "tree/bvh_plan.h"
#include "tree/bvh_split.h"
#include "tree/pack_leaf.h"

namespace slipface::detail {
namespace {

constexpr std::uint32_t parallel_grain = 4096;
constexpr std::uint32_t cells_from = 8192;  // triangles
// Lists of items by cell that may wait for each other: clutter in clutter in a landscape. Each takes as much
// memory as its items.
constexpr int max_lists = 3;

struct Range {
    std::uint32_t first = 0;  // in the order of the tree
    std::uint32_t count = 0;
    Item* items = nullptr;  // unset while the range has cells
    ItemList own_items;     // if no range around it has them
    int depth = 0;          // of the binary tree
    bool mixed = false;     // more than one body
    int lists = 0;          // of cells in which it or a range around it was sorted
    // At least cells_worth_it cells, as long as the items are those of a list sorted by cell.
    std::span<Cell> cells;
    const Item* by_cell = nullptr;  // that list
    Box box;                        // of the items
    Box centres;                    // of the items' centres, or the cells'
};

// What is kept of a range once it is divided. There are many of these at the end, so they are small.
struct Node;
struct Child {
    float min[3] = {HUGE_VALF, HUGE_VALF, HUGE_VALF};
    float max[3] = {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};
    std::uint32_t link = 0;          // as BvhNode::child
    std::uint16_t bytes = 0;         // of a leaf
    std::uint16_t bytes_before = 0;  // its head
    std::unique_ptr<Node> node;      // null for a leaf
};
struct Node {
    std::array<Child, 8> children;
    std::uint32_t count = 0;
    std::uint32_t index = 0;
    std::uint32_t leaf_bytes = 0;
    std::unique_ptr<std::byte[]> leaves;  // of the children that are leaves, one after the other
};

// What leaves are made of.
struct Source {
    std::span<const Vec3f> positions;
    std::span<const std::array<std::uint32_t, 3>> triangles;
    std::span<const std::uint32_t> bodies;
    LeafForm form;

    std::uint32_t body(std::uint32_t triangle) const { return bodies.empty() ? 0 : bodies[triangle]; }
};

std::span<Item> items_of(const Range& range) {
    return {range.items, range.count};
}

// Computes the boxes of the items and whether they belong to several bodies.
void measure(Range& range) {
    range.box = Box();
    range.centres = Box();
    range.mixed = false;
    for (const Item& item : items_of(range)) {
        range.box.add(box_of(item));
        range.centres.add(centre_of(item));
        range.mixed = range.mixed || item.body != range.items->body;
    }
}

// All triangles.
Range whole(const Source& source) {
    Range range;
    range.count = static_cast<std::uint32_t>(source.triangles.size());
    range.own_items = ItemList(range.count);
    range.items = range.own_items.begin();
    parallel_for(range.count, parallel_grain, [&](std::size_t begin, std::size_t end) {
        for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
            Item& item = range.items[i];
            const Vec3f& a = source.positions[source.triangles[i][0]];
            const Vec3f& b = source.positions[source.triangles[i][1]];
            const Vec3f& c = source.positions[source.triangles[i][2]];
            for (int axis = 0; axis < 3; ++axis) {
                item.min[axis] = std::min(std::min(a[axis], b[axis]), c[axis]);
                item.max[axis] = std::max(std::max(a[axis], b[axis]), c[axis]);
            }
            item.triangle = i;
            item.body = source.body(i);
        }
    });
    measure(range);
    return range;
}

class Builder {
  public:
    explicit Builder(const Source& source) : source_(source) {}

    // The tree over all triangles.
    std::unique_ptr<Node> build(Range all) {
        const std::uint32_t count = all.count;
        order_ = std::make_unique_for_overwrite<std::uint32_t[]>(count);
        BinaryNodes nodes(blocks_);
        BinaryNode& top = *divide_up(std::move(all), nodes);
        // A leaf has one body, so the nodes of several stay apart.
        if (source_.bodies.empty()) move_nodes(top);
        const auto as_divided = std::exchange(order_, std::make_unique_for_overwrite<std::uint32_t[]>(count));
        plan_up(top, 0, as_divided.get());
        return collapse(top);
    }

  private:
    static bool fits_leaf(const Range& range) { return range.count <= leaf_capacity && !range.mixed; }
    // True if two leaves may be worth more than one: neither is likely to be smaller than the largest
    // triangle.
    static bool worth_dividing(const Range& range) {
        if (range.count < 3 || range.depth >= cost_split_depth) return false;
        const float half = 0.5F * (reached(range.box) - leaf_worth);
        for (const Item& item : items_of(range)) {
            if (!(reached(box_of(item)) < half)) return false;
        }
        return true;
    }

    // The binary tree over a range.
    BinaryNode* divide_up(Range range, BinaryNodes& nodes) {
        if (!range.cells.empty() && range.cells.size() < cells_worth_it) collect_items(range);
        BinaryNode& node = nodes.add(range.box, range.first, range.count, fits_leaf(range));
        if (node.fits_leaf && !worth_dividing(range)) {
            for (std::uint32_t i = 0; i < range.count; ++i)
                order_[range.first + i] = range.items[i].triangle;
            return &node;
        }
        // Clutter in a wide landscape fills few cells of it and gets cells of its own, while items beside it
        // still wait in the list of the landscape's.
        std::vector<Cell> cells;
        ItemList by_cell;
        if (range.count >= cells_from && !range.mixed && range.cells.empty() && range.lists < max_lists) {
            by_cell = ItemList(range.count);
            cells = sort_into_cells(items_of(range), range.centres, {by_cell.begin(), range.count});
            if (cells.empty()) {
                by_cell = {};
            } else {
                range.centres = Box();
                for (const Cell& cell : cells)
                    range.centres.add(centre_of(cell));
                range.cells = cells;
                range.by_cell = by_cell.begin();
                range.own_items = {};
                ++range.lists;
            }
        }
        std::array<Range, 2> half;
        half[0] = divide(range, half[1]);
        half[0].lists = half[1].lists = range.lists;
        if (range.count < parallel_grain) {
            for (std::size_t i = 0; i < 2; ++i)
                node.half[i] = divide_up(std::move(half[i]), nodes);
        } else {
            parallel_for(2, 1, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    BinaryNodes own(blocks_);
                    node.half[i] = divide_up(std::move(half[i]), own);
                }
            });
        }
        for (BinaryNode* one : node.half)
            one->parent = &node;
        lists_.give_back(std::move(range.own_items));
        return &node;
    }

    // How a node is best cut into nodes of eight children. Its triangles, which `as_divided` has where they
    // were before nodes were moved, are stored from `first` on.
    Plan plan_up(BinaryNode& node, std::uint32_t first, const std::uint32_t* as_divided) {
        const std::uint32_t from = std::exchange(node.first, first);
        if (!node.divided()) {
            std::copy_n(as_divided + from, node.count, &order_[first]);
            return plan_of_leaf(box_of(node));
        }
        std::array<Plan, 2> plans{};
        const auto plan_halves = [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                plans[i] = plan_up(*node.half[i], i == 0 ? first : first + node.half[0]->count, as_divided);
        };
        if (node.count < parallel_grain) {
            plan_halves(0, 2);
        } else {
            parallel_for(2, 1, plan_halves);
        }
        return planned(node, plans[0], plans[1]);
    }

    // The node of eight children that `top` becomes, by its plan, and those below it.
    std::unique_ptr<Node> collapse(const BinaryNode& top) {
        Parts parts;
        take_parts(top, 8, parts);
        join_leaves(parts);
        auto node = std::make_unique<Node>();
        node->count = parts.count;
        pack_leaves(parts, *node);
        const auto finish = [&](std::size_t i) {
            const BinaryNode& part = *parts.part[i];
            Child& child = node->children[i];
            alignas(16) float corner[4];
            parts.box[i].min.store(corner);
            std::copy_n(corner, 3, child.min);
            parts.box[i].max.store(corner);
            std::copy_n(corner, 3, child.max);
            if (!part.fits_leaf) child.node = collapse(part);
        };
        if (top.count < parallel_grain) {
            for (std::uint32_t i = 0; i < node->count; ++i)
                finish(i);
        } else {
            parallel_for(node->count, 1, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i)
                    finish(i);
            });
        }
        return node;
    }

    // Two neighbouring leaves become one if that makes a visit less likely.
    void join_leaves(Parts& parts) const {
        for (std::uint32_t i = 0; i + 1 < parts.count;) {
            Box both = parts.box[i];
            both.add(parts.box[i + 1]);
            const BinaryNode &part = *parts.part[i], &next = *parts.part[i + 1];
            if (!part.fits_leaf || !next.fits_leaf || parts.size[i] + parts.size[i + 1] > leaf_capacity ||
                body_of(part) != body_of(next) ||
                leaf_cost(both) > leaf_cost(parts.box[i]) + leaf_cost(parts.box[i + 1])) {
                ++i;
                continue;
            }
            parts.join_next(i, both);
        }
    }

    // Divides the items of a range; returns the left part.
    Range divide(Range& range, Range& right) {
        Range left;
        if (!range.cells.empty()) {
            if (divide_by_cost(range, range.cells, left, right)) return left;
            collect_items(range);
        }
        if (!range.mixed && divide_by_cost(range, items_of(range), left, right)) return left;
        left.first = range.first;
        left.items = range.items;
        left.count = range.mixed ? part_bodies(range) : halve(range);
        right.first = range.first + left.count;
        right.items = range.items + left.count;
        right.count = range.count - left.count;
        measure(left);
        measure(right);
        // Divisions between bodies do not count towards the depth limit of the splits by cost below them.
        left.depth = right.depth = range.mixed ? range.depth : std::max(range.depth, cost_split_depth);
        return left;
    }

    // `list`: the range's items or its cells.
    template <class Boxed>
    bool divide_by_cost(const Range& range, std::span<Boxed> list, Range& left, Range& right) {
        if (range.depth >= cost_split_depth) return false;
        const Grid grid = bin_grid(range.centres, list.size());
        const Split split = best_split(std::span<const Boxed>(list), grid);
        if (!(split.cost < std::numeric_limits<float>::infinity())) return false;
        const auto sides = part(list, grid, split);
        const auto fill = [&](Range& half, const Side& side, const Box& box, std::uint32_t first) {
            half = Range();
            half.first = first;
            half.count = side.weight;
            half.depth = range.depth + 1;
            half.box = box;
            half.centres = side.centres;
        };
        fill(left, sides.first, split.left, range.first);
        fill(right, sides.second, split.right, range.first + left.count);
        if constexpr (std::is_same_v<Boxed, Cell>) {
            left.by_cell = right.by_cell = range.by_cell;
            left.cells = list.first(sides.first.size);
            right.cells = list.last(sides.second.size);
        } else {
            left.items = range.items;
            right.items = range.items + left.count;
        }
        return true;
    }

    // Collects the items of a range from its cells.
    void collect_items(Range& range) {
        range.own_items = lists_.take(range.count);
        range.items = range.own_items.begin();
        Item* to = range.items;
        for (const Cell& cell : range.cells)
            to = std::copy_n(range.by_cell + cell.first, cell.count, to);
        range.cells = {};
        measure(range);
    }

    static std::uint32_t halve(const Range& range) {
        alignas(16) float size[4];
        (range.centres.max - range.centres.min).store(size);
        std::size_t axis = 0;
        for (std::size_t i = 1; i < 3; ++i) {
            if (size[i] > size[axis]) axis = i;
        }
        Item* begin = range.items;
        const std::uint32_t half = range.count / 2;
        std::nth_element(begin, begin + half, begin + range.count, [axis](const Item& a, const Item& b) {
            const float ca = 0.5F * a.min[axis] + 0.5F * a.max[axis];
            const float cb = 0.5F * b.min[axis] + 0.5F * b.max[axis];
            return ca < cb || (ca == cb && a.triangle < b.triangle);
        });
        return half;
    }

    // Sorts by body, and cuts between two bodies near the middle of their number.
    static std::uint32_t part_bodies(const Range& range) {
        Item* begin = range.items;
        Item* end = begin + range.count;
        const auto by_body = [](const Item& a, const Item& b) {
            return a.body < b.body || (a.body == b.body && a.triangle < b.triangle);
        };
        if (!std::is_sorted(begin, end, by_body)) std::sort(begin, end, by_body);
        std::vector<std::uint32_t> starts;
        for (std::uint32_t i = 1; i < range.count; ++i) {
            if (begin[i].body != begin[i - 1].body) starts.push_back(i);
        }
        return starts[starts.size() / 2];
    }

    // The leaves among the parts of a node, as they will be in memory.
    void pack_leaves(const Parts& parts, Node& node) {
        alignas(Leaf) std::array<std::byte, leaf_capacity * largest_leaf> bytes;
        for (std::uint32_t i = 0; i < parts.count; ++i) {
            if (!parts.part[i]->fits_leaf) continue;
            const std::span triangles(&order_[parts.part[i]->first], parts.size[i]);
            std::ranges::sort(triangles);
            pack(triangles, &bytes[node.leaf_bytes], node.children[i]);
            node.leaf_bytes += node.children[i].bytes;
        }
        if (node.leaf_bytes == 0) return;
        // leaf_id() reads some bytes more.
        node.leaves = std::make_unique<std::byte[]>(node.leaf_bytes + sizeof(std::uint32_t));
        std::copy_n(bytes.begin(), node.leaf_bytes, node.leaves.get());
    }
    void pack(std::span<const std::uint32_t> triangles, std::byte* to, Child& child) const {
        std::array<LeafTriangle, leaf_capacity> list;
        for (std::size_t lane = 0; lane < triangles.size(); ++lane) {
            list[lane].id = triangles[lane];
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3f& at = source_.positions[source_.triangles[list[lane].id][k]];
                for (std::size_t axis = 0; axis < 3; ++axis)
                    list[lane].at[axis][k] = at[static_cast<Eigen::Index>(axis)];
            }
        }
        const PackedLeaf leaf(std::span<const LeafTriangle>(list).first(triangles.size()),
                              source_.form == LeafForm::any);
        leaf.write(to);
        child.bytes = static_cast<std::uint16_t>(leaf.bytes());
        child.bytes_before = static_cast<std::uint16_t>(leaf.bytes_before());
    }

    std::uint32_t body_of(const BinaryNode& leaf) const { return source_.body(order_[leaf.first]); }

    const Source& source_;
    std::unique_ptr<std::uint32_t[]> order_;  // the triangles of all leaves
    BinaryBlocks blocks_;
    ItemLists lists_;
};

// Assigns memory: nodes before the nodes below them, leaves in the order in which a walk reaches them.
class MemoryLayout {
  public:
    void give(Node& node, int level) {
        node.index = static_cast<std::uint32_t>(nodes.size());
        nodes.push_back(&node);
        depth = std::max(depth, level);
        for (std::uint32_t i = 0; i < node.count; ++i) {
            Child& child = node.children[i];
            if (child.node) continue;
            child.link = leaf_bit | static_cast<std::uint32_t>((bytes + child.bytes_before) / leaf_alignment);
            bytes += child.bytes;
        }
        for (std::uint32_t i = 0; i < node.count; ++i) {
            Child& child = node.children[i];
            if (!child.node) continue;
            child.link = static_cast<std::uint32_t>(nodes.size());
            give(*child.node, level + 1);
        }
    }

    std::vector<const Node*> nodes;
    std::size_t bytes = 0;
    int depth = 0;
};

void write(const Node& node, Bvh& bvh) {
    BvhNode& out = bvh.nodes[node.index];
    const std::byte* from = node.leaves.get();
    for (std::size_t k = 0; k < 8; ++k) {
        const Child& child = node.children[k];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            out.bound[axis][k] = child.min[axis];
            out.bound[axis + 3][k] = child.max[axis];
        }
        out.child[k] = child.link;
        if (k >= node.count || child.node) continue;
        const std::uint32_t index = child.link & leaf_index_mask;
        std::memcpy(&bvh.leaves[std::size_t{index} * leaf_alignment - child.bytes_before], from, child.bytes);
        from += child.bytes;
    }
}

void set_leaves_of_triangles(Bvh& bvh, std::size_t triangles) {
    bvh.leaf_of = TriangleLeaves(triangles, bvh.leaves.size() / leaf_alignment);
    for (const BvhNode& node : bvh.nodes) {
        for (std::size_t k = 0; k < 8; ++k) {
            if (is_missing(node, k) || (node.child[k] & leaf_bit) == 0) continue;
            const std::uint32_t index = node.child[k] & leaf_index_mask;
            const Leaf& leaf = bvh.leaf_at(index);
            for (std::size_t lane = 0; lane < leaf_size(leaf); ++lane)
                bvh.leaf_of.set(leaf_id(leaf, lane), index);
        }
    }
}

}  // namespace

Bvh build_bvh(std::span<const Vec3f> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
              std::span<const std::uint32_t> bodies, LeafForm form) {
    Bvh bvh;
    if (triangles.empty()) return bvh;
    const Source source{positions, triangles, bodies, form};
    Range all = whole(source);
    const Box box = all.box;
    const std::unique_ptr<Node> root = Builder(source).build(std::move(all));
    MemoryLayout layout;
    layout.give(*root, 1);

    alignas(16) float low[4];
    alignas(16) float high[4];
    box.min.store(low);
    box.max.store(high);
    std::copy_n(low, 3, bvh.low.begin());
    std::copy_n(high, 3, bvh.high.begin());
    bvh.depth = layout.depth;
    bvh.nodes.resize(layout.nodes.size());
    bvh.leaves.resize(layout.bytes + leaf_overread);
    parallel_for(layout.nodes.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            write(*layout.nodes[i], bvh);
    });
    set_leaves_of_triangles(bvh, triangles.size());
    return bvh;
}

}  // namespace slipface::detail
