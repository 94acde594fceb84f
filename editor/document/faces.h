// Finding faces: connected regions and neighbourhoods.
#pragma once

#include "document/document.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

FaceFacts face_facts(const Mesh& mesh);

// Whether two directions differ by at most an angle (radians), without a trigonometric function for each
// pair.
class AngleLimit {
  public:
    explicit AngleLimit(double max_angle);
    bool operator()(const Vec3f& a, const Vec3f& b) const {
        const Vec3 u = a.cast<double>(), v = b.cast<double>();
        // |u x v|^2 against sin^2 |u|^2 |v|^2 stays precise for small angles, where the cosine is flat.
        const double along = u.dot(v), across2 = u.cross(v).squaredNorm();
        const double limit2 = sine2_ * (across2 + along * along);
        if (none_) return false;
        return acute_ ? along > 0.0 && across2 <= limit2 : along >= 0.0 || across2 >= limit2;
    }

  private:
    bool acute_, none_;
    double sine2_;
};

// The faces reachable from `start` across shared edges whose two normals differ by at most `max_angle`
// (radians). Ascending, `start` included. Faces without area are always crossed.
std::vector<FaceId> flood_by_angle(const FaceFacts& facts, const FaceNeighbours& neighbours,
                                   std::span<const FaceId> start, double max_angle);

// What a brush of that size paints: the faces connected with `start` that have a corner or an inner point
// within `radius` of `centre`; the faces between must have one, too. A radius of 0 gives `start` alone.
std::vector<FaceId> brush_faces(const Mesh& mesh, const FaceNeighbours& neighbours, FaceId start,
                                const Vec3& centre, double radius);

// The same in a level; each prop is a part of its own.
std::vector<FaceId> flood_by_angle(const Document& document, FaceId start, double max_angle);
std::vector<FaceId> brush_faces(const Document& document, FaceId start, const Vec3& centre, double radius);

// The bounding box of `faces`.
Aabb faces_bounds(const Document& document, std::span<const FaceId> faces);

}  // namespace slipface
