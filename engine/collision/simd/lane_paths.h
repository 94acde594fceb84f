// The paths of a query, copied to all lanes, against eight boxes. Part of the kernels: see lanes.h.
#pragma once

#include "simd/kernels.h"
#include "simd/lanes.h"

namespace slipface::detail {
namespace {

inline const Leaf& leaf_at(const TreeView& tree, std::uint32_t index) {
    return *reinterpret_cast<const Leaf*>(tree.leaves + std::size_t{index} * leaf_alignment);
}

// Prefetches a child that will be read soon.
inline void fetch(const TreeView& tree, std::uint32_t child) {
    const auto* at =
        (child & leaf_bit) != 0
            ? reinterpret_cast<const std::byte*>(&leaf_at(tree, child & leaf_index_mask)) - 2 * leaf_row_bytes
            : reinterpret_cast<const std::byte*>(tree.nodes + child);
    __builtin_prefetch(at);
    __builtin_prefetch(at + 64);
    __builtin_prefetch(at + 128);
    __builtin_prefetch(at + 192);
}

struct NodeRows {
    const BvhNode& node;
    Lanes operator()(int row) const { return Lanes::load(node.bound[row]); }
};
// The boxes of a leaf's triangles, stored and read like a node's. All rows are computed: the row that a path
// reads first depends on its direction, which no processor predicts.
struct LeafRows {
    alignas(32) float bound[6][8];

    explicit LeafRows(const Lanes (&v)[9]) {
        for (int axis = 0; axis < 3; ++axis) {
            lanes_min(lanes_min(v[axis], v[axis + 3]), v[axis + 6]).store(bound[axis]);
            lanes_max(lanes_max(v[axis], v[axis + 3]), v[axis + 6]).store(bound[axis + 3]);
        }
    }
    Lanes operator()(int row) const { return Lanes::load(bound[row]); }
};

struct LaneBoxPath {
    const BoxPath& path;
    Lanes near_offset[3];
    Lanes far_offset[3];
    Lanes inverse[3];
    Lanes far_inverse[3];

    explicit LaneBoxPath(const BoxPath& one) : path(one) {
        for (int axis = 0; axis < 3; ++axis) {
            near_offset[axis] = Lanes::all(path.near_offset[axis]);
            far_offset[axis] = Lanes::all(path.far_offset[axis]);
            inverse[axis] = Lanes::all(path.inverse[axis]);
            far_inverse[axis] = Lanes::all(path.far_inverse[axis]);
        }
    }
    // Bit k is set where box k is touched between two times. `enter`: when each is entered.
    template <class Rows>
    std::uint32_t intersect(const Rows& rows, float from, float limit, Lanes& enter) const {
        const auto near = [&](int axis) {
            return (rows(path.near_row[axis]) - near_offset[axis]) * inverse[axis];
        };
        const auto far = [&](int axis) {
            return (rows(path.far_row[axis]) - far_offset[axis]) * far_inverse[axis];
        };
        // Evaluated in pairs, because every node waits for this chain. A time that is NaN is ignored.
        enter = lanes_max(lanes_max(near(0), near(1)), lanes_max(near(2), Lanes::all(from)));
        const Lanes leave = lanes_min(lanes_min(far(0), far(1)), lanes_min(far(2), Lanes::all(limit * late)));
        return lanes_not_above(enter, leave + Lanes::all(least_time));
    }
};

struct LaneVec {
    Lanes x, y, z;
};
inline LaneVec operator+(const LaneVec& a, const LaneVec& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline LaneVec operator-(const LaneVec& a, const LaneVec& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline LaneVec operator*(const LaneVec& a, const LaneVec& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline LaneVec operator*(Lanes s, const LaneVec& a) {
    return {s * a.x, s * a.y, s * a.z};
}
// a b + c and a b - c.
inline LaneVec product_plus(Lanes a, const LaneVec& b, const LaneVec& c) {
    return {lanes_product_plus(a, b.x, c.x), lanes_product_plus(a, b.y, c.y),
            lanes_product_plus(a, b.z, c.z)};
}
inline LaneVec product_minus(const LaneVec& a, const LaneVec& b, const LaneVec& c) {
    return {lanes_product_minus(a.x, b.x, c.x), lanes_product_minus(a.y, b.y, c.y),
            lanes_product_minus(a.z, b.z, c.z)};
}
inline Lanes dot(const LaneVec& a, const LaneVec& b) {
    return lanes_product_plus(a.x, b.x, lanes_product_plus(a.y, b.y, a.z * b.z));
}
inline LaneVec cross(const LaneVec& a, const LaneVec& b) {
    return {lanes_product_minus(a.y, b.z, a.z * b.y), lanes_product_minus(a.z, b.x, a.x * b.z),
            lanes_product_minus(a.x, b.y, a.y * b.x)};
}
// At least the length, at most sqrt(3) times the length.
inline Lanes size_of(const LaneVec& a) {
    return lanes_abs(a.x) + lanes_abs(a.y) + lanes_abs(a.z);
}
inline LaneVec all(const float (&v)[4]) {
    return {Lanes::all(v[0]), Lanes::all(v[1]), Lanes::all(v[2])};
}
inline LaneVec pick(LaneMask where, const LaneVec& yes, const LaneVec& no) {
    return {lanes_pick(where, yes.x, no.x), lanes_pick(where, yes.y, no.y), lanes_pick(where, yes.z, no.z)};
}

struct LaneSpherePath {
    LaneVec centre, rest, inverse, d;
    Lanes d_size;

    LaneSpherePath(const LaneVec& its_centre, const LaneVec& its_rest, const LaneVec& its_inverse,
                   const LaneVec& its_d)
        : centre(its_centre), rest(its_rest), inverse(its_inverse), d(its_d), d_size(size_of(its_d)) {}
    explicit LaneSpherePath(const SpherePath& path)
        : LaneSpherePath(all(path.centre), all(path.rest), all(path.inverse), all(path.d)) {}
};

}  // namespace
}  // namespace slipface::detail
