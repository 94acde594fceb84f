// Problem: a player beside a wall can only fall past it. Hack: a press beside a wall jumps off it, away and
// up; what the player has along the wall stays. For a short time the stick does not steer, because it still
// points into the wall.
#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

// Two walls that face within 30 degrees of each other count as one.
constexpr double same = 0.8660254037844386;

}  // namespace

JumpStart jump_off_wall(Mover& mover) {
    const MovementSettings& s = mover.settings;
    if (!s.wall_jump) {
        if (touches_wall(mover.state)) return Refusal{Decision::wall_jump_off};
        return {};
    }
    const double reach = std::max(s.wall_jump_reach, 2.0 * s.skin);
    const std::optional<Wall> wall = wall_beside(mover, reach);
    if (!wall) return Refusal{Decision::wall_jump_no_wall, {.limit = reach}};
    const PlayerState& state = mover.state;
    const double alike = wall->out.x() * state.wall_x + wall->out.z() * state.wall_z;
    if (s.wall_jump_walls == WallJumpWalls::another && alike > same)
        return Refusal{Decision::wall_jump_same, {.value = alike, .limit = same}};
    decide(mover, Decision::wall_jumped, {.value = s.wall_jump_up, .limit = s.wall_jump_away},
           wall->support.face);
    mover.on_wall = true;
    mover.jumped_off = wall->out;
    // The wall is the ground that is left: what moves gives its velocity as other ground does.
    const Vec3 ground = ground_velocity(mover, mover.position, surface_of(mover, wall->support.surface),
                                        wall->support.platform);
    mover.air_frame = kept_on_leave(s.leave_mode, ground) - mover.frame;
    const Vec3 own = horizontal(state.velocity + mover.frame - ground);
    const Vec3 along = own - wall->out * own.dot(wall->out);
    return Vec3(mover.air_frame + along + wall->out * s.wall_jump_away + Vec3(0.0, s.wall_jump_up, 0.0));
}

namespace {

double wall_after(const Mover& mover, double jumped_off, double before) {
    if (is_held(mover) || mover.state.grounded || mover.bounced) return 0.0;
    return mover.jumped_off.isZero(0.0) ? before : jumped_off;
}

// Of the whole lock, the step of the jump included.
double lock_left(const Mover& mover) {
    return mover.jumped_off.isZero(0.0) ? mover.state.wall_lock_s : mover.settings.wall_jump_lock;
}

}  // namespace

double wall_x_after(const Mover& mover) {
    return wall_after(mover, mover.jumped_off.x(), mover.state.wall_x);
}

double wall_z_after(const Mover& mover) {
    return wall_after(mover, mover.jumped_off.z(), mover.state.wall_z);
}

double wall_lock_after(const Mover& mover) {
    if (is_held(mover) || !mover.settings.wall_jump) return 0.0;
    return std::max(0.0, lock_left(mover) - mover.dt);
}

bool stick_is_locked(const Mover& mover) {
    const double left = lock_left(mover);
    if (!is_open(left, mover.dt)) return false;
    decide(mover, Decision::wall_jump_locked, {.value = left});
    return true;
}

}  // namespace slipface
