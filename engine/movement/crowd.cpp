#include "slipface/movement/crowd.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <vector>

#include "mover.h"
#include "near_bodies.h"
#include "slipface/base/hash.h"
#include "slipface/base/parallel.h"

namespace slipface {

namespace {

// Each round leaves at most half of what a wall or a third body left of an overlap. A pile that would take
// more than so many pushes for each of its bodies goes on in the next step.
constexpr int rounds = 8;
constexpr std::size_t pushes_for_each = 4, pushes_of_few = 1000;
// Distances at which bodies touch, in units of the summed radii: rounding is neither an overlap nor a gap.
// What overlaps by less than `worth_a_round` waits for the next step.
constexpr double overlapping = 1.0 - 1e-9, touching = 1.0 + 1e-3, worth_a_round = 1.0 - 1e-3;

struct Body {
    CrowdMember* member = nullptr;
    const MovementSettings* settings = nullptr;     // of the body that it has
    Vec3 begin = Vec3::Zero(), end = Vec3::Zero();  // of its centre in this step, the scene's coordinates
    double walkable = 1.0;                          // least N.y of what it stands on
    Vec3 wish = Vec3::Zero();                       // of its input, as long as 1
    bool rides = false;                             // began on another body
    Vec3 velocity = Vec3::Zero();                   // of its motion in this step, m/s
    double gave = 1.0;                              // the part of its last push that it went, 0..1

