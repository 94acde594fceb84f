// Moving geometry: platforms carry players that stand on them and push players out of their path.
//
// The platforms of a tick have moved already; their poses say from where. A rider makes the same rigid motion
// as the platform, so it does not drift off one that rotates. Any other player is swept relative to the
// platform: in the platform's frame it starts where a rider would have been carried to, and slides along the
// platform as along any surface. The result is the push, and the push collides with the rest of the world.
#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

Vec3 carried(const MovingPart& part, const Vec3& position) {
    return part.end.apply(part.begin.undo(position));
}

bool moves(const MovingPart& part) {
    return !(part.begin == part.end);
}

// Where the platform alone would leave a player that is at `position` and was at `before` when the tick
// began.
Vec3 pushed_by(Mover& mover, const MovingPart& part, const Vec3& before, const Vec3& position) {
    const double skin = mover.settings.skin;
    Vec3 at = carried(part, before);
    Vec3 left = position - at;
    for (int i = 0; i < 3 && !left.isZero(0.0); ++i) {
        const double length = left.norm();
        const Vec3 direction = left / length;
        const double reach = length + look_ahead * skin;
        const std::optional<Contact> hit =
            sweep_ellipsoid(*part.collision, mover.settings.radii, at, direction * reach);
        ++mover.sweeps;
        if (!hit) return at + left;
        const double into = std::max(-hit->normal.dot(direction), 0.0);
        const double distance = hit->t * reach;
        const double stop = into > 0.0 ? distance - skin / into : 0.0;
        if (stop >= length) return at + left;
        const double made = std::max(stop, 0.0);
        const double missing = std::max(skin - (distance - made) * into, 0.0);
        at += direction * made + hit->normal * missing;
        left = slide_along(left * (1.0 - made / length), hit->normal);
    }
    return at;
}

void ride(Mover& mover) {
    const PlayerState& state = mover.state;
    const MovingPart& part = mover.scene.platforms[state.ground_platform];
    const Vec3 move = carried(part, mover.position) - mover.position;
    if (move.isZero(0.0)) return;
    decide(mover, Decision::platform_carried, {.value = move.norm()}, state.ground_face);
    mover.ignored_platform = state.ground_platform;
    mover.on_ladder = true;  // a player that is carried past a ladder does not grab it
    collide_and_slide(mover, move.y() == 0.0 ? Pass::horizontal : Pass::slide, move);
    mover.on_ladder = false;
    mover.ignored_platform = no_id;
}

void yield_to(Mover& mover, std::uint32_t index, const Vec3& before) {
    const MovingPart& part = mover.scene.platforms[index];
    const Aabb reach = part.collision->bounds();
    const Vec3 far =
        (mover.settings.radii.array() + (carried(part, before) - before).norm() + mover.settings.skin)
            .matrix();
    if (((mover.position - far).array() > reach.max.array()).any() ||
        ((mover.position + far).array() < reach.min.array()).any()) {
        return;
    }
    const Vec3 target = pushed_by(mover, part, before, mover.position);
    const Vec3 push = target - mover.position;
    if (!(push.norm() > 1e-9)) return;
    mover.ignored_platform = index;
    collide_and_slide(mover, Pass::slide, push);
    mover.ignored_platform = no_id;
    decide(mover, Decision::platform_pushed, {.value = push.norm()});
}

}  // namespace

Vec3 velocity_of(const MovingPart& part, const Vec3& point) {
    return part.velocity + part.angular_velocity.cross(point - part.pivot);
}

void move_with_platforms(Mover& mover) {
    const PlayerState& state = mover.state;
    if (mover.scene.platforms.empty()) return;
    const Vec3 before = mover.position;
    const bool rides = state.ground_platform < mover.scene.platforms.size();
    if (!mover.settings.platforms) {
        if (rides) decide(mover, Decision::platform_off, state.ground_face);
        return;
    }
    if (rides) ride(mover);
    for (std::uint32_t i = 0; i < mover.scene.platforms.size(); ++i) {
        if (moves(mover.scene.platforms[i])) yield_to(mover, i, before);
    }
    mover.began_free = mover.began_free && mover.position == before;
    mover.trapped = !mover.began_free && overlaps_scene(mover, mover.position);
    if (mover.trapped) {
        decide(mover, Decision::platform_crushed);
    }
    // Contacts of the platform phase are discarded, except sticky surfaces and ladders.
    mover.grounded = false;
    mover.kept_energy = false;
    mover.bounced = false;
    mover.wall_count = 0;
    mover.velocity = Vec3::Zero();
    mover.support_rise = state.grounded ? state.ground_rise : 0.0;
}

}  // namespace slipface
