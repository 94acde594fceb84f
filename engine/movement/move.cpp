// The move: collide and slide in one piece or split, and what the velocity is afterwards.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

// With constant speed on slopes: the fraction of a horizontal move down the ground stood on that is made, so
// that the length along the slope is the move's. Uphill straight_ahead.cpp does it.
double fraction_on_slope(const Mover& mover, const Vec3& flat) {
    const PlayerState& state = mover.state;
    if (!mover.was_grounded || !(descent(state.ground_normal, flat) > 0.0)) return 1.0;
    const bool acts = mover.settings.constant_slope_speed;
    const double down = descent(state.ground_normal, flat);
    const double along = std::sqrt(flat.squaredNorm() + down * down);
    if (acts) {
        decide(mover, Decision::slope_speed_kept, {.value = flat.norm()}, state.ground_face);
    } else {
        decide(mover, Decision::slope_speed_off, {.value = along, .limit = flat.norm()}, state.ground_face);
    }
    return acts ? flat.norm() / along : 1.0;
}

// The horizontal part slides; the vertical part decides whether the player is grounded. A player that flies
// and lands walks on from there; one that is thrown back, or lands on ice, goes on as the contact has it.
void move_split(Mover& mover, Vec3 move) {
    Vec3 ground = mover.state.ground_normal;
    double falls = 0.0;  // what is left of the fall, so that the ground is met again where it leads down
    if (!mover.was_grounded) {
        // The last skin of a fall is left to the vertical part, which looks down for ground that is near.
        const Vec3 last(0.0, std::clamp(move.y(), -mover.settings.skin, 0.0), 0.0);
        if (const std::optional<TouchDown> landed = touch_down(mover, move, last)) {
            if (landed->flies) {
                // Along a fall the square of the speed changes with the way.
                const double before = mover.velocity_before.y(), after = mover.velocity.y();
                const double way = move.y() < 0.0 ? last.y() / move.y() : 0.0;
                const double square = after * after - way * (after * after - before * before);
                mover.velocity_before.y() = -std::sqrt(std::max(0.0, square));
                collide_and_slide(mover, Pass::vertical, last);
            }
            if (landed->flies || mover.stuck || mover.climbing) return;
            if (!landed->stands) {
                collide_and_slide(mover, Pass::slide, landed->remainder);
                return;
            }
            ground = mover.support.normal;
            falls = std::min(0.0, move.y() * landed->left);
            move = landed->remainder;
            mover.was_grounded = true;
            mover.grounded = false;
        }
    }
    const Vec3 flat = horizontal(move) * fraction_on_slope(mover, horizontal(move));
    const double rise = mover.was_grounded ? std::min(falls, -press_down(mover, ground, move)) : move.y();
    const Motion before = mover;
    const MovementSettings& s = mover.settings;
    const bool moves = !flat.isZero(0.0);
    const bool lifts = s.step_up && s.step_form == StepForm::every_move && mover.was_grounded && moves;
    if (lifts && step_every_move(mover, before, flat)) return;
    if (moves) collide_and_slide(mover, Pass::horizontal, flat);
    if (mover.bounced) return;
    const bool blocked = !mover.stuck && !mover.climbing && mover.wall_count > 0;
    if (!lifts && blocked && step_up(mover, before, flat)) return;
    if (mover.stuck || mover.climbing) return;

    const double height = mover.position.y();
    collide_and_slide(mover, Pass::vertical, Vec3(0.0, rise, 0.0));
    if (mover.grounded || mover.stuck || mover.climbing || mover.bounced) return;
    if (mover.was_grounded) snap_down(mover, before);
    if (!mover.grounded) hold_where_wedged(mover, rise, height);
}

// The whole move slides. Gravity alone may not bring a gliding player back to within reach of a sweep in
// every tick, so the surface slid along is looked for where it was.
void move_whole(Mover& mover, const Drive& drive) {
    const int contacts = mover.contacts;
    collide_and_slide(mover, Pass::slide, drive.move);
    if (!drive.glides || mover.contacts != contacts) return;
    const Swept swept =
        sweep_with_skin(mover, Pass::probe, 0, -mover.state.ground_normal * mover.settings.skin);
    if (!swept.contact) return;
    // Moving off faster than gravity pulls back is leaving, not gliding.
    const double off = mover.velocity.dot(swept.contact->normal);
    const double rounding = 1e-9 * mover.velocity.norm();
    if (off > mover.settings.gravity * mover.dt + rounding) return;
    mover.position = swept.reached;
    ++mover.contacts;
    const SurfaceType& surface = surface_of(mover, swept.contact->surface);
    const Hit hit{.pass = Pass::slide,
                  .contact = *swept.contact,
                  .surface = surface,
                  .platform = swept.platform,
                  .walkable = is_walkable(mover, swept.contact->normal, surface),
                  .remainder = mover.velocity * mover.dt,
                  .done = 1.0};
    touch(mover, hit);
    if (off < -rounding) mover.velocity = respond(mover, hit).velocity;
}

bool stands_by_friction(const Mover& mover, const Drive& drive) {
    return mover.grounded && drive.split && !surface_of(mover, mover.support.surface).keeps_energy;
}

// What contacts and height leave of the velocity.
void settle(Mover& mover, const Drive& drive, const Vec3& from) {
    if (stands_by_friction(mover, drive) && mover.wish.isZero(0.0) && mover.dashed == 0.0)
        coast(mover, from, drive);
    // In the air nothing but speed pays for the height that a ramp gives; a wall that is slid along may lift.
    const bool flying = !mover.was_grounded && !mover.grounded && !mover.on_wall && mover.contacts > 0;
    // Where the ground was left, a fall has the height that the slope's pull had counted on.
    const bool slid_off = mover.was_grounded && !mover.grounded && drive.friction < 1.0;
    if (!drive.split || flying || slid_off || mover.kept_energy || mover.bounced)
        cap_energy(mover, from, drive.driven);
}

}  // namespace

void move_player(Mover& mover, const Drive& drive) {
    const Vec3 from = mover.position;
    if (drive.kind == Drive::Kind::climb) {
        climb(mover);
    } else if (drive.kind == Drive::Kind::hang) {
        hang(mover, drive.move);
    } else if (drive.kind == Drive::Kind::walk) {
        if (drive.split) {
            move_split(mover, drive.move);
        } else {
            decide(
                mover,
                mover.settings.static_friction ? Decision::whole_move_on_ice : Decision::static_friction_off,
                mover.state.ground_face);
            move_whole(mover, drive);
        }
        settle(mover, drive, from);
    }
    change_frame(mover);
    if (drive.kind == Drive::Kind::walk && stands_by_friction(mover, drive)) {
        set_ground_velocity(mover);
        rest(mover, from);
    }
}

}  // namespace slipface
