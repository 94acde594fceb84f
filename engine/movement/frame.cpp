// Frames: motion is relative to what carries the player.
//
// A state's velocity is relative to its carrier: the platform, belt, turntable or other player that it stands
// on, climbs or sticks to; else the level. That of a new state is relative to what its first step finds. A
// step moves the player in one frame. For a player that something carries this is the carrier's: it makes the
// carrier's motion and then moves as on still ground. For a player in the air it is that of the platform
// which it meets first, so that a fast platform neither misses it nor hits it twice. At the end of the step
// change_frame() makes the velocity relative to the carrier that the player then has. Jumping, landing,
// walking off, being caught by a ladder and changing a belt are all that one change.
#include <algorithm>

#include "mover.h"

namespace slipface {

Vec3 kept_on_leave(LeaveMode mode, const Vec3& ground) {
    Vec3 upward(0.0, std::max(ground.y(), 0.0), 0.0);
    switch (mode) {
        case LeaveMode::none: break;
        case LeaveMode::upward: return upward;
        case LeaveMode::horizontal: return horizontal(ground);
        case LeaveMode::not_downward: return horizontal(ground) + upward;
        case LeaveMode::all: return ground;
    }
    return Vec3::Zero();
}

Vec3 velocity_of(const MovingPart& part, const Vec3& point) {
    return part.velocity + part.angular_velocity.cross(point - part.pivot);
}

Vec3 ground_velocity(const Given& given, const Vec3& at, const SurfaceType& surface, std::uint32_t platform) {
    const Vec3 r = at - surface.spin_centre;
    Vec3 velocity = surface.velocity + surface.angular_velocity * Vec3(r.z(), 0.0, -r.x());
    if (given.settings.platforms && platform < given.scene.platforms.size())
        velocity += velocity_of(given.scene.platforms[platform], at);
    return velocity;
}

Vec3 velocity_in_level(const MovementScene& scene, const MovementSettings& settings,
                       const PlayerState& state) {
    const Given given{.scene = scene, .settings = settings, .state = state};
    Vec3 own = motion_velocity(state);
    if (state.carrier != Carrier::platform && state.carrier != Carrier::surface) return own;
    return own + ground_velocity(given, position_in_scene(scene, state), type_stood_on(given),
                                 state.ground_platform);
}

Carrier carrier_of(const Mover& mover, const Support& on) {
    if (mover.settings.platforms && on.platform < mover.scene.platforms.size()) return Carrier::platform;
    const SurfaceType& surface = surface_of(mover, on.surface);
    const bool moves = surface.angular_velocity != 0.0 || !surface.velocity.isZero(0.0);
    return moves ? Carrier::surface : Carrier::level;
}

Vec3 frame_velocity(const Mover& mover) {
    const PlayerState& state = mover.state;
    return is_held(state) && state.carrier != Carrier::character
               ? ground_velocity(mover, mover.position, support_of(mover), state.ground_platform)
               : mover.frame;
}

void change_frame(Mover& mover) {
    const PlayerState& state = mover.state;
    const bool holds_on = is_held(mover);
    const bool carried = is_held(state) && state.carrier != Carrier::character;
    Vec3 from = frame_velocity(mover);
    Vec3 to = Vec3::Zero();
    mover.air_frame += mover.frame;
    if (holds_on || mover.bounced) {
        const Vec3 ground = ground_velocity(mover, mover.position, surface_of(mover, mover.support.surface),
                                            mover.support.platform);
        to = holds_on ? ground : Vec3::Zero();
        mover.air_frame = holds_on ? Vec3(Vec3::Zero()) : kept_on_leave(mover.settings.leave_mode, ground);
    } else if (carried) {
        const Vec3 ground = from;
        from = mover.air_frame = kept_on_leave(mover.settings.leave_mode, ground);
        if (!ground.isZero(0.0)) {
            decide(mover, from.isZero(0.0) ? Decision::ground_velocity_lost : Decision::ground_velocity_kept,
                   {.value = from.norm(), .limit = ground.norm()}, state.ground_face);
        }
    }
    if (from == to || state.carrier == Carrier::unknown) return;
    mover.velocity += from - to;
    // What is caught has the velocity of what caught it.
    if (holds_on && !mover.grounded) mover.velocity = Vec3::Zero();
}

}  // namespace slipface
