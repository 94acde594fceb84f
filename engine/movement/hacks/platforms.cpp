// Moving ground: what carries the player moves it first, and what runs into it pushes it.
//
// The platforms of a tick have moved already; their poses say from where. A rider makes the same rigid motion
// as the platform, so it does not drift off one that rotates. Any other player is swept relative to the
// platform: in the platform's frame it starts where a rider would have been carried to, and slides along the
// platform as along any surface. The result is the push, and the push collides with the rest of the world.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

// How a platform moves during this part of the step.
struct Way {
    Pose begin, end;

    Way(const Given& given, const MovingPart& part)
        : begin(pose_before(given, part)), end(pose_after(given, part)) {}
    Vec3 carried(const Vec3& position) const { return end.apply(begin.undo(position)); }
    Vec3 turned(const Vec3& v) const { return end.rotate(begin.rotate_back(v)); }
    bool turns() const { return begin.columns != end.columns; }
};

std::uint32_t index_of(const Given& given, const MovingPart& part) {
    return static_cast<std::uint32_t>(&part - given.scene.platforms.data());
}

bool moves(const MovingPart& part) {
    return !(part.begin == part.end);
}

// The contacts of a carry are discarded, except sticky surfaces and ladders.
void forget_contacts(Mover& mover) {
    mover.grounded = false;
    mover.kept_energy = false;
    mover.bounced = false;
    mover.wall_count = 0;
    mover.velocity = Vec3::Zero();
    mover.support_rise = mover.state.grounded ? mover.state.ground_rise : 0.0;
}

void carry(Mover& mover, const Vec3& move) {
    mover.on_ladder = true;  // a player that is carried past a ladder does not grab it
    collide_and_slide(mover, move.y() == 0.0 ? Pass::horizontal : Pass::slide, move);
    mover.on_ladder = false;
    forget_contacts(mover);
}

// From the point that a platform moves along to the centre of a body on ground of that normal. The body stays
// upright: of one that stands the ground below its centre keeps its place on the platform, of one that hangs
// on a wall the point that it touches.
Vec3 above_ground(const Mover& mover, const Vec3& normal) {
    const Vec3& radii = mover.settings.radii;
    const double extent = radii.cwiseProduct(normal).norm();
    constexpr double steepest = 0.1;
    if (mover.state.grounded && normal.y() > steepest) return Vec3(0.0, extent / normal.y(), 0.0);
    return radii.cwiseProduct(radii).cwiseProduct(normal) / extent;
}

// True if the rest of the level let the player go all the way: then it is where it was on the platform.
bool ride(Mover& mover, PlayerState& state) {
    const MovingPart& part = mover.scene.platforms[state.ground_platform];
    if (!moves(part)) return true;
    const Way way(mover, part);
    Vec3 to = way.carried(mover.position);
    if (way.turns()) {
        const Vec3 foot = mover.position - above_ground(mover, state.ground_normal);
        // What presses it down is no motion.
        state.velocity = way.turned(motion_velocity(state));
        state.ground_normal = way.turned(state.ground_normal);
        to = way.carried(foot) + above_ground(mover, state.ground_normal);
    }
    const Vec3 move = to - mover.position;
    if (move.isZero(0.0)) return true;
    decide(mover, Decision::platform_carried, {.value = move.norm() / mover.dt}, state.ground_face);
    const int contacts = mover.contacts;
    mover.ignored_platform = state.ground_platform;
    carry(mover, move);
    mover.ignored_platform = no_id;
    return mover.contacts == contacts;
}

struct Meeting {
    double t;     // where in the tick, 0..1. Above 1: the player comes near without a contact
    bool ground;  // that it can stand on
};

// How a player that flies by `flight` meets a platform. Nothing: it does not come near on any way that a step
// takes there.
std::optional<Meeting> meets(Mover& mover, const MovingPart& part, const Vec3& flight) {
    const MovementSettings& s = mover.settings;
    const Way way(mover, part);
    const SeenWorld world = seen_at(mover, index_of(mover, part), way.end);
    const Vec3 start = way.carried(mover.position), back = mover.position - start;
    const double steered = 0.5 * s.air_acceleration * mover.dt * mover.dt;
    const Vec3 reach = (flight.cwiseAbs() + back.cwiseAbs()).array() + steered + look_ahead * s.skin;
    // A body that contains this one wherever that goes.
    const Vec3 around = s.radii * (1.0 + reach.cwiseQuotient(s.radii).norm());
    mover.sweeps += 2;
    if (!overlaps_any(world, around, mover.position)) return std::nullopt;
    const auto contact = sweep_ellipsoid(world, s.radii, start, back + flight);
    if (!contact) return Meeting{.t = 2.0, .ground = false};
    return Meeting{.t = contact->t, .ground = contact->normal.y() >= mover.walkable_cosine};
}