    const Vec3& radii() const { return settings->radii; }
    bool held() const { return is_held(member->state) && !member->state.grounded; }
};

struct Touch {
    Vec3 normal = Vec3::Zero();  // unit, from the second body to the first
    double left = 1.0;           // fraction of the step that lies behind it
};

// The first body's position as seen from the second one, where the sum of both is the unit sphere.
Vec3 apart(const Body& a, const Vec3& at_a, const Body& b, const Vec3& at_b) {
    return (at_a - at_b).cwiseQuotient(a.radii() + b.radii());
}

// Of two bodies that are exactly above each other or at one place: from the second to the first.
Vec3 any_direction(const Body& a, const Body& b) {
    const bool first = a.member < b.member;
    const std::ptrdiff_t apart = first ? b.member - a.member : a.member - b.member;
    Hasher hasher;
    hasher.u64(static_cast<std::uint64_t>(apart));
    const auto part = [&](int shift) {
        return static_cast<double>(hasher.value() >> shift & 0xffff) - 32767.5;
    };
    return (first ? 1.0 : -1.0) * direction_of(Vec3(part(0), 0.0, part(16)));
}

Touch touch_at(const Body& a, const Body& b, const Vec3& apart, double left = 1.0) {
    const Vec3 normal = direction_of(apart.cwiseQuotient(a.radii() + b.radii()));
    return {.normal = normal.isZero(0.0) ? any_direction(a, b) : normal, .left = left};
}

bool meet(const Body& a, const Body& b) {
    return meet(a.member->filter, b.member->filter);
}

// The first touch on straight ways from the begins to the ends, if the bodies approach each other there.
std::optional<Touch> first_touch(const Body& a, const Body& b) {
    if (!meet(a, b)) return std::nullopt;
    const Vec3 from = apart(a, a.begin, b, b.begin);
    const Vec3 move = apart(a, a.end, b, b.end) - from;
    const double approach = from.dot(move), gap = from.squaredNorm() - 1.0;
    if (!(approach < 0.0)) return std::nullopt;
    if (gap <= 0.0) return touch_at(a, b, from);
    const double inside = approach * approach - move.squaredNorm() * gap;
    if (!(inside >= 0.0)) return std::nullopt;
    const double t = gap / (std::sqrt(inside) - approach);
    if (!(t < 1.0)) return std::nullopt;
    return touch_at(a, b, from + t * move, 1.0 - t);
}

// Where the ends are no more than `distance` apart.
std::optional<Touch> end_touch(const Body& a, const Body& b, double distance) {
    const Vec3 q = apart(a, a.end, b, b.end);
    return meet(a, b) && q.squaredNorm() < distance * distance ? std::optional(touch_at(a, b, q))
                                                               : std::nullopt;
}

// How far the end of `a` has to go along `direction` (unit) to leave `b`, m; 0 if it is outside.
double way_out(const Body& a, const Body& b, const Vec3& direction) {
    const Vec3 q = apart(a, a.end, b, b.end), along = direction.cwiseQuotient(a.radii() + b.radii());
    const double square = along.squaredNorm(), half = q.dot(along);
    const double inside = half * half - square * (q.squaredNorm() - 1.0);
    return inside > 0.0 ? std::max(0.0, (std::sqrt(inside) - half) / square) : 0.0;
}

MovementScene seen_by(const MovementScene& scene, const CrowdMember& member) {
    MovementScene seen = scene;
    if (member.filter != nullptr) seen.filter = member.filter;
    return seen;
}

// Moves the end by `move`, as far as the scene lets it, and returns how much of `move` that is, 0..1.
double shift(const MovementScene& whole, Body& body, const Vec3& move) {
    const MovementScene scene = seen_by(whole, *body.member);
    const double length = move.norm();
    if (length == 0.0 || body.held()) return 0.0;
    PlayerState here = body.member->state;
    here.position = body.end;
    const Surroundings around(scene, *body.settings, here.position, length);
    Mover mover({.scene = scene,
                 .settings = *body.settings,
                 .state = here,
                 .trace = nullptr,
                 .dt = 1.0,
                 .wish = Vec2::Zero(),
                 .jump_held = false,
                 .jump_pressed = false,
                 .walkable_cosine = body.walkable},
                around);
    mover.velocity = mover.velocity_before = move;
    collide_and_slide(mover, move.y() == 0.0 ? Pass::horizontal : Pass::slide, move);
    if (!clamp_to_terrain(mover, body.end) || !mover.position.allFinite()) return 0.0;
    if (overlaps_scene(mover, mover.position) && !overlaps_scene(mover, body.end)) return 0.0;
    const double moved = (mover.position - body.end).dot(move) / (length * length);
    body.end = mover.position;
    return std::clamp(moved, 0.0, 1.0);
}

// Whether the first of two bodies stands on the second one.
bool stands_on(const Body& upper, const Vec3& normal) {
    return normal.y() >= upper.walkable && !upper.held();
}

Vec3 sideways(const Body& a, const Body& b, const Vec3& normal) {
    const Vec3 flat = direction_of(horizontal(normal));
    return flat.isZero(0.0) ? any_direction(a, b) : flat;
}

// How much of what keeps two bodies apart the first one does, 0..1: half, or less where both want the same
// way and it is ahead. So one after the other passes a door that is too narrow for two.
double fraction_of(const Body& a, const Body& b) {
    constexpr double clearly_ahead = 0.25;  // of the distance at which they touch
    if (!(a.wish.dot(b.wish) > 0.0)) return 0.5;
    const double ahead = apart(a, a.begin, b, b.begin).dot(direction_of(a.wish + b.wish));
    return 0.5 - 0.5 * std::clamp(ahead / clearly_ahead, -1.0, 1.0);
}

// What the first body does to leave the second one, m: it goes its fraction of the way, and what the other
// one could not go of its own.
Vec3 give_way(const Body& a, const Body& b, const Touch& touch) {
    if (stands_on(a, touch.normal)) return way_out(a, b, Vec3::UnitY()) * Vec3::UnitY();
    if (stands_on(b, -touch.normal))  // under a ceiling
        return (b.gave - 1.0) * way_out(b, a, Vec3::UnitY()) * Vec3::UnitY();
    // After the touch only as far as they approached since: one that got past is not put back.
    const Vec3 away = sideways(a, b, touch.normal);
    double depth = way_out(a, b, away);
    if (touch.left < 1.0) {
        const Vec3 since = touch.left * (a.end - a.begin - b.end + b.begin);
        depth = std::min(depth, std::max(0.0, -since.dot(away)));
    }
    return (1.0 - fraction_of(b, a) * b.gave) * depth * away;
}

// Of several that push the same way few are enough, and two from opposite sides are none.
class Pushes {
  public:
    void add(const Vec3& push) {
        sum_ += push;
        longest_ = std::max(longest_, push.norm());
    }
    // At most so many times as long as the longest.
    Vec3 together(double times) const {
        const double length = sum_.norm(), most = times * longest_;
        return length > most ? Vec3(sum_ * (most / length)) : sum_;
    }

