#include "mover.h"

#include <algorithm>
#include <cmath>

namespace slipface {

Vec3 direction_of(const Vec3& v) {
    const double largest = v.cwiseAbs().maxCoeff();
    if (!(largest > 0.0)) return Vec3::Zero();
    const Vec3 scaled = v / largest;
    return scaled / scaled.norm();
}

Vec3 slide_along(const Vec3& v, const Vec3& normal) {
    const double into = v.dot(normal);
    return into < 0.0 ? Vec3(v - normal * into) : v;
}

double slope_cosine(double angle) {
    // Taylor series to x^22: the first term left out is below 2e-18 at pi/2.
    const double square = angle * angle;
    double sum = 1.0;
    for (int n = 22; n >= 2; n -= 2)
        sum = 1.0 - sum * square / static_cast<double>(n * (n - 1));
    return sum;
}

const SurfaceType& surface_of(const Mover& mover, SurfaceId surface) {
    static const SurfaceType plain;
    if (!mover.settings.surface_types || surface >= mover.scene.surfaces.size()) return plain;
    return mover.scene.surfaces[surface];
}

const SurfaceType& surface_of_face(const Mover& mover, FaceId face) {
    return surface_of(mover, face == no_id ? default_surface : mover.scene.collision.face_surface(face));
}

double walkable_limit(const Mover& mover, const SurfaceType& surface) {
    if (!surface.max_slope) return mover.walkable_cosine;
    // 89 degrees at most, whatever a file says: a ramp formula divides by N.y.
    constexpr double steepest = 1.5533430342749532;
    return slope_cosine(*surface.max_slope >= 0.0 ? std::min(*surface.max_slope, steepest) : 0.0);
}

void decide(const Mover& mover, const char* hack, bool acted, const char* quantity, double value,
            double limit, const char* outcome, FaceId face) {
    if (mover.trace == nullptr) return;
    mover.trace->add(DecisionRecord{.hack = hack,
                                    .acted = acted,
                                    .quantity = quantity,
                                    .value = value,
                                    .limit = limit,
                                    .outcome = outcome,
                                    .face = face});
}

}  // namespace slipface