// A player in the air moves in the frame of the platform that it meets first, or comes near: it goes with the
// platform, as far as the rest of the level lets it, and by so much less with its own velocity.
void fly_with(Mover& mover, PlayerState& state) {
    const double dt = mover.dt;
    const Vec3 flight = state.velocity * dt - Vec3(0.0, 0.5 * mover.settings.gravity * dt * dt, 0.0);
    std::uint32_t first = no_id;
    Meeting earliest{.t = 3.0, .ground = false};
    each_platform(mover, mover.position, flight, [&](std::uint32_t i) {
        const MovingPart& part = mover.scene.platforms[i];
        if (!moves(part)) return;
        const std::optional<Meeting> met = meets(mover, part, flight);
        if (!met || !(met->t < earliest.t || (met->t == earliest.t && i < first))) return;
        earliest = *met;
        first = i;
    });
    if (first == no_id) return;
    mover.ignored_platform = first;
    const Vec3 whole = Way(mover, mover.scene.platforms[first]).carried(mover.position) - mover.position;
    const auto blocked = sweep_scene(mover, mover.position, whole);
    const Vec3 move = whole * (blocked ? blocked->contact.t : 1.0);
    mover.ignored_platform = no_id;
    mover.position += move;
    // What a new state stands on carries it from now on, and its velocity is relative to that.
    if (state.carrier == Carrier::unknown && earliest.ground) return;
    mover.frame = move / dt;
    state.velocity -= mover.frame;
    state.air_frame -= mover.frame;
}

// Where the platform alone would leave a player that is at `position` and was at `before` when the tick
// began; `face` is the last one that it met.
Vec3 pushed_by(Mover& mover, const MovingPart& part, const Vec3& before, const Vec3& position, FaceId& face) {
    const double skin = mover.settings.skin;
    const Way way(mover, part);
    const SeenWorld world = seen_at(mover, index_of(mover, part), way.end);
    Vec3 at = way.carried(before);
    Vec3 left = position - at;
    for (int i = 0; i < 3 && !left.isZero(0.0); ++i) {
        const double length = left.norm();
        const Vec3 direction = left / length;
        const double reach = length + look_ahead * skin;
        const std::optional<Contact> hit =
            sweep_ellipsoid(world, mover.settings.radii, at, direction * reach);
        ++mover.sweeps;
        if (!hit) return at + left;
        note_contact(mover, Pass::probe, *hit, index_of(mover, part));
        face = hit->face;
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

void yield_to(Mover& mover, std::uint32_t index, const Vec3& before) {
    const MovingPart& part = mover.scene.platforms[index];
    if (!moves(part)) return;
    FaceId face = no_id;
    const Vec3 target = pushed_by(mover, part, before, mover.position, face);
    const Vec3 push = target - mover.position;
    if (!(push.norm() > 1e-9)) return;
    mover.ignored_platform = index;
    collide_and_slide(mover, Pass::slide, push);
    mover.ignored_platform = no_id;
    decide(mover, Decision::platform_pushed, {.value = push.norm()}, face);
}

// What a platform does to a player that could not give way: it overlaps it, or it has passed through its
// centre.
void press(Mover& mover, const MovingPart& part, const Vec3& before) {
    if (!moves(part)) return;
    const Way way(mover, part);
    const SeenWorld world = seen_at(mover, index_of(mover, part), way.end);
    const Vec3 from = way.carried(before), passed = mover.position - from;
    if (const auto hit = cast_ray(world, from, passed, 1.0, RayStops::as_movement)) {
        mover.swallowed = true;
        mover.presser = hit->face;
    } else if (std::array<Overlap, 1> one; find_overlaps(world, mover.settings.radii, mover.position, one)) {
        mover.pressed = true;
        mover.presser = one[0].face;
    }
}

}  // namespace

void move_with_platforms(Mover& mover, PlayerState& state) {
    if (mover.scene.platforms.empty()) return;
    const Vec3 before = mover.position;
    const bool held = is_held(state);
    const bool rides = held && state.ground_platform < mover.scene.platforms.size();
    if (!mover.settings.platforms) {
        if (rides) decide(mover, Decision::platform_off, state.ground_face);
        return;
    }
    std::uint32_t rode = no_id;
    if (rides) {
        if (ride(mover, state)) rode = state.ground_platform;
    } else if (!held) {
        fly_with(mover, state);
    }
    each_platform(mover, before, mover.position - before, [&](std::uint32_t i) {
        if (i != rode) yield_to(mover, i, before);
    });
    each_platform(mover, before, mover.position - before, [&](std::uint32_t i) {
        if (i != rode) press(mover, mover.scene.platforms[i], before);
    });
    forget_contacts(mover);
}

void move_with_surface(Mover& mover, PlayerState& state) {
    const SurfaceType& support = support_of(mover);
    if (!state.grounded && !(state.stuck && sticks(mover, support))) return;
    if (support.angular_velocity == 0.0 && support.velocity.isZero(0.0)) return;
    const double angle = support.angular_velocity * mover.dt;
    constexpr double max_angle = 1e3;  // radians per step, a bound for the work
    if (!(std::abs(angle) <= max_angle) || !support.velocity.allFinite()) return;
    const Vec3 r = horizontal(mover.position - support.spin_centre);
    const Pose turn = rotation_about(Vec3::Zero(), Vec3::UnitY(), angle);
    const Vec3 move = turn.apply(r) - r + support.velocity * mover.dt;
    if (angle != 0.0) state.velocity = turn.rotate(state.velocity);
    if (move.isZero(0.0)) return;
    decide(mover, Decision::surface_carried, {.value = move.norm() / mover.dt}, state.ground_face);
    carry(mover, move);
}

}  // namespace slipface
