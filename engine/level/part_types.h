// Whether it matters for the types of a part's faces which of two motions it made.
#pragma once

#include <vector>

#include "part_motion.h"

namespace slipface {

class PartTypes {
  public:
    // `stored` as for find_motions().
    PartTypes(const PaintParts& parts, const std::vector<StoredOverride>& stored);

    // True if a painted face is where the other motion puts a face of another type, or none.
    bool differ(std::size_t part, const PartMotion& a, const PartMotion& b) const;

  private:
    using Faces = std::vector<const StoredOverride*>;
    static bool all_found(const Faces& faces, const PartMotion& from, const PartMotion& to);

    std::vector<Faces> faces_;  // [part]
};

}  // namespace slipface
