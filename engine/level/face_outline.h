// Outlines of painted faces in few bytes: 5 for a triangle, 7 for a quad.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/level/level.h"

namespace slipface {

// Flat polygons, each beside a FaceKey, which has its centroid, plane and size.
class FaceOutlines {
  public:
    std::size_t count() const { return first_.size(); }

    // Empty for a face that no few bytes describe: without area, very long, or with hundreds of corners.
    // `key`: of the face.
    void add(const Mesh& mesh, FaceId face, const FaceKey& key);

    // The corners of outline `i`, which is that of a face with this key; none if it is empty. They are right
    // up to 1 % of the polygon's extent.
    std::vector<Vec3> corners(std::size_t i, const FaceKey& key) const;

    // How far at most the face's corners are from these, seen along its normal.
    double rounding(std::size_t i, const FaceKey& key) const;

    // The bytes of outline `i`, and back: of several one after another; false if `bytes` are none.
    std::string_view bytes(std::size_t i) const;
    bool add_bytes(std::string_view bytes);

  private:
    std::string bytes_;
    std::vector<std::uint32_t> first_;  // byte of each outline
};

}  // namespace slipface
