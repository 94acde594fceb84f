// Problem: a step of 30 cm stops a player like a wall.
// Hack (lecture, "Case study: MDK2"): lift the player, move, and drop by the same amount, unless something is
// there.
//
// When blocked: tried only where a wall stopped the plain move, and used only where it leads further. Along a
// wall both lead equally far, so the player gains no speed there. Every move: the lecture's own form.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

// The distance gained must be worth it, as a fraction of the move.
constexpr double worth = 1e-3;

double lift(const MovementSettings& settings) {
    return settings.step_height + 2.0 * settings.skin;
}

// Lift, move, drop. The lift leaves room for the skin on both sides of the rim; what may be climbed is judged
// by where the player lands. `judge` may refuse before the drop.
template <class Judge>
std::optional<Refusal> lift_move_drop(Mover& mover, const Motion& before, const Vec3& flat,
                                      const Judge& judge) {
    const double height = mover.settings.step_height;
    const double skin = mover.settings.skin;
    mover.motion() = before;
    mover.position = sweep_with_skin(mover, Pass::step, 0, Vec3(0.0, lift(mover.settings), 0.0)).reached;
    const double lifted = mover.position.y() - before.position.y();
    if (!(lifted > skin)) return Refusal{Decision::step_up_no_room, {.value = lifted}};

    collide_and_slide(mover, Pass::horizontal, flat);
    if (mover.stuck || mover.climbing) return Refusal{Decision::step_up_held};
    if (const std::optional<Refusal> refusal = judge()) return refusal;

    const double drop =
        mover.position.y() - before.position.y() + press_down(mover, Vec3::UnitY(), Vec3::Zero());
    const Swept landing = sweep_with_skin(mover, Pass::step, 1, Vec3(0.0, -drop, 0.0));
    if (!landing.contact) return Refusal{Decision::step_up_no_ground, {.value = drop}};
    const double feet = before.position.y() - mover.settings.radii.y() + before.support_rise;
    if (!no_higher_than_steps(mover, before, *landing.contact, height))
        return Refusal{Decision::step_up_too_high,
                       {.value = landing.contact->point.y() - feet, .limit = height}};
    note_contact(mover, Pass::step, *landing.contact, landing.platform);
    return land(mover, landing,
                {.own_response = Decision::step_up_own_response,
                 .too_steep = Decision::step_up_too_steep,
                 .on_ice = true});
}

// How far up the triangle goes on from `point`, which lies in its plane; metres. 0 if it is no vertical wall,
// but for a lean by less than `lean`, or is not there.
double goes_up(const std::array<Vec3, 3>& corners, const Vec3& point, double lean, double negligible) {
    const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double length = normal.norm();
    if (!(std::abs(normal.y()) < lean * length)) return 0.0;
    if (!(std::abs(normal.dot(corners[0] - point)) < negligible * length)) return 0.0;
    const Vec3 along(normal.z(), 0.0, -normal.x());
    double low = negligible, high = 0.0;
    const auto reach = [&](double y) {
        low = std::min(low, y);
        high = std::max(high, y);
    };
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 from = corners[k] - point, to = corners[(k + 1) % 3] - point;
        const double left = along.dot(from), right = along.dot(to);
        if (left == 0.0) reach(from.y());
        if (left * right < 0.0) reach(from.y() + (to.y() - from.y()) * (left / (left - right)));
    }
    return low < negligible ? high : 0.0;
}

// True if a body that is lifted by up to `height` is stopped at this contact no later than the plain move
// was: the touched point, lifted as far, still lies in the touched triangle, or in its neighbour of the same
// polygon. So they are a vertical wall; one that leans away as rounding of its corners does lets the lifted
// body less than `negligible` metres further.
bool goes_on_above(const Mover& mover, const Met& met, double height, double negligible) {
    const double lean = negligible / height;
    if (met.walkable || !(std::abs(met.normal.y()) < lean)) return false;
    const SeenWorld world = world_of(mover, met.platform);
    const auto type = [&](TriangleId triangle) { return world.face_surface(world.triangle_face(triangle)); };
    Vec3 top = met.point;
    // The triangles of a polygon have consecutive numbers.
    for (const TriangleId id : {met.triangle, met.triangle + 1, met.triangle - 1}) {
        if (id >= world.triangle_count() || !world.filter.sees(id, type(id)) ||
            (id != met.triangle && type(id) != type(met.triangle)))
            continue;
        top.y() += goes_up(world.triangle(id), top, lean, negligible);
        if (top.y() >= met.point.y() + height) return true;
    }
    return false;
}

