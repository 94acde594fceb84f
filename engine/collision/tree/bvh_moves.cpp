#include "tree/bvh_moves.h"

#include <algorithm>
#include <array>
#include <vector>

namespace slipface::detail {
namespace {

// Nodes are tried in rounds of a part of all of them, the most promising first. A round that saves less than
// this part of what queries visit is the last: trees of triangles of one size are good as they are.
constexpr std::size_t rounds = 16;
constexpr std::size_t round_part = 64;
constexpr float worth_a_round = 0.005F;
// A move must save this part of what the node itself is reached.
constexpr float worth_a_move = 0.01F;
// A search usually looks at 10 to 40 places; where all boxes overlap it could look at all.
constexpr int max_places = 128;

Box joined(const Box& a, const Box& b) {
    Box both = a;
    both.add(b);
    return both;
}

BinaryNode& beside(const BinaryNode& node) {
    const auto& half = node.parent->half;
    return half[0] == &node ? *half[1] : *half[0];
}

// Puts `by` where `old` is.
void replace(BinaryNode& old, BinaryNode& by) {
    by.parent = old.parent;
    for (BinaryNode*& half : old.parent->half)
        if (half == &old) half = &by;
}

void set_height(BinaryNode& node) {
    node.height = static_cast<std::uint8_t>(1 + std::max(node.half[0]->height, node.half[1]->height)) & 0x7F;
}

// Sets what follows from the halves, for the node and those above it.
void refit(BinaryNode& node) {
    for (BinaryNode* at = &node; at != nullptr; at = at->parent) {
        at->set_box(joined(box_of(*at->half[0]), box_of(*at->half[1])));
        at->count = at->half[0]->count + at->half[1]->count;
        at->fits_leaf = at->count <= leaf_capacity;
        set_height(*at);
    }
}

// The search for a better place of a node.
class Places {
  public:
    explicit Places(const BinaryNode& node)
        : box_(box_of(node)), own_(reached(box_)), saved_(worth_a_move * own_) {
        // What queries visit less without the node, below what the loop has come to: its parent is not
        // needed.
        float less = reached(box_of(*node.parent));
        Box rest = box_of(beside(node));
        bool shrinks = true;  // without the node
        look_below(beside(node), less);
        for (const BinaryNode* below = node.parent; below->parent != nullptr; below = below->parent) {
            look_below(beside(*below), less);
            BinaryNode& here = *below->parent;
            if (!shrinks || here.parent == nullptr) continue;
            rest.add(box_of(beside(*below)));
            const float left = reached(rest);
            consider(here, less - left);
            const float before = reached(box_of(here));
            shrinks = left < before;
            less += before - left;
        }
    }

    // The node is best put beside this one; null: it stays.
    BinaryNode* best() const { return best_; }
    float saved() const { return saved_; }

  private:
    void consider(BinaryNode& place, float saved) {
        if (!(saved > saved_)) return;
        saved_ = saved;
        best_ = &place;
    }
    // `less`: what is saved before the node is put in again.
    void look_below(BinaryNode& top, float less) {
        struct Entry {
            BinaryNode* node;
            float less;
        };
        std::array<Entry, max_depth + 2> stack;
        std::size_t count = 0;
        stack[count++] = {&top, less};
        for (; count != 0 && places_ < max_places; ++places_) {
            const Entry at = stack[--count];
            // A node around both is reached at least as often as this one.
            if (!(at.less - own_ > saved_)) continue;
            const Box box = box_of(*at.node);
            const float both = reached(joined(box, box_));
            consider(*at.node, at.less - both);
            if (!at.node->divided()) continue;
            for (BinaryNode* half : at.node->half)
                stack[count++] = {half, at.less - (both - reached(box))};
        }
    }

    Box box_;
    float own_;
    float saved_;
    BinaryNode* best_ = nullptr;
    int places_ = 0;  // looked at
};

// Returns what queries visit less of.
float move(BinaryNode& node) {
    // The first node has to stay.
    if (node.parent->parent == nullptr) return 0.0F;
    const Places places(node);
    BinaryNode* const place = places.best();
    if (place == nullptr) return 0.0F;
    int depth = 1 + std::max(place->height, node.height);
    for (const BinaryNode* above = place; above->parent != nullptr; above = above->parent)
        ++depth;
    if (depth > max_depth) return 0.0F;
    BinaryNode& pair = *node.parent;
    BinaryNode& rest = beside(node);
    replace(pair, rest);
    refit(*rest.parent);
    replace(*place, pair);
    pair.half = {place, &node};
    place->parent = &pair;
    refit(pair);
    return places.saved();
}

struct Candidate {
    float promise;
    std::uint32_t number;  // in the order of the tree
    BinaryNode* node;

    bool operator<(const Candidate& other) const {
        return promise != other.promise ? promise < other.promise : number > other.number;
    }
};

struct Candidates {
    std::vector<Candidate> list;
    double visited = 0.0;   // of the tree by queries
    std::size_t nodes = 0;  // all

    void collect(BinaryNode& node, float own) {
        visited += own;
        ++nodes;
        node.height = 0;
        if (!node.divided()) return;
        const std::array<float, 2> halves{reached(box_of(*node.half[0])), reached(box_of(*node.half[1]))};
        for (std::size_t i = 0; i < 2; ++i)
            collect(*node.half[i], halves[i]);
        set_height(node);
        for (std::size_t i = 0; i < 2; ++i) {
            // Large where this half is small and the other nearly fills the node. Not so if floats overflow.
            const float promise = (own - halves[i]) * ((own - halves[1 - i]) / own);
            if (promise > 0.0F)
                list.push_back({promise, static_cast<std::uint32_t>(list.size()), node.half[i]});
        }
    }
};

}  // namespace

void move_nodes(BinaryNode& top) {
    Candidates candidates;
    candidates.collect(top, reached(box_of(top)));
    auto& list = candidates.list;
    std::make_heap(list.begin(), list.end());
    for (std::size_t round = 0; round < rounds; ++round) {
        double saved = 0.0;
        for (std::size_t i = 0; i <= candidates.nodes / round_part && !list.empty(); ++i) {
            std::pop_heap(list.begin(), list.end());
            saved += move(*list.back().node);
            list.pop_back();
        }
        if (!(saved >= worth_a_round * candidates.visited)) return;
    }
}

}  // namespace slipface::detail
