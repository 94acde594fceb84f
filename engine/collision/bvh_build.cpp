// Top-down construction by binned surface area heuristic (I. Wald, "On fast construction of SAH-based
// bounding volume hierarchies", 2007): a range of triangles is split in two until there are eight children,
// opening the largest first, and each child goes on as a task of its own. Then places in memory are given out
// in one order, and nodes and leaves are written in parallel. No step depends on which task came first.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "bvh.h"
#include "four.h"
#include "slipface/base/parallel.h"

namespace slipface::detail {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr std::uint32_t parallel_grain = 4096;

// x, y, z; the fourth number means nothing.
struct Box {
    Four min = Four::all(inf);
    Four max = Four::all(-inf);

    void add(const Box& other) {
        min = four_min(min, other.min);
        max = four_max(max, other.max);
    }
    // Half the surface; not finite where floats overflow, 0 for an empty box.
    float area() const {
        alignas(16) float d[4];
        (max - min).store(d);
        return d[0] >= 0.0F ? d[0] * d[1] + d[1] * d[2] + d[2] * d[0] : 0.0F;
    }
};

struct alignas(16) Item {
    float min[3];
    std::uint32_t triangle;
    float max[3];
    std::uint32_t body;

    // The fourth number is an integer's bits, which must not meet arithmetic: it could be a denormal, and
    // slow.
    Box box() const { return {Four::load(min).first_three(), Four::load(max).first_three()}; }
    // Half of the sum would overflow for the largest floats if it were summed first.
    Four centre() const {
        const Four half = Four::all(0.5F);
        return half * Four::load(min).first_three() + half * Four::load(max).first_three();
    }
};

struct Range {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    int depth = 0;       // of the binary tree
    Box box;             // of the items
    Box centres;         // of their centres
    bool mixed = false;  // more than one body
};

struct Node;
struct Child {
    Range range;
    std::unique_ptr<Node> node;  // none: leaf
    std::uint32_t vertices = 0;  // leaf
    std::uint32_t link = 0;      // as BvhNode::child
};
struct Node {
    std::array<Child, 8> children;
    std::uint32_t count = 0;
    std::uint32_t index = 0;
    std::uint32_t parent = 0;
};

std::uint32_t blocks(std::uint32_t count) {
    return (count + leaf_capacity - 1) / leaf_capacity;
}

constexpr std::size_t max_bins = 16;
struct Binning {
    Four origin;
    Four scale;  // 0 for an axis along which centres do not differ
    int bins;

    Binning(const Box& centres, std::uint32_t count) : origin(centres.min), bins(count < 96 ? 8 : 16) {
        alignas(16) float size[4];
        (centres.max - centres.min).first_three().store(size);
        alignas(16) float factor[4] = {};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float quotient = static_cast<float>(bins) / size[axis];
            factor[axis] = quotient > 0.0F && std::isfinite(quotient) ? quotient : 0.0F;
        }
        scale = Four::load(factor);
    }
    Four place(const Item& item) const {
        return four_min(four_max((item.centre() - origin) * scale, Four::all(0.0F)),
                        Four::all(static_cast<float>(bins - 1)));
    }
    bool usable(std::size_t axis) const {
        alignas(16) float factor[4];
        scale.store(factor);
        return factor[axis] > 0.0F;
    }
};

struct Split {
    std::size_t axis = 0;
    int bin = 0;  // items of this bin and above go right
    float cost = inf;
};

class Builder {
  public:
    Builder(Item* items, std::span<const std::array<std::uint32_t, 3>> triangles)
        : items_(items), triangles_(triangles) {}

