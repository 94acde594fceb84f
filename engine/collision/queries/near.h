// Queries among the triangles of a neighbourhood.
#pragma once

#include <array>

#include "impl.h"
#include "queries/paths.h"
#include "slipface/collision/neighbourhood.h"

namespace slipface::detail {

inline LeafTriangle near_triangle(const NearTriangles& near, std::uint32_t index) {
    LeafTriangle triangle;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Four::of(near.corner[axis][index], near.corner[3 + axis][index], near.corner[6 + axis][index])
            .store(triangle.at[axis]);
    }
    triangle.id = near.id[index];
    return triangle;
}

// True if all triangles at `point` are among those of the neighbourhood.
inline bool covers(const NearTriangles& near, const Vec3& point) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::fabs(point[axis] - near.centre[axis]) <= near.reach[axis] + near.radii[axis]))
            return false;
    return true;
}

// The triangles that a query may touch, earliest possible touch first.
class NearCandidates {
  public:
    NearCandidates(const Neighbourhood& near, const Vec3& radii, const Vec3& from, const Vec3& move)
        : count_(
              kernels().near_sweep(near.triangles(), v3(radii), v3(from), v3(move), query_, list_.data())) {}

    // A body at rest.
    NearCandidates(const Neighbourhood& near, const Vec3& radii, const Vec3& centre)
        : count_(kernels().near_rest(near.triangles(), v3(radii), v3(centre), query_, list_.data())) {}

    // True if the query does not fit the neighbourhood; then the other members are not valid.
    bool lead_out() const { return count_ == leads_out; }
    bool none() const { return count_ == 0; }
    const EllipsoidQuery& query() const { return query_; }

    // The next triangle that may be touched no later than `limit`, or null.
    const NearCandidate* take(float limit = std::numeric_limits<float>::infinity()) {
        if (count_ == 0) return nullptr;
        NearCandidate* best = list_.data();
        for (NearCandidate* one = best + 1; one < list_.data() + count_; ++one) {
            if (one->after < best->after) best = one;
        }
        std::swap(*best, list_[--count_]);
        return list_[count_].after > limit ? nullptr : &list_[count_];
    }

  private:
    EllipsoidQuery query_;
    std::array<NearCandidate, near_capacity> list_;
    std::uint32_t count_;
};

}  // namespace slipface::detail
