#include "part_motion.h"

#include <cmath>

#include "motion_finder.h"

namespace slipface {

PartMotions find_motions(FaceLookup& lookup, SurfaceTable surfaces, const PaintParts& parts,
                         const std::vector<StoredOverride>& stored, const VertexMotions& of_vertices) {
    return MotionFinder(lookup, surfaces, parts, stored, of_vertices).run();
}

FaceKey moved_key(const FaceKey& key, const PartMotion& motion) {
    if (motion.is_identity()) return key;
    FaceKey moved = key;
    moved.loop_hash = 0;
    moved.centroid = motion(key.centroid);
    // An area's vector moves with the cofactors. A tool that mirrors keeps faces looking outwards, so a
    // negative determinant does not turn them; `flipped` says if they turned.
    const Eigen::Matrix3d& m = motion.linear;
    Eigen::Matrix3d cofactors;
    cofactors.col(0) = m.col(1).cross(m.col(2));
    cofactors.col(1) = m.col(2).cross(m.col(0));
    cofactors.col(2) = m.col(0).cross(m.col(1));
    Vec3 vector = cofactors * key.normal;
    if (m.determinant() < 0.0) vector = -vector;
    const double length = vector.norm();
    moved.area = key.area * (key.normal.isZero() ? std::cbrt(std::pow(m.determinant(), 2)) : length);
    if (length > 0.0) moved.normal = vector / (motion.flipped ? -length : length);
    return moved;
}

}  // namespace slipface