    // The tree over a range of more than leaf_capacity triangles, or the root over any.
    std::unique_ptr<Node> build(const Range& root) {
        auto node = std::make_unique<Node>();
        node->children[0].range = root;
        node->count = 1;
        while (node->count < 8) {
            std::uint32_t largest = 8;
            float area = -1.0F;
            for (std::uint32_t i = 0; i < node->count; ++i) {
                const Range& range = node->children[i].range;
                if (!is_leaf(range) && !(range.box.area() <= area)) {
                    largest = i;
                    area = range.box.area();
                }
            }
            if (largest == 8) break;
            Range right;
            node->children[largest].range = divide(node->children[largest].range, right);
            node->children[node->count++].range = right;
        }
        join_leaves(*node);
        const auto finish = [this](Child& child) {
            if (is_leaf(child.range)) {
                child.vertices = sort_leaf(child.range);
            } else {
                child.node = build(child.range);
            }
        };
        if (root.count < parallel_grain) {
            for (std::uint32_t i = 0; i < node->count; ++i)
                finish(node->children[i]);
        } else {
            parallel_for(node->count, 1, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i)
                    finish(node->children[i]);
            });
        }
        return node;
    }

    // The items' own boxes and bodies, for a range whose triangles are given.
    void measure(Range& range) const {
        range.box = Box();
        range.centres = Box();
        range.mixed = false;
        for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
            range.box.add(items_[i].box());
            const Four centre = items_[i].centre();
            range.centres.add({centre, centre});
            range.mixed = range.mixed || items_[i].body != items_[range.first].body;
        }
    }

  private:
    // A leaf is tested eight at a time, so one that is not full saves nothing.
    static bool is_leaf(const Range& range) { return range.count <= leaf_capacity && !range.mixed; }

    // Two leaves side by side become one if that makes it less likely that a query looks at one of them.
    static void join_leaves(Node& node) {
        const auto end = node.children.begin() + node.count;
        std::sort(node.children.begin(), end,
                  [](const Child& a, const Child& b) { return a.range.first < b.range.first; });
        for (std::uint32_t i = 0; i + 1 < node.count;) {
            Range& range = node.children[i].range;
            const Range& next = node.children[i + 1].range;
            Box both = range.box;
            both.add(next.box);
            if (!is_leaf(range) || !is_leaf(next) || range.count + next.count > leaf_capacity ||
                both.area() > range.box.area() + next.box.area()) {
                ++i;
                continue;
            }
            range.box = both;
            range.count += next.count;
            std::move(node.children.begin() + i + 2, node.children.begin() + node.count,
                      node.children.begin() + i + 1);
            node.children[--node.count] = Child();
        }
    }

    // Parts the items of a range; returns the left part.
    Range divide(const Range& range, Range& right) {
        std::uint32_t left_count = 0;
        Range left;
        if (range.mixed) {
            left_count = part_bodies(range);
        } else if (range.depth < cost_split_depth) {
            const Binning bins(range.centres, range.count);
            const Split best = best_split(range, bins);
            if (best.cost < inf) {
                part(range, bins, best, left, right);
                left.depth = right.depth = range.depth + 1;
                return left;
            }
        }
        if (left_count == 0) left_count = halve(range);
        left.first = range.first;
        left.count = left_count;
        right.first = range.first + left_count;
        right.count = range.count - left_count;
        measure(left);
        measure(right);
        // Halvings of bodies do not count against the splits by cost below them.
        left.depth = right.depth = range.mixed ? range.depth : std::max(range.depth, cost_split_depth);
        return left;
    }

    Split best_split(const Range& range, const Binning& bins) const {
        struct Bin {
            Box box;
            std::uint32_t count = 0;
        };
        std::array<std::array<Bin, max_bins>, 3> table;
        for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
            const Box box = items_[i].box();
            alignas(16) std::int32_t place[4];
            bins.place(items_[i]).store_truncated(place);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                Bin& bin = table[axis][static_cast<std::size_t>(place[axis])];
                bin.box.add(box);
                ++bin.count;
            }
        }
        Split best;
        const auto used = static_cast<std::size_t>(bins.bins);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!bins.usable(axis)) continue;
            std::array<float, max_bins> right_cost{};
            Box box;
            std::uint32_t count = 0;
            for (std::size_t bin = used - 1; bin > 0; --bin) {
                box.add(table[axis][bin].box);
                count += table[axis][bin].count;
                right_cost[bin] = box.area() * static_cast<float>(blocks(count));
            }
            box = Box();
            count = 0;
            for (std::size_t bin = 1; bin < used; ++bin) {
                box.add(table[axis][bin - 1].box);
                count += table[axis][bin - 1].count;
                const float cost = box.area() * static_cast<float>(blocks(count)) + right_cost[bin];
                if (count > 0 && count < range.count && cost < best.cost) {
                    best = {axis, static_cast<int>(bin), cost};
                }
            }
        }
        return best;
    }

    void part(const Range& range, const Binning& bins, const Split& split, Range& left, Range& right) {
        const auto goes_left = [&](const Item& item) {
            alignas(16) std::int32_t place[4];
            bins.place(item).store_truncated(place);
            return place[split.axis] < split.bin;
        };
        const auto take = [](Range& side, const Item& item) {
            const Four centre = item.centre();
            side.box.add(item.box());
            side.centres.add({centre, centre});
            ++side.count;
        };
        left = right = Range();
        std::uint32_t low = range.first;
        std::uint32_t high = range.first + range.count;
        while (true) {
            while (low < high && goes_left(items_[low]))
                take(left, items_[low++]);
            while (low < high && !goes_left(items_[high - 1]))
                take(right, items_[--high]);
            if (low >= high) break;
            std::swap(items_[low], items_[high - 1]);
        }
        left.first = range.first;
        right.first = low;
    }

    std::uint32_t halve(const Range& range) {
        alignas(16) float size[4];
        (range.centres.max - range.centres.min).store(size);
        std::size_t axis = 0;
        for (std::size_t i = 1; i < 3; ++i) {
            if (size[i] > size[axis]) axis = i;
        }
        Item* begin = items_ + range.first;
        const std::uint32_t half = range.count / 2;
        std::nth_element(begin, begin + half, begin + range.count, [axis](const Item& a, const Item& b) {
            const float ca = 0.5F * a.min[axis] + 0.5F * a.max[axis];
            const float cb = 0.5F * b.min[axis] + 0.5F * b.max[axis];
            return ca < cb || (ca == cb && a.triangle < b.triangle);
        });
        return half;
    }

    // Sorts by body, and cuts between bodies near the middle of their number.
    std::uint32_t part_bodies(const Range& range) {
        Item* begin = items_ + range.first;
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

    // Brings a leaf's triangles into order and counts their vertices.
    std::uint32_t sort_leaf(const Range& range) {
        Item* begin = items_ + range.first;
        std::sort(begin, begin + range.count,
                  [](const Item& a, const Item& b) { return a.triangle < b.triangle; });
        std::array<std::uint32_t, 3 * leaf_capacity> seen;
        std::uint32_t count = 0;
        for (std::uint32_t i = 0; i < range.count; ++i) {
            for (const std::uint32_t vertex : triangles_[begin[i].triangle]) {
                if (std::find(seen.begin(), seen.begin() + count, vertex) == seen.begin() + count)
                    seen[count++] = vertex;
            }
        }
        return count;
    }

    Item* items_;
    std::span<const std::array<std::uint32_t, 3>> triangles_;
};

