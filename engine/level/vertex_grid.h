// Finds vertices near a position.
#pragma once

#include <vector>

#include "face_match.h"
#include "slipface/base/key_sort.h"

namespace slipface {

class VertexGrid {
  public:
    explicit VertexGrid(const Mesh& mesh);

    double widest() const { return 0.45 * cell_; }

    // The nearest vertex within `tolerance`, at most widest(); no_id: none.
    std::uint32_t nearest(const Vec3& position, double tolerance) const;

  private:
    static std::uint64_t code(const Vec3& cell);

    const Mesh& mesh_;
    double cell_ = 1.0;
    std::vector<KeyedIndex> entries_;
};

}  // namespace slipface
