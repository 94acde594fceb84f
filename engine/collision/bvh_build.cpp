// Top-down construction: a binary tree by binned surface area heuristic (I. Wald, "On fast construction of
// SAH-based bounding volume hierarchies", 2007), then collapsed to eight children a node by opening the
// largest first.
#include <tbb/task_group.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bvh.h"

namespace slipface::detail {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr int bin_count = 16;
constexpr std::uint32_t parallel_grain = 8192;

struct Box {
    std::array<float, 3> min{inf, inf, inf};
    std::array<float, 3> max{-inf, -inf, -inf};

    void add(const Box& other) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            min[axis] = std::min(min[axis], other.min[axis]);
            max[axis] = std::max(max[axis], other.max[axis]);
        }
    }
    void add(std::size_t axis, float value) {
        min[axis] = std::min(min[axis], value);
        max[axis] = std::max(max[axis], value);
    }
    // Half the surface, in double so that no finite coordinates overflow it; 0 for an empty box.
    double area() const {
        const double x = double{max[0]} - double{min[0]};
        const double y = double{max[1]} - double{min[1]};
        const double z = double{max[2]} - double{min[2]};
        return x >= 0.0 ? x * y + y * z + z * x : 0.0;
    }
};

struct Item {
    Box box;
    std::uint32_t triangle;

    // Half of the sum would overflow for the largest floats if it were summed first.
    float centre(std::size_t axis) const { return 0.5F * box.min[axis] + 0.5F * box.max[axis]; }
};

struct BinaryNode {
    Box box;
    std::uint32_t first = 0;
    std::uint32_t count = 0;  // triangles below
    std::uint32_t right = 0;  // the left child follows its parent; 0: leaf
};

struct Split {
    std::size_t axis = 0;
    int bin = 0;  // items of this bin and above go right
    double cost = std::numeric_limits<double>::infinity();
};

struct Binning {
    float origin;
    float scale;

    Binning(float low, float high) : origin(low), scale(static_cast<float>(bin_count) / (high - low)) {}
    bool usable() const { return std::isfinite(scale) && scale > 0.0F; }
    int bin(float centre) const {
        return std::clamp(static_cast<int>((centre - origin) * scale), 0, bin_count - 1);
    }
};

class Builder {
  public:
    explicit Builder(std::vector<Item>& items) : items_(items), nodes_(2 * items.size()) {}

    // Every subtree owns the node slots [node, node + 2 * count), so that tasks do not meet and the layout
    // does not depend on who came first.
    void build(std::uint32_t node, std::uint32_t first, std::uint32_t count, int depth) {
        BinaryNode& out = nodes_[node];
        out.first = first;
        out.count = count;
        Box centres;
        for (std::uint32_t i = first; i < first + count; ++i) {
            out.box.add(items_[i].box);
            for (std::size_t axis = 0; axis < 3; ++axis)
                centres.add(axis, items_[i].centre(axis));
        }
        const std::uint32_t left = split(out, centres, depth);
        if (left == 0) return;
        out.right = node + 2 * left;
        const std::uint32_t right_node = out.right;
        if (count < parallel_grain) {
            build(node + 1, first, left, depth + 1);
            build(right_node, first + left, count - left, depth + 1);
            return;
        }
        tbb::task_group tasks;
        tasks.run([=, this] { build(node + 1, first, left, depth + 1); });
        build(right_node, first + left, count - left, depth + 1);
        tasks.wait();
    }

    const std::vector<BinaryNode>& nodes() const { return nodes_; }

  private:
    // Orders the items of `node` and returns how many go left; 0 makes it a leaf. A leaf is
    // tested eight at a time, so one that is not full saves nothing.
    std::uint32_t split(const BinaryNode& node, const Box& centres, int depth) {
        if (node.count <= leaf_capacity) return 0;
        if (depth < cost_split_depth) {
            const Split best = best_split(node, centres);
            if (std::isfinite(best.cost)) {
                const auto begin = items_.begin() + node.first;
                const Binning bins(centres.min[best.axis], centres.max[best.axis]);
                const auto middle = std::partition(begin, begin + node.count, [&](const Item& item) {
                    return bins.bin(item.centre(best.axis)) < best.bin;
                });
                return static_cast<std::uint32_t>(middle - begin);
            }
        }
        return halve(node, centres);
    }