// Gives out places: nodes before the nodes below them, leaves in the order in which a walk meets them.
class Places {
  public:
    void give(Node& node, std::uint32_t parent, int level) {
        node.index = static_cast<std::uint32_t>(nodes.size());
        node.parent = parent;
        nodes.push_back(&node);
        depth = std::max(depth, level);
        for (std::uint32_t i = 0; i < node.count; ++i) {
            Child& child = node.children[i];
            if (child.node) continue;
            child.link = leaf_bit | static_cast<std::uint32_t>(bytes / leaf_alignment);
            bytes += leaf_bytes(child.range.count, child.vertices);
        }
        for (std::uint32_t i = 0; i < node.count; ++i) {
            Child& child = node.children[i];
            if (!child.node) continue;
            child.link = static_cast<std::uint32_t>(nodes.size());
            give(*child.node, node.index, level + 1);
        }
    }

    std::vector<const Node*> nodes;
    std::size_t bytes = 0;
    int depth = 0;
};

class Writer {
  public:
    Writer(const Item* items, std::span<const Vec3f> positions,
           std::span<const std::array<std::uint32_t, 3>> triangles, Bvh& bvh)
        : items_(items), positions_(positions), triangles_(triangles), bvh_(bvh) {}

    void write(const Node& node) {
        BvhNode& out = bvh_.nodes[node.index];
        bvh_.parents[node.index] = node.parent;
        for (std::size_t k = 0; k < 8; ++k) {
            alignas(16) float low[4];
            alignas(16) float high[4];
            node.children[k].range.box.min.store(low);
            node.children[k].range.box.max.store(high);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                out.bound[axis][k] = low[axis];
                out.bound[axis + 3][k] = high[axis];
            }
            out.child[k] = node.children[k].link;
            if (k < node.count && !node.children[k].node) write_leaf(node.children[k], node.index);
        }
    }

  private:
    void write_leaf(const Child& child, std::uint32_t parent) {
        const std::uint32_t place = child.link & leaf_place_mask;
        Leaf& leaf = bvh_.leaf_at(place);
        leaf.count = static_cast<std::uint8_t>(child.range.count);
        leaf.vertices = static_cast<std::uint8_t>(child.vertices);
        leaf.unused = 0;
        leaf.parent = parent;
        auto* coordinates = const_cast<float*>(leaf_coordinates(leaf));
        auto* ids = const_cast<std::uint32_t*>(leaf_ids(leaf));
        std::array<std::uint32_t, 3 * leaf_capacity> seen;
        std::size_t count = 0;
        for (std::size_t lane = 0; lane < leaf.count; ++lane) {
            const std::uint32_t id = items_[child.range.first + lane].triangle;
            ids[lane] = id;
            bvh_.slots[id] = static_cast<std::uint32_t>(place * leaf_capacity + lane);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t vertex = triangles_[id][k];
                const auto end = seen.begin() + static_cast<std::ptrdiff_t>(count);
                const auto index =
                    static_cast<std::size_t>(std::find(seen.begin(), end, vertex) - seen.begin());
                leaf.corner[k][lane] = static_cast<std::uint8_t>(index);
                if (index < count) continue;
                seen[count++] = vertex;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    coordinates[axis * child.vertices + index] =
                        positions_[vertex][static_cast<Eigen::Index>(axis)];
            }
        }
        for (std::size_t lane = leaf.count; lane < leaf_capacity; ++lane) {
            for (auto& corner : leaf.corner)
                corner[lane] = corner[leaf.count - 1U];
        }
    }

    const Item* items_;
    std::span<const Vec3f> positions_;
    std::span<const std::array<std::uint32_t, 3>> triangles_;
    Bvh& bvh_;
};

}  // namespace