  private:
    Vec3 sum_ = Vec3::Zero();
    double longest_ = 0.0;
};

PlayerState stepped(const MovementScene& whole, CrowdMember& member, double dt) {
    const MovementScene scene = seen_by(whole, member);
    return member.rest != nullptr && member.contacts == nullptr
               ? step(scene, *member.settings, member.state, member.input, dt, *member.rest).state
               : step(scene, *member.settings, member.state, member.input, dt, nullptr, member.contacts)
                     .state;
}

constexpr std::size_t grain = 32;

struct Crowd {
    const MovementScene& scene;
    std::vector<Body> bodies;
    NearBodies near;
    std::vector<Vec3> pushes;                         // [body] in this round, m
    std::vector<std::uint8_t> pushed, pushed_before;  // [body] in this round, and in the one before

    explicit Crowd(const MovementScene& its_scene) : scene(its_scene) {}

    template <class Each>
    void each(Each&& visit) {
        parallel_for(bodies.size(), grain, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                visit(i, bodies[i]);
        });
    }

    void find_near() {
        std::vector<Aabb> rooms;
        std::vector<Vec3> places;
        for (const Body& body : bodies) {
            const Vec3 reach = 1.25 * body.radii();  // also after some pushes
            rooms.push_back({body.begin.cwiseMin(body.end) - reach, body.begin.cwiseMax(body.end) + reach});
            places.push_back(body.begin);
        }
        near.find(rooms, places);
    }

    // All give way at once, each as it sees the others before: no order of them, and no thread, decides.
    template <class FindTouch>
    std::size_t round(bool all, FindTouch&& find_touch) {
        std::atomic<std::size_t> count = 0;
        pushed.swap(pushed_before);
        each([&](std::size_t i, const Body& body) {
            bool changed = all || pushed_before[i] != 0;
            for (const std::uint32_t k : near.of(i))
                changed = changed || pushed_before[k] != 0;
            Pushes together;
            if (changed)
                for (const std::uint32_t k : near.of(i))
                    if (const std::optional<Touch> touch = find_touch(body, bodies[k]))
                        together.add(give_way(body, bodies[k], *touch));
            pushes[i] = together.together(2.0);
            pushed[i] = pushes[i].isZero(0.0) ? 0 : 1;
            if (pushed[i] != 0) count.fetch_add(1, std::memory_order_relaxed);
        });
        if (count == 0) return 0;
        each([&](std::size_t i, Body& body) {
            if (pushed[i] != 0) body.gave = shift(scene, body, pushes[i]);
        });
        return count;
    }

    void take_apart() {
        pushes.resize(bodies.size());
        pushed.assign(bodies.size(), 0);
        pushed_before = pushed;
        std::size_t count = round(true, first_touch), now = 1;
        const std::size_t enough = std::max(pushes_of_few, pushes_for_each * bodies.size());
        double distance = overlapping;
        const auto at_end = [&](const Body& a, const Body& b) { return end_touch(a, b, distance); };
        for (int i = 0; i < rounds && now > 0 && count < enough; ++i) {
            count += now = round(i == 0, at_end);
            distance = worth_a_round;
        }
    }
};

// A body that began on another one goes where that one goes, and takes its velocity along if it leaves it;
// settle() takes that off again. The lowest one comes first, so towers are carried from below.
void carry_riders(Crowd& crowd, double dt) {
    std::vector<std::uint32_t> riders;
    for (std::uint32_t i = 0; i < crowd.bodies.size(); ++i) {
        Body& body = crowd.bodies[i];
        body.velocity = (body.end - body.begin) / dt;
        if (body.rides) riders.push_back(i);
    }
    if (riders.empty()) return;
    crowd.find_near();
    std::sort(riders.begin(), riders.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(crowd.bodies[a].begin.y(), a) < std::pair(crowd.bodies[b].begin.y(), b);
    });
    for (const std::uint32_t i : riders) {
        Body& body = crowd.bodies[i];
        const Body* carrier = nullptr;
        double best = 0.0;
        for (const std::uint32_t k : crowd.near.of(i)) {
            const Body& lower = crowd.bodies[k];
            const Vec3 q = apart(body, body.begin, lower, lower.begin);
            const double up = touch_at(body, lower, q).normal.y();
            if (!(q.norm() < touching) || up < body.walkable || up <= best || !meet(body, lower)) continue;
            carrier = &lower;
            best = up;
        }
        if (carrier == nullptr) continue;
        PlayerState& state = body.member->state;
        shift(crowd.scene, body, carrier->end - carrier->begin);
        const Vec3 kept = kept_on_leave(body.member->settings->leave_mode, carrier->velocity);
        state.velocity += kept;
        if (!state.grounded && !body.held()) state.air_frame = kept;
        body.velocity = (body.end - body.begin) / dt;
    }
}

