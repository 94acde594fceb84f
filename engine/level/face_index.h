// An index of a mesh's faces by the members of a stored FaceKey.
#pragma once

#include <optional>
#include <vector>

#include "face_match.h"
#include "point_grid.h"
#include "slipface/base/key_sort.h"

namespace slipface {

class FaceIndex {
  public:
    FaceIndex(const Mesh& mesh, SurfaceTable surfaces);

    const FaceKey& key(FaceId face) const { return keys_[face]; }
    const std::string& base(FaceId face) const { return material_base_[mesh_.face_material[face]]; }

    // The faces with this packed_hash(loop_hash), ascending.
    std::vector<FaceId> with_hash(std::uint64_t loop_hash) const;

    // The faces whose centroid lies within `tolerance` (at most position_tolerance() of the mesh's bounds) of
    // `centroid`, ascending.
    std::vector<FaceId> near(const Vec3& centroid, double tolerance) const;

    // True if the line through `point` along `direction` hits the face, on either side of `point`.
    bool covers(FaceId face, const Vec3& point, const Vec3& direction) const;

    // Distance from the centroid to the farthest corner.
    double radius(FaceId face) const;

    // True if the face is so narrow that rounding its corners can change its normal completely.
    bool is_sliver(FaceId face, double tolerance) const;

  private:
    const Mesh& mesh_;
    std::vector<FaceKey> keys_;
    std::vector<std::string> material_base_;
    std::vector<KeyedIndex> by_hash_;
    std::optional<PointGrid> centroids_;
};

}  // namespace slipface