Bvh build_bvh(std::span<const Vec3f> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
              std::span<const std::uint32_t> bodies) {
    Bvh bvh;
    if (triangles.empty()) return bvh;
    const auto count = static_cast<std::uint32_t>(triangles.size());
    const auto items = std::make_unique_for_overwrite<Item[]>(count);
    parallel_for(count, parallel_grain, [&](std::size_t begin, std::size_t end) {
        for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
            const Vec3f& a = positions[triangles[i][0]];
            const Vec3f& b = positions[triangles[i][1]];
            const Vec3f& c = positions[triangles[i][2]];
            for (int axis = 0; axis < 3; ++axis) {
                items[i].min[axis] = std::min(std::min(a[axis], b[axis]), c[axis]);
                items[i].max[axis] = std::max(std::max(a[axis], b[axis]), c[axis]);
            }
            items[i].triangle = i;
            items[i].body = bodies.empty() ? 0 : bodies[i];
        }
    });
    Builder builder(items.get(), triangles);
    Range all;
    all.count = count;
    builder.measure(all);
    const std::unique_ptr<Node> root = builder.build(all);
    Places places;
    places.give(*root, 0, 1);

    alignas(16) float low[4];
    alignas(16) float high[4];
    all.box.min.store(low);
    all.box.max.store(high);
    std::copy_n(low, 3, bvh.low.begin());
    std::copy_n(high, 3, bvh.high.begin());
    bvh.depth = places.depth;
    bvh.nodes.resize(places.nodes.size());
    bvh.parents.resize(places.nodes.size());
    bvh.leaves.resize(places.bytes + leaf_overread);
    bvh.slots.resize(count);
    Writer writer(items.get(), positions, triangles, bvh);
    parallel_for(places.nodes.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            writer.write(*places.nodes[i]);
    });
    return bvh;
}

}  // namespace slipface::detail