    Split best_split(const BinaryNode& node, const Box& centres) const {
        Split best;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Binning bins(centres.min[axis], centres.max[axis]);
            if (!bins.usable()) continue;
            std::array<Box, bin_count> boxes;
            std::array<std::uint32_t, bin_count> counts{};
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                const auto bin = static_cast<std::size_t>(bins.bin(items_[i].centre(axis)));
                boxes[bin].add(items_[i].box);
                ++counts[bin];
            }
            std::array<double, bin_count> right_cost{};
            Box box;
            std::uint32_t count = 0;
            for (std::size_t bin = bin_count - 1; bin > 0; --bin) {
                box.add(boxes[bin]);
                count += counts[bin];
                right_cost[bin] = box.area() * count;
            }
            box = Box();
            count = 0;
            for (std::size_t bin = 1; bin < bin_count; ++bin) {
                box.add(boxes[bin - 1]);
                count += counts[bin - 1];
                const double cost = box.area() * count + right_cost[bin];
                if (count > 0 && count < node.count && cost < best.cost) {
                    best = {axis, static_cast<int>(bin), cost};
                }
            }
        }
        return best;
    }

    std::uint32_t halve(const BinaryNode& node, const Box& centres) {
        std::size_t axis = 0;
        for (std::size_t i = 1; i < 3; ++i) {
            if (double{centres.max[i]} - double{centres.min[i]} >
                double{centres.max[axis]} - double{centres.min[axis]}) {
                axis = i;
            }
        }
        const auto begin = items_.begin() + node.first;
        const std::uint32_t half = node.count / 2;
        std::nth_element(begin, begin + half, begin + node.count, [axis](const Item& a, const Item& b) {
            const float ca = a.centre(axis);
            const float cb = b.centre(axis);
            return ca < cb || (ca == cb && a.triangle < b.triangle);
        });
        return half;
    }

    std::vector<Item>& items_;
    std::vector<BinaryNode> nodes_;
};

class Collapser {
  public:
    Collapser(const std::vector<BinaryNode>& binary, Bvh& out) : binary_(binary), out_(out) {}

    // Appends the node over `root` and, after it, all nodes below.
    std::uint32_t collapse(std::uint32_t root, int level) {
        out_.depth = std::max(out_.depth, level);
        std::array<std::uint32_t, 8> children{root};
        std::size_t count = 1;
        while (count < children.size()) {
            std::size_t largest = children.size();
            double area = -1.0;
            for (std::size_t i = 0; i < count; ++i) {
                const BinaryNode& child = binary_[children[i]];
                if (child.right != 0 && child.box.area() > area) {
                    largest = i;
                    area = child.box.area();
                }
            }
            if (largest == children.size()) break;
            const std::uint32_t opened = children[largest];
            children[largest] = opened + 1;
            children[count++] = binary_[opened].right;
        }
        const auto index = static_cast<std::uint32_t>(out_.nodes.size());
        out_.nodes.push_back(empty_node());
        for (std::size_t i = 0; i < count; ++i) {
            const BinaryNode& child = binary_[children[i]];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                out_.nodes[index].bound[axis][i] = std::nextafter(child.box.min[axis], -inf);
                out_.nodes[index].bound[axis + 3][i] = std::nextafter(child.box.max[axis], inf);
            }
        }
        for (std::size_t i = 0; i < count; ++i) {
            const BinaryNode& child = binary_[children[i]];
            const std::uint32_t link = child.right == 0 ? leaf_bit | ((child.count - 1) << 28) | child.first
                                                        : collapse(children[i], level + 1);
            out_.nodes[index].child[i] = link;
        }
        return index;
    }

  private:
    static BvhNode empty_node() {
        BvhNode node{};
        for (std::size_t row = 0; row < 6; ++row) {
            for (float& value : node.bound[row])
                value = row < 3 ? inf : -inf;
        }
        return node;
    }

    const std::vector<BinaryNode>& binary_;
    Bvh& out_;
};

}  // namespace

Bvh build_bvh(std::vector<LeafTriangle> triangles) {
    Bvh bvh;
    if (triangles.empty()) return bvh;
    const auto count = static_cast<std::uint32_t>(triangles.size());
    std::vector<Item> items(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        items[i].triangle = i;
        for (std::size_t k = 0; k < 9; ++k)
            items[i].box.add(k % 3, triangles[i].v[k]);
    }
    Builder builder(items);
    builder.build(0, 0, count, 0);
    Collapser(builder.nodes(), bvh).collapse(0, 1);
    bvh.nodes.shrink_to_fit();
    bvh.triangles.reserve(count);
    for (const Item& item : items)
        bvh.triangles.push_back(triangles[item.triangle]);
    return bvh;
}

}  // namespace slipface::detail
