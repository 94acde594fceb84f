// Outlines of painted faces in few bytes: 14 for a triangle, 20 for a quad.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/level/level.h"

namespace slipface {

// Polygons, each beside a FaceKey, which has its centroid and size.
class FaceOutlines {
  public:
    FaceOutlines() = default;
    // `flat`: as older files have them, in the plane of the key and right up to 1 % of the polygon's extent.
    explicit FaceOutlines(bool flat) : flat_(flat) {}
    std::size_t count() const { return first_.size(); }

    // Empty for a face with hundreds of corners, or hardly any extent. `key`: of the face.
    void add(const Mesh& mesh, FaceId face, const FaceKey& key);

    // The corners of outline `i`, which is that of a face with this key; none if it is empty.
    std::vector<Vec3> corners(std::size_t i, const FaceKey& key) const;

    // How far at most the face's corners are from these.
    double rounding(std::size_t i, const FaceKey& key) const;

    // The bytes of outline `i`, and back: of several one after another; false if `bytes` are none.
    std::string_view bytes(std::size_t i) const;
    bool add_bytes(std::string_view bytes);

  private:
    struct Head {
        std::size_t corners, size;  // size: in bytes, of what is before the corners
        double step;                // a number of 1
    };
    Head head(std::string_view bytes, double area) const;
    std::size_t corner_bytes() const { return flat_ ? 2 : 6; }

    bool flat_ = false;
    std::string bytes_;
    std::vector<std::uint32_t> first_;  // byte of each outline
};

}  // namespace slipface
