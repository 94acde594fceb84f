// Where three corners of a face that follow each other may be in a mesh, and the motions that put them there.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "part_motion.h"

namespace slipface {

// The middle one is the second.
using ThreeCorners = std::array<Vec3, 3>;

class SimilarCorners {
  public:
    explicit SimilarCorners(const Mesh& mesh) : mesh_(mesh) {}

    // Three corners of the mesh's faces that are as these, turned, mirrored or scaled, those of their size
    // first; at most `most`. Triangulating leaves some three of each face.
    std::vector<ThreeCorners> of(const ThreeCorners& three, std::size_t most);

    // How many are nearly as these.
    std::size_t count(const ThreeCorners& three);

    // The motions that turn and scale the one onto the other, and the same with a reflection.
    static std::vector<PartMotion> motions(const ThreeCorners& from, const ThreeCorners& to);

  private:
    struct Shape {
        float opposite, shorter;  // of three sides, in the length of the longer one of the other two
        FaceId face;
        std::uint32_t corner;  // the middle one
    };
    using Shapes = std::vector<Shape>;
    std::pair<Shapes::const_iterator, Shapes::const_iterator> like(const ThreeCorners& three);
    ThreeCorners corners(const Shape& shape) const;

    const Mesh& mesh_;
    Shapes shapes_;
};

}  // namespace slipface
