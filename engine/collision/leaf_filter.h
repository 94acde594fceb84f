// Eight triangles at once against a moving ellipsoid, in float: rejects those that it certainly does not
// touch. docs/sweep.md, "The float filter", bounds the errors; everything that is not rejected goes to the
// narrow phase.
#pragma once

#include "sphere_triangle.h"
#include "traverse.h"

namespace slipface::detail {

struct LaneVec {
    Lanes x, y, z;
};
inline LaneVec operator-(const LaneVec& a, const LaneVec& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline LaneVec operator*(const LaneVec& a, const LaneVec& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline Lanes dot(const LaneVec& a, const LaneVec& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline LaneVec cross(const LaneVec& a, const LaneVec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Lanes length(const LaneVec& a) {
    return lanes_sqrt(dot(a, a));
}
// At least the length, at most sqrt(3) of it.
inline Lanes size(const LaneVec& a) {
    return lanes_abs(a.x) + lanes_abs(a.y) + lanes_abs(a.z);
}
inline LaneVec all(const V3& v) {
    return {Lanes::all(static_cast<float>(v.x)), Lanes::all(static_cast<float>(v.y)),
            Lanes::all(static_cast<float>(v.z))};
}

class LeafFilter {
  public:
    LeafFilter(const EllipsoidQuery& query, const BoxPath& path, double reach)
        : path_(path),
          centre_{Lanes::all(path.centre[0]), Lanes::all(path.centre[1]), Lanes::all(path.centre[2])},
          rest_(all({query.centre.x - double{path.centre[0]}, query.centre.y - double{path.centre[1]},
                     query.centre.z - double{path.centre[2]}})),
          inverse_(all(query.inverse)),
          d_(all(query.d)),
          d_size_(size(d_)),
          usable_(reach * largest(query.inverse) < range) {}

    // Bit k is set if triangle first[k] may be touched no later than `limit`.
    std::uint32_t candidates(const LeafTriangle* first, std::uint32_t count, float limit) const {
        const LeafLanes leaf(first, count);
        Lanes enter;
        const std::uint32_t met = path_.meet(leaf, limit, enter) & leaf.present;
        if (met == 0 || !usable_) return met;
        return met & ~apart(leaf.v, limit);
    }

  private:
    // Products of three factors up to this, and of a rounding each, stay far from float's ends.
    static constexpr double range = 1e9;
    // More than all roundings of a determinant of three vectors together (fewer than 40 of 2^-24), relative
    // to the product of their lengths.
    static constexpr float rounding = 4e-6F;
    static constexpr float least = 1e-30F;

    // Bit k is set if a plane separates the swept sphere from triangle k: the triangle's own plane, or one
    // that contains an edge's direction and the move's.
    std::uint32_t apart(const Lanes (&v)[9], float limit) const {
        const LaneVec world[3] = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}};
        const LaneVec a[3] = {relative(world[0]), relative(world[1]), relative(world[2])};
        const LaneVec e[3] = {(world[1] - world[0]) * inverse_, (world[2] - world[1]) * inverse_,
                              (world[0] - world[2]) * inverse_};
        const LaneVec n = cross(e[0], e[1]);
        const Lanes dn = dot(d_, n);
        const Lanes zero = Lanes::all(0.0F);
        const Lanes tiny = Lanes::all(least);
        const Lanes error = Lanes::all(rounding);
        const Lanes one = Lanes::all(1.0F);

        // Signed plane distances times |n| at the start and at the limit; on one side and beyond 1 at both
        // ends means beyond 1 between.
        const Lanes from = zero - dot(n, a[0]);
        const Lanes to = from + Lanes::all(limit) * dn;
        const Lanes slack =
            error * size(e[0]) * size(e[1]) * (size(a[0]) + one + Lanes::all(limit) * d_size_) + tiny;
        const Lanes reach = length(n) + slack;
        std::uint32_t separated =
            lanes_above(lanes_min(from, to), reach) | lanes_above(lanes_min(zero - from, zero - to), reach);

        for (int k = 0; k < 3; ++k) {
            // On the axis e x d the edge is the point s and the opposite corner s - d.n; the sphere's path
            // stays at 0.
            const LaneVec axis = cross(e[k], d_);
            const Lanes s = dot(a[k], axis);
            const Lanes opposite = s - dn;
            const Lanes edge_reach =
                length(axis) + error * size(e[k]) * d_size_ * (size(a[k]) + size(e[0]) + size(e[1]) + one) +
                tiny;
            separated |= lanes_above(lanes_min(s, opposite), edge_reach) |
                         lanes_above(lanes_min(zero - s, zero - opposite), edge_reach);
        }
        return separated;
    }

    LaneVec relative(const LaneVec& world) const { return (world - centre_ - rest_) * inverse_; }

    const BoxPath& path_;
    LaneVec centre_;
    LaneVec rest_;
    LaneVec inverse_;
    LaneVec d_;
    Lanes d_size_;
    bool usable_;
};

}  // namespace slipface::detail
