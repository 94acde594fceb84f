// Faces of a mesh with a given shape, and the motions that make a polygon one of them.
#pragma once

#include <vector>

#include "face_index.h"
#include "part_motion.h"

namespace slipface {

class SimilarFaces {
  public:
    SimilarFaces(const Mesh& mesh, const FaceIndex& index) : mesh_(mesh), index_(index) {}

    // Faces of the polygon's shape (its `length` around and its `area` up to a common scale), the ones of its
    // size first.
    std::vector<FaceId> of(const std::vector<Vec3f>& polygon, double length, double area);

    // The motions that turn, mirror and scale the polygon onto the face.
    std::vector<PartMotion> motions(const std::vector<Vec3f>& polygon, FaceId face) const;

  private:
    struct Shape {
        double roundness;  // perimeter^2 / area
        FaceId face;
    };

    double perimeter(FaceId face) const;
    void sort_shapes();

    const Mesh& mesh_;
    const FaceIndex& index_;
    std::vector<Shape> shapes_;
};

}  // namespace slipface