// The displacement that a slow or oblique move lacks to get two skins into the walls that stopped it. A
// shorter one ends within the skin of the plain move and drops back beside the rim, in every tick again.
Vec3 push_into_walls(const Motion& plain, const Vec3& flat, double depth) {
    Vec3 push = Vec3::Zero();
    for (int i = 0; i < plain.wall_count; ++i) {
        const Vec3& wall = plain.walls[static_cast<std::size_t>(i)];
        push -= wall * std::max(0.0, depth + flat.dot(wall));
    }
    return push;
}

}  // namespace

bool step_up(Mover& mover, const Motion& before, const Vec3& flat) {
    const Motion plain = mover;
    const auto refuse = [&](const Refusal& refusal) {
        decide(mover, refusal.why, refusal.quantity, plain.support.face);
        mover.motion() = plain;
        return false;
    };
    if (!mover.settings.step_up) return refuse({Decision::step_up_off});
    if (!mover.was_grounded) return refuse({Decision::step_up_in_air});

    const Vec3 heading = direction_of(flat);
    const double least = worth * flat.norm();
    // Where all that was met are walls that go on above, the lifted move is the plain one.
    const auto goes_on = [&](const Met& wall) {
        return goes_on_above(mover, wall, lift(mover.settings), 0.1 * least);
    };
    if (std::all_of(mover.met.begin(), mover.met.begin() + mover.met_count, goes_on))
        return refuse({Decision::step_up_no_further, {.value = 0.0, .limit = least}});
    const auto gained = [&] { return (mover.position - plain.position).dot(heading); };
    const auto no_further = [&]() -> std::optional<Refusal> {
        if (gained() > least) return std::nullopt;
        return Refusal{Decision::step_up_no_further, {.value = gained(), .limit = least}};
    };
    const auto accept = [&] {
        decide(mover, Decision::stepped_up,
               {.value = mover.position.y() - before.position.y(), .limit = mover.settings.step_height},
               mover.support.face);
        return true;
    };
    const Vec3 push = push_into_walls(plain, flat, 2.0 * mover.settings.skin);
    // A second attempt follows where this one cannot drop, and does not where it can.
    std::optional<Refusal> refusal =
        lift_move_drop(mover, before, flat, [&] { return push.isZero(0.0) ? no_further() : std::nullopt; });
    if (!refusal) {
        if (const std::optional<Refusal> after = no_further()) return refuse(*after);
    }
    const bool climbed = mover.position.y() - plain.position.y() > 0.1 * gained();
    if (!refusal && (climbed || push.isZero(0.0))) return accept();

    const Motion beside = mover;
    if (!push.isZero(0.0) && !lift_move_drop(mover, before, flat + push, no_further) && gained() > least &&
        mover.position.y() - plain.position.y() > 0.5 * mover.settings.skin) {
        return accept();
    }
    if (refusal) return refuse(*refusal);
    mover.motion() = beside;
    return accept();
}

bool step_every_move(Mover& mover, const Motion& before, const Vec3& flat) {
    const auto anywhere = [] { return std::optional<Refusal>(); };
    if (const auto refusal = lift_move_drop(mover, before, flat, anywhere)) {
        decide(mover, refusal->why, refusal->quantity, before.support.face);
        mover.motion() = before;
        return false;
    }
    decide(mover, Decision::step_every_move, {.value = mover.position.y() - before.position.y()},
           mover.support.face);
    return true;
}

}  // namespace slipface