void stand(const Body& upper, const Body& lower, const Vec3& normal, PlayerState& state) {
    if (state.velocity.y() > std::max(lower.velocity.y(), 0.0)) return;  // it jumps off
    const double height = upper.radii().y();
    state.velocity = horizontal(state.velocity - lower.velocity);
    state.air_frame = Vec3::Zero();
    state.carrier = Carrier::character;
    state.grounded = true;
    state.jumping = false;
    state.ground_normal = normal;
    state.ground_face = no_id;
    state.ground_surface = default_surface;
    state.ground_platform = no_id;
    state.ground_rise = height - height * height * normal.y() / upper.radii().cwiseProduct(normal).norm();
}

// Bodies that touch lose the speed at which they approach each other; one on top of another stands on it.
void settle(Crowd& crowd) {
    std::vector<Vec3> before;
    for (const Body& body : crowd.bodies)
        before.push_back(body.member->state.velocity);
    crowd.each([&](std::size_t i, const Body& body) {
        Pushes brakes;
        const Body* ground = nullptr;
        Vec3 normal = Vec3::Zero();
        for (const std::uint32_t k : crowd.near.of(i)) {
            const Body& other = crowd.bodies[k];
            const std::optional<Touch> touch = end_touch(body, other, touching);
            if (!touch || stands_on(other, -touch->normal)) continue;
            if (stands_on(body, touch->normal)) {
                if (touch->normal.y() > normal.y()) normal = touch->normal, ground = &other;
                continue;
            }
            const Vec3 away = sideways(body, other, touch->normal);
            brakes.add(-fraction_of(body, other) * std::min(0.0, (before[i] - before[k]).dot(away)) * away);
        }
        PlayerState& state = body.member->state;
        if (!body.held()) state.velocity += brakes.together(1.0);
        if (ground != nullptr) stand(body, *ground, normal, state);
    });
}

}  // namespace

void step_many(const MovementScene& scene, std::span<CrowdMember> members, double dt) {
    parallel_for(members.size(), grain, [&](std::size_t first, std::size_t last) {
        for (CrowdMember& member : members.subspan(first, last - first))
            member.state = stepped(scene, member, dt);
    });
}

void step_crowd(const MovementScene& scene, std::span<CrowdMember> members, double dt) {
    Crowd crowd(scene);
    std::vector<Vec3> places;
    std::vector<CrowdMember*> usable;
    for (CrowdMember& member : members) {
        const Vec3 begin = position_in_scene(scene, member.state);
        const MovementSettings& settings = *member.settings;
        if (!begin.allFinite() || !is_finite(settings) || !(settings.radii.minCoeff() > 0.0)) continue;
        places.push_back(begin);
        usable.push_back(&member);
    }
    if (usable.empty()) return;
    crowd.bodies.reserve(usable.size());
    for (const std::uint32_t i : spatial_order(places)) {
        const PlayerState& state = usable[i]->state;
        const Vec2& wish = usable[i]->input.wish;
        crowd.bodies.push_back({.member = usable[i],
                                .settings = usable[i]->settings,
                                .begin = places[i],
                                .walkable = slope_cosine(usable[i]->settings->max_slope),
                                .wish = Vec3(wish.x(), 0.0, wish.y()),
                                .rides = state.grounded && state.carrier == Carrier::character});
    }
    crowd.each([&](std::size_t, Body& body) {
        body.member->state = stepped(scene, *body.member, dt);
        body.end = position_in_scene(scene, body.member->state);
    });
    std::deque<MovementSettings> crouched;
    for (Body& body : crowd.bodies)
        if (body.member->state.crouched)
            body.settings =
                &crouched.emplace_back(settings_of_body(*body.member->settings, body.member->state));
    carry_riders(crowd, dt);
    crowd.find_near();
    crowd.take_apart();
    settle(crowd);
    crowd.each([&](std::size_t, const Body& body) { put_in_scene(scene, body.end, body.member->state); });
}

}  // namespace slipface
