// Problem: one walking speed and one jump give every gap the same answer. Hack: a press of dash moves the
// player fast and level for a time, on the ground along it.
//
// A step in which the dash ends moves by it for the rest of its time and falls for what is left, so that it
// is speed*time long at every rate. While it lasts the velocity is its memory: what a wall takes is gone.
#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

constexpr double shortest_s = 0.01;
// Of its speed: a dash that hits something head-on is over.
constexpr double least_left = 0.5;

Vec3 way_of_dash(const Mover& mover, const Vec3& own) {
    const Vec3 stick = direction_of(Vec3(mover.wish.x(), 0.0, mover.wish.y())), motion = direction_of(own);
    const bool by_stick = mover.settings.dash_toward == DashToward::stick;
    const Vec3& first = by_stick ? stick : motion;
    return first.isZero(0.0) ? (by_stick ? motion : stick) : first;
}

// Why no dash begins now; nothing: it does.
std::optional<Decision> refusal(const Mover& mover, const Vec3& way) {
    if (!mover.settings.dash) return Decision::dash_off;
    if (!mover.state.grounded && mover.state.dashes >= mover.settings.dashes) return Decision::dashes_used;
    if (way.isZero(0.0)) return Decision::dash_no_way;
    return std::nullopt;
}

}  // namespace

void dash(Mover& mover, bool jumps) {
    const MovementSettings& s = mover.settings;
    const Vec3 frame = mover.air_frame;
    Vec3 own = horizontal(mover.velocity - frame);
    mover.move_s = mover.state.move_s;
    if (mover.dash_pressed && !jumps) {
        const Vec3 way = way_of_dash(mover, own);
        if (const auto why = refusal(mover, way)) {
            decide(mover, *why);
        } else {
            mover.move_s = std::max(s.dash_time, shortest_s);
            if (mover.move_s != s.dash_time)
                decide(mover, Decision::dash_lengthened, {.value = s.dash_time, .limit = shortest_s});
            mover.dash_began = true;
            own = way * s.dash_speed;
            decide(mover, Decision::dashed, {.value = s.dash_speed});
        }
    }
    if (!is_open(mover.move_s, mover.dt)) {
        mover.move_s = 0.0;
        return;
    }
    const double speed = own.norm();
    if (jumps || speed < least_left * s.dash_speed) {
        decide(mover, jumps ? Decision::dash_jumped : Decision::dash_blocked,
               {.value = speed, .limit = least_left * s.dash_speed});
        mover.move_s = 0.0;
        return;
    }
    if (!mover.dash_began) decide(mover, Decision::dashing, {.value = mover.move_s});
    mover.dashed = std::min(1.0, mover.move_s / mover.dt);
    mover.move_s -= mover.dt;
    const double up = mover.was_grounded ? mover.velocity.y() : frame.y();
    mover.velocity = horizontal(frame) + own + Vec3(0.0, up, 0.0);
}

void end_dash(Mover& mover) {
    if (is_open(mover.move_s, mover.dt)) return;
    mover.move_s = 0.0;
    const Vec3 own = horizontal(mover.velocity - mover.air_frame);
    const double speed = own.norm(), kept = std::min(speed, mover.settings.dash_end_speed);
    decide(mover, Decision::dash_over, {.value = speed, .limit = kept});
    if (kept < speed) mover.velocity -= own * (1.0 - kept / speed);
}

double move_after(const Mover& mover) {
    const bool caught = mover.climbing || mover.stuck;
    return caught ? 0.0 : mover.move_s;
}

std::uint8_t dashes_after(const Mover& mover) {
    if (is_held(mover) || mover.state.grounded || mover.bounced) return 0;
    constexpr std::uint8_t most = 255;
    const std::uint8_t made = mover.state.dashes;
    return mover.dash_began && made < most ? static_cast<std::uint8_t>(made + 1) : made;
}

}  // namespace slipface
