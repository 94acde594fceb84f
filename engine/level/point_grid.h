// Finds points near a position.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "slipface/base/hash.h"
#include "slipface/base/key_sort.h"
#include "slipface/base/types.h"

namespace slipface {

class PointGrid {
  public:
    // `point(i)`: of `count` points. `cell`: more than twice the tolerance of every search.
    template <class PointAt>
    PointGrid(std::size_t count, double cell, const PointAt& point) : cell_(cell), entries_(count) {
        for (std::size_t i = 0; i < count; ++i)
            entries_[i] = {code(point(i)), static_cast<std::uint32_t>(i)};
        sort_by_key(entries_);
    }

    double widest() const { return 0.45 * cell_; }

    // visit(i) for each point of the cells that are at most `tolerance` away along each axis, and perhaps for
    // some others.
    template <class Visit>
    void near(const Vec3& position, double tolerance, const Visit& visit) const {
        std::uint64_t codes[8];
        std::size_t count = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 offset((corner & 1) != 0 ? tolerance : -tolerance,
                              (corner & 2) != 0 ? tolerance : -tolerance,
                              (corner & 4) != 0 ? tolerance : -tolerance);
            const std::uint64_t here = code(position + offset);
            if (std::find(codes, codes + count, here) == codes + count) codes[count++] = here;
        }
        for (std::size_t k = 0; k < count; ++k) {
            auto entry = std::lower_bound(entries_.begin(), entries_.end(), codes[k],
                                          [](const KeyedIndex& a, std::uint64_t key) { return a.key < key; });
            for (; entry != entries_.end() && entry->key == codes[k]; ++entry)
                visit(entry->index);
        }
    }

  private:
    std::uint64_t code(const Vec3& position) const {
        Hasher hasher;
        for (int axis = 0; axis < 3; ++axis)
            hasher.f64(std::floor(position[axis] / cell_) + 0.0);
        return hasher.value();
    }

    double cell_;
    std::vector<KeyedIndex> entries_;
};

}  // namespace slipface
