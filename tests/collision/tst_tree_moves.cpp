// Nodes of the binary tree that are moved to better places (tree/bvh_moves.h), on trees that no split made.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <vector>

#include "scenes.h"
#include "tree/bvh_moves.h"

namespace slipface {
namespace {

using namespace detail;
using scenes::Random;

// A tree over boxes of one triangle each.
class Tree {
  public:
    explicit Tree(std::uint64_t seed) : random_(seed) {}
    BinaryNode& leaf(const Box& box) {
        BinaryNode& node = nodes_.emplace_back();
        node = {};
        node.first = next_++;
        node.count = 1;
        node.fits_leaf = true;
        node.set_box(box);
        return node;
    }
    BinaryNode& node(BinaryNode& first, BinaryNode& second) {
        BinaryNode& node = nodes_.emplace_back();
        node = {};
        node.half = {&first, &second};
        node.count = first.count + second.count;
        node.fits_leaf = node.count <= leaf_capacity;
        first.parent = second.parent = top_ = &node;
        Box box = box_of(first);
        box.add(box_of(second));
        node.set_box(box);
        return node;
    }
    // Pairs of any.
    BinaryNode& pairs(std::size_t leaves) {
        if (leaves == 1) return leaf(random_box());
        const std::size_t left = 1 + random_.below(leaves - 1);
        BinaryNode& first = pairs(left);
        return node(first, pairs(leaves - left));
    }
    // One of ten is large.
    Box random_box() {
        const double size = random_.below(10) == 0 ? random_.uniform(5.0, 80.0) : random_.uniform(0.01, 1.0);
        return box(random_.in_box(50.0), size * (random_.in_box(0.5) + Vec3(0.5, 0.5, 0.5)));
    }
    static Box box(const Vec3& at, const Vec3& size) {
        const auto four = [](const Vec3f& v) { return Four::of(v.x(), v.y(), v.z()); };
        return {four(at.cast<float>()), four((at + size).cast<float>())};
    }
    BinaryNode& top() { return *top_; }

    // What queries visit of it.
    double visited() const { return visited(*top_); }
    // Fails if a node does not fit its halves.
    void expect_sound() const {
        EXPECT_EQ(top_->parent, nullptr);
        expect_sound(*top_);
    }
    std::vector<std::uint32_t> leaves() const {
        std::vector<std::uint32_t> found;
        list(*top_, found);
        std::sort(found.begin(), found.end());
        return found;
    }

  private:
    static double visited(const BinaryNode& node) {
        const double own = reached(box_of(node));
        return node.divided() ? own + visited(*node.half[0]) + visited(*node.half[1]) : own;
    }
    static void expect_sound(const BinaryNode& node) {
        EXPECT_EQ(node.fits_leaf, node.count <= leaf_capacity);
        if (!node.divided()) {
            EXPECT_EQ(node.height, 0);
            return;
        }
        const BinaryNode &left = *node.half[0], &right = *node.half[1];
        EXPECT_EQ(node.count, left.count + right.count);
        EXPECT_EQ(node.height, 1 + std::max(left.height, right.height));
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(node.min[axis], std::min(left.min[axis], right.min[axis]));
            EXPECT_EQ(node.max[axis], std::max(left.max[axis], right.max[axis]));
        }
        for (const BinaryNode* half : node.half) {
            EXPECT_EQ(half->parent, &node);
            expect_sound(*half);
        }
    }
    static void list(const BinaryNode& node, std::vector<std::uint32_t>& found) {
        if (!node.divided()) found.push_back(node.first);
        for (const BinaryNode* half : node.half)
            if (half != nullptr) list(*half, found);
    }

    Random random_;
    std::deque<BinaryNode> nodes_;
    BinaryNode* top_ = nullptr;
    std::uint32_t next_ = 0;
};

void expect_same_leaves(Tree& tree) {
    const std::vector<std::uint32_t> before = tree.leaves();
    move_nodes(tree.top());
    tree.expect_sound();
    EXPECT_EQ(tree.leaves(), before);
}

TEST(TreeMoves, KeepAllLeavesAndSaveVisits) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        const auto leaves = static_cast<std::size_t>(seed * seed + 1);
        Tree tree(seed);
        tree.pairs(leaves);
        const double before = tree.visited();
        expect_same_leaves(tree);
        // Pairs of any are nearly the worst tree there is.
        EXPECT_LE(tree.visited(), (leaves < 100 ? 1.0 + 1e-6 : 0.8) * before);
    }
}

// Half of the leaves belong at the lower end of a chain that is as deep as a tree may be.
TEST(TreeMoves, DoNotExceedTheDepth) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        Tree tree(seed);
        Random random(seed);
        const Vec3 small(0.01, 0.01, 0.01);
        BinaryNode* chain = &tree.leaf(Tree::box(Vec3::Zero(), small));
        for (int k = 1; k < max_depth; ++k)
            chain = &tree.node(tree.leaf(Tree::box(Vec3(k, 0.0, 0.0), small)), *chain);
        BinaryNode* rest = nullptr;
        for (int k = 0; k < 32; ++k) {
            BinaryNode& near = tree.leaf(Tree::box(random.in_box(0.01), small));
            BinaryNode& pair = tree.node(near, tree.leaf(tree.random_box()));
            rest = rest == nullptr ? &pair : &tree.node(*rest, pair);
        }
        tree.node(*chain, *rest);
        const double before = tree.visited();
        expect_same_leaves(tree);
        EXPECT_LE(tree.top().height, max_depth);
        EXPECT_LT(tree.visited(), before);
    }
}

}  // namespace
}  // namespace slipface
