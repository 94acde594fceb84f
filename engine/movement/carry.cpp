// Surfaces that move under the player: conveyors by their velocity, turntables by rotating about the vertical
// axis through their centre. The player is moved first and walks from there. A jump, or a step off the
// surface, adds the surface's velocity to the player's.
#include <cmath>

#include "mover.h"

namespace slipface {

Vec3 carry_velocity(const Mover& mover) {
    const PlayerState& state = mover.state;
    const SurfaceType& support = support_of(mover);
    const Vec3 r = mover.position - support.spin_centre;
    Vec3 velocity = support.velocity + support.angular_velocity * Vec3(r.z(), 0.0, -r.x());
    if (mover.settings.platforms && state.ground_platform < mover.scene.platforms.size()) {
        velocity += velocity_of(mover.scene.platforms[state.ground_platform], mover.position);
    }
    return velocity;
}

void move_with_surface(Mover& mover) {
    const SurfaceType& support = support_of(mover);
    if (!mover.state.grounded && !(mover.state.stuck && sticks(mover, support))) return;
    if (support.angular_velocity == 0.0 && support.velocity.isZero(0.0)) return;
    const double angle = support.angular_velocity * mover.dt;
    constexpr double max_angle = 1e3;  // radians per step, a bound for the work
    if (!(std::abs(angle) <= max_angle) || !support.velocity.allFinite()) return;
    const Vec3 r = horizontal(mover.position - support.spin_centre);
    const Pose turn = rotation_about(Vec3::Zero(), Vec3::UnitY(), angle);
    const Vec3 move = turn.apply(r) - r + support.velocity * mover.dt;
    if (move.isZero(0.0)) return;
    decide(mover, Decision::surface_carried, {.value = move.norm()}, mover.state.ground_face);
    mover.on_ladder = true;  // a player that is carried past a ladder does not grab it
    collide_and_slide(mover, move.y() == 0.0 ? Pass::horizontal : Pass::slide, move);
    mover.on_ladder = false;
    mover.grounded = false;
    mover.kept_energy = false;
    mover.bounced = false;
    mover.wall_count = 0;
}

}  // namespace slipface
