#include "mover.h"

#include <algorithm>
#include <cmath>

namespace slipface {

Vec3 reach_of_step(const MovementSettings& s, double length) {
    // Sweeps look a few skins further than they lead, and up to twice in a row.
    constexpr double skins = 8.0;
    const double height = std::max(s.step_up ? s.step_height : 0.0, s.snap_down ? s.snap_distance : 0.0);
    const double around = length + skins * s.skin;
    return {around, around + height, around};
}

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
    static constexpr std::array<double, 11> factors{
        1.0 / (22 * 21), 1.0 / (20 * 19), 1.0 / (18 * 17), 1.0 / (16 * 15), 1.0 / (14 * 13), 1.0 / (12 * 11),
        1.0 / (10 * 9),  1.0 / (8 * 7),   1.0 / (6 * 5),   1.0 / (4 * 3),   1.0 / (2 * 1)};
    for (const double factor : factors)
        sum = 1.0 - sum * square * factor;
    return sum;
}

const SurfaceType& surface_of(const Given& given, SurfaceId surface) {
    if (given.settings.surface_types && surface < given.scene.surfaces.size())
        return given.scene.surfaces[surface];
    static const SurfaceType plain;
    return plain;
}

const SurfaceType& type_stood_on(const Given& given) {
    const PlayerState& state = given.state;
    if (state.ground_face == no_id) return surface_of(given, default_surface);
    const bool moves = state.ground_platform < given.scene.platforms.size();
    const CollisionWorld& world =
        moves ? *given.scene.platforms[state.ground_platform].rest : given.scene.collision;
    return surface_of(given, world.face_surface(state.ground_face));
}

Support support_before(const Mover& mover) {
    const PlayerState& state = mover.state;
    return {state.ground_normal, state.ground_face, state.ground_surface, state.ground_platform};
}

double walkable_limit(const Mover& mover, const SurfaceType& surface) {
    if (!surface.max_slope) return mover.walkable_cosine;
    // 89 degrees at most, whatever a file says: a ramp formula divides by N.y.
    constexpr double steepest = 1.5533430342749532;
    return slope_cosine(*surface.max_slope >= 0.0 ? std::min(*surface.max_slope, steepest) : 0.0);
}

void decide(const Mover& mover, Decision kind, FaceId face) {
    decide(mover, kind, Quantity{}, face);
}

void decide(const Mover& mover, Decision kind, const Quantity& quantity, FaceId face) {
    if (mover.trace == nullptr) return;
    mover.trace->add(
        DecisionRecord{.kind = kind, .value = quantity.value, .limit = quantity.limit, .face = face});
}

}  // namespace slipface
