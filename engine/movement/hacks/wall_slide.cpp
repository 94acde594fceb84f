// Problem: a player beside a wall falls past it as through open air, too fast to time a jump off it. Hack: a
// wall that the player falls along slows the fall to a speed, seen from the wall.
#include <algorithm>

#include "mover.h"

namespace slipface {

void slide_down_wall(Mover& mover) {
    const MovementSettings& s = mover.settings;
    // Off, nothing is asked of the scene: the trace has what the player touched before.
    if (!s.wall_slide) {
        if (mover.trace != nullptr && touches_wall(mover.state) && mover.velocity.y() < -s.wall_slide_speed)
            decide(mover, Decision::wall_slide_off, {.value = -mover.velocity.y()}, mover.state.ground_face);
        return;
    }
    // Within reach of the wall that was slid along: contacts keep one skin, and a stick at rest keeps no
    // contact.
    const std::optional<Wall> wall = wall_beside(mover, 4.0 * s.skin);
    if (!wall) return;
    const Support& on = wall->support;
    const double ground =
        ground_velocity(mover, mover.position, surface_of(mover, on.surface), on.platform).y() -
        mover.frame.y();
    const double falls = ground - mover.velocity.y();
    if (!(falls > s.wall_slide_speed)) return;
    constexpr double meant = 0.5;  // a cosine: within 60 degrees
    if (const double into = push_into(mover, *wall);
        s.wall_slide_form == WallSlideForm::pushing && into < meant) {
        decide(mover, Decision::wall_slide_not_pushed, {.value = into, .limit = meant}, on.face);
        return;
    }
    mover.on_wall = true;
    mover.velocity.y() = ground - s.wall_slide_speed;
    mover.velocity_before.y() = std::max(mover.velocity_before.y(), mover.velocity.y());
    decide(mover, Decision::wall_slid, {.value = falls, .limit = s.wall_slide_speed}, on.face);
}

}  // namespace slipface
