// Stairs drawn from a seed, and a player who walks up or down them. Shared by tst_stairs.cpp and
// bench/stairs.cpp (slipface_stairs).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "test_geometry.h"

namespace slipface::test {

// One stair and one walk on it. Along is +X, up the stair, before the turn about +Y and the shift.
struct Stair {
    std::uint64_t seed = 0;
    double rise = 0.2, run = 0.3;  // m
    int steps = 5;
    double step_height = 0.35;  // m; the setting
    double radius = 0.4, half_height = 0.9;
    double max_slope = radians(50);
    double rate = 60.0, speed = 5.0;  // Hz, m/s
    double approach = 0.0;            // radians off straight on, -80 to 80 degrees
    bool left_wall = false, right_wall = false;
    bool down = false;
    StepForm form = StepForm::when_blocked;
    double turn = 0.0;  // radians about +Y
    Vec3 shift = Vec3::Zero();
    int strips = 1;  // the width is cut into
};

struct StairWalk {
    bool arrived = false;  // up: on the landing; down: on the floor below
    int ticks = 0;         // on the stair
    int airborne = 0;      // of them
    int overlaps = 0;
    double highest = 0.0;  // of the feet above the floor, m
    double seconds = 0.0;
    double ideal_seconds = 0.0;
};

inline Stair random_stair(std::uint64_t seed, bool steep = false) {
    Random random(seed * 2654435761ULL + 17);
    for (int i = 0; i < 8; ++i)
        random.between(0.0, 1.0);
    Stair s;
    s.seed = seed;
    s.radius = random.between(0.2, 0.6);
    // Heights of 0.8 to 2 m, and spheres.
    s.half_height = random.below(3) == 0 ? s.radius : random.between(0.4, 1.0);
    const double highest = std::min(0.6, s.half_height);
    s.step_height = random.between(0.1, highest);
    s.rise = random.below(4) == 0 ? s.step_height : random.between(0.03, s.step_height);
    s.run = steep ? s.rise * random.between(0.4, 1.0) : s.rise * random.between(1.0, 3.0);
    s.steps = 1 + random.below(12);
    if (random.below(3) == 0) s.max_slope = radians(random.between(30.0, 60.0));
    constexpr std::array<double, 7> rates{30.0, 50.0, 60.0, 120.0, 144.0, 240.0, 360.0};
    s.rate = rates[static_cast<std::size_t>(random.below(7))];
    s.speed = random.between(1.0, 10.0);
    s.approach = radians(random.below(4) == 0 ? 0.0 : random.between(-80.0, 80.0));
    const int walls = random.below(4);
    s.left_wall = walls == 1 || walls == 3;
    s.right_wall = walls == 2 || walls == 3;
    s.down = random.below(2) == 0;
    s.turn = random.below(3) == 0 ? 0.0 : random.between(-pi, pi);
    if (random.below(2) == 0)
        s.shift =
            Vec3(random.between(-100.0, 100.0), random.between(-20.0, 20.0), random.between(-100.0, 100.0));
    s.strips = 1 + random.below(4);
    return s;
}

inline std::string text_of(const Stair& s) {
    char text[400];
    std::snprintf(
        text, sizeof text,
        "seed %llu: %s %d steps of %.3f x %.3f m (%.0f deg), step height %.3f, radius %.2f, height %.2f, "
        "slope limit %.0f, %.0f Hz, %.1f m/s, approach %.0f deg, walls %d%d, turn %.2f",
        static_cast<unsigned long long>(s.seed), s.down ? "down" : "up", s.steps, s.rise, s.run,
        std::atan2(s.rise, s.run) * 180.0 / pi, s.step_height, s.radius, 2.0 * s.half_height,
        s.max_slope * 180.0 / pi, s.rate, s.speed, s.approach * 180.0 / pi, s.left_wall, s.right_wall,
        s.turn);
    return text;
}

inline MovementSettings settings_of(const Stair& s) {
    MovementSettings m;
    m.radii = Vec3(s.radius, s.half_height, s.radius);
    m.walk_speed = s.speed;
    m.max_slope = s.max_slope;
    m.step_up = m.snap_down = true;
    m.step_height = m.snap_distance = s.step_height;
    m.step_form = s.form;
    return m;
}

// The stair's own frame and the scene's.
struct StairFrame {
    double cosine, sine;
    Vec3 shift;

    explicit StairFrame(const Stair& s) : cosine(std::cos(s.turn)), sine(std::sin(s.turn)), shift(s.shift) {}
    Vec3 turned(const Vec3& v) const {
        return {cosine * v.x() + sine * v.z(), v.y(), cosine * v.z() - sine * v.x()};
    }
    Vec3 out(const Vec3& v) const { return turned(v) + shift; }
    Vec3 in(const Vec3& p) const {
        const Vec3 v = p - shift;
        return {cosine * v.x() - sine * v.z(), v.y(), cosine * v.z() + sine * v.x()};
    }
};

// Rectangles given by a corner and two sides, cut into `strips` along the second, each into two triangles by
// one of its diagonals.
class StairBuilder {
  public:
    StairBuilder(Lab& lab, const Stair& stair)
        : lab_(lab), frame_(stair), strips_(stair.strips), random_(stair.seed + 99) {}

    void rectangle(const Vec3& corner, const Vec3& side, const Vec3& across) {
        const int strips = 1 + random_.below(strips_);
        for (int i = 0; i < strips; ++i) {
            const Vec3 a = corner + across * (static_cast<double>(i) / strips);
            const Vec3 b = corner + across * (static_cast<double>(i + 1) / strips);
            const std::array<Vec3, 4> p{frame_.out(a), frame_.out(a + side), frame_.out(b + side),
                                        frame_.out(b)};
            if (random_.below(2) == 0) {
                lab_.polygon({p[0], p[1], p[2], p[3]});
            } else {
                lab_.polygon({p[1], p[2], p[3], p[0]});
            }
        }
    }

  private:
    Lab& lab_;
    StairFrame frame_;
    int strips_;
    Random random_;
};

// A floor, the stair, a landing; walls along the sides where the stair has them.
inline void build_stair(Lab& lab, const Stair& s) {
    StairBuilder builder(lab, s);
    const double length = s.steps * s.run;
    const double lateral = (length + 2.0) * std::tan(std::abs(s.approach)) + 3.0;
    const double left = s.left_wall ? -2.0 * s.radius : -lateral;
    const double right = s.right_wall ? 2.0 * s.radius : lateral;
    const Vec3 across(0.0, 0.0, right - left);
    const double before = 4.0 + s.speed;  // m of floor and of landing
    builder.rectangle({-before, 0.0, left}, {before, 0.0, 0.0}, across);
    for (int i = 0; i < s.steps; ++i) {
        const double x = i * s.run;
        const double y = i * s.rise;
        builder.rectangle({x, y, left}, {0.0, s.rise, 0.0}, across);
        const double depth = i + 1 == s.steps ? before : s.run;
        builder.rectangle({x, y + s.rise, left}, {depth, 0.0, 0.0}, across);
    }
    for (const bool is_left : {true, false}) {
        if (!(is_left ? s.left_wall : s.right_wall)) continue;
        const double z = is_left ? left : right;
        builder.rectangle({-before, -1.0, z}, {length + 2.0 * before, 0.0, 0.0},
                          {0.0, s.steps * s.rise + 6.0, 0.0});
    }
    lab.ready();
}

inline StairWalk walk_stair(const Stair& s, const MovementSettings& m) {
    Lab lab;
    build_stair(lab, s);
    const StairFrame frame(s);
    const double length = s.steps * s.run;
    const double top = s.steps * s.rise;
    const double dt = 1.0 / s.rate;

    // Begins a metre off, along its own heading, so that the sideways way fits on the stair.
    const double sign = s.down ? -1.0 : 1.0;
    const double begin = s.down ? length - s.run + s.radius + 1.0 : -s.radius - 1.0;
    const double sideways = std::sin(s.approach);
    double z = 0.0;
    if (!s.left_wall && !s.right_wall) z = -0.5 * (length + 2.0) * std::tan(s.approach);
    if (s.left_wall != s.right_wall) z = (sideways > 0.0) == s.left_wall ? 0.0 : -sideways;
    const Vec3 heading = frame.turned({sign * std::cos(s.approach), 0.0, sideways});
    PlayerState state = at(frame.out({begin, (s.down ? top : 0.0) + s.half_height + m.skin, z}));
    const PlayerInput still;
    const PlayerInput input{.wish = Vec2(heading.x(), heading.z())};
    for (int i = 0; i < 5; ++i)
        state = step(lab.scene(), m, state, still, dt).state;

    StairWalk walk;
    // At the end of the stair the centre is a radius past the last rim.
    const double goal = s.down ? -s.radius : length - s.run + s.radius;
    const double motion = std::abs(goal - begin);
    walk.ideal_seconds = motion / (s.speed * std::cos(s.approach));
    const int maximum = static_cast<int>(s.rate * (4.0 * walk.ideal_seconds + 1.0));
    for (int i = 0; i < maximum && !walk.arrived; ++i) {
        state = step(lab.scene(), m, state, input, dt).state;
        const Vec3 p = frame.in(state.position);
        const double feet = p.y() - s.half_height;
        walk.highest = std::max(walk.highest, feet);
        if (overlaps_any(lab.world(), m.radii, state.position)) ++walk.overlaps;
        const bool there = s.down ? p.x() < goal : p.x() > goal;
        ++walk.ticks;
        if (!state.grounded) ++walk.airborne;
        const double aim = s.down ? 0.0 : top;
        walk.arrived = there && std::abs(feet - aim) < 0.01 && state.grounded;
        walk.seconds += dt;
    }
    return walk;
}

inline StairWalk walk_stair(const Stair& s) {
    return walk_stair(s, settings_of(s));
}

// --- What must not be climbed
// -----------------------------------------------------------------------------------------------------

enum class Barrier { kerbs, ramp, planks, boards, jumped_wall, cliff };
inline constexpr std::array<const char*, 6> barrier_names{
    "stairs of 1 to 30 % more than a step",  "ramps 1 to 30 degrees too steep",
    "fences of planks 1 to 30 % too high",   "fences of boards, one above the other",
    "walls above a jump's reach, jumped at", "cliffs, stopped at with the centre past the edge"};

// How high above the floor the round foot is where it is as steep as the slope limit; the skin keeps it off
// the floor. What is lower is walked over as ground is, without step up.
inline double foot_height(const Stair& s) {
    const double flat = s.radius * std::sin(s.max_slope);
    const double high = s.half_height * std::cos(s.max_slope);
    return settings_of(s).skin + s.half_height * (1.0 - high / std::sqrt(flat * flat + high * high));
}

// A stair whose fields say how to walk; the barrier is `rise` high and stands at x = 0.
inline Stair random_barrier(std::uint64_t seed, Barrier kind) {
    Stair s = random_stair(seed * 6 + static_cast<std::uint64_t>(kind));
    Random random(seed + 4242);
    s.down = false;
    s.steps = kind == Barrier::kerbs ? 1 + random.below(4) : 1;
    const double least = std::max(s.step_height, foot_height(s));
    s.rise = least * random.between(1.01, 1.3);
    s.run = std::max(s.rise, 0.1) * random.between(0.3, 2.0);
    if (kind == Barrier::ramp) {
        const double angle = std::min(s.max_slope + radians(random.between(1.0, 30.0)), radians(85));
        s.rise = least + random.between(0.1, 2.0);
        s.run = s.rise / std::tan(angle);
    }
    if (kind == Barrier::boards) s.rise = random.between(1.5, 3.0);
    if (kind == Barrier::jumped_wall) {
        const MovementSettings m = settings_of(s);
        s.rise = 0.5 * m.jump_speed * m.jump_speed / m.gravity + foot_height(s) +
                 random.between(0.05, s.step_height + 0.1);
    }
    if (kind == Barrier::cliff) s.rise = s.step_height * random.between(1.05, 5.0);
    return s;
}

inline void build_barrier(Lab& lab, const Stair& s, Barrier kind) {
    if (kind == Barrier::kerbs || kind == Barrier::jumped_wall || kind == Barrier::cliff)
        return build_stair(lab, s);
    StairBuilder builder(lab, s);
    Random random(s.seed + 7);
    const double half = 3.0 + 2.0 * std::tan(std::abs(s.approach));
    const Vec3 across(0.0, 0.0, 2.0 * half);
    builder.rectangle({-20.0, 0.0, -half}, {40.0, 0.0, 0.0}, across);
    const auto box = [&](const Vec3& low, const Vec3& high) {
        const Vec3 d = high - low;
        const Vec3 x(d.x(), 0, 0), y(0, d.y(), 0), z(0, 0, d.z());
        builder.rectangle(low, y, z);
        builder.rectangle(low + x, y, z);
        builder.rectangle(low + y, x, z);
        builder.rectangle(low, x, z);
        builder.rectangle(low, x, y);
        builder.rectangle(low + z, x, y);
    };
    if (kind == Barrier::ramp) {
        builder.rectangle({0.0, 0.0, -half}, {s.run, s.rise, 0.0}, across);
        builder.rectangle({s.run, s.rise, -half}, {20.0, 0.0, 0.0}, across);
    } else if (kind == Barrier::planks) {
        const double thick = random.between(0.01, 0.05);
        const double gap = s.radius * random.between(0.1, 0.6);
        for (double z = -half; z < half; z += 0.1 + gap)
            box({0.0, 0.0, z}, {thick, s.rise, z + 0.1});
    } else {
        const double thick = random.between(0.01, 0.05);
        const double spacing = std::max(s.step_height * random.between(0.3, 1.0), 0.08);
        for (double y = spacing; y < s.rise; y += spacing)
            box({0.0, y - 0.03, -half}, {thick, y, half});
    }
    lab.ready();
}

struct BarrierWalk {
    bool beaten = false;  // climbed, or hung on to
    int overlaps = 0;
};

inline BarrierWalk walk_barrier(const Stair& s, Barrier kind, const MovementSettings& m) {
    Lab lab;
    build_barrier(lab, s, kind);
    const StairFrame frame(s);
    const double dt = 1.0 / s.rate;
    const bool falls = kind == Barrier::cliff;
    const double sign = falls ? -1.0 : 1.0;
    const double begin = falls ? s.radius + 0.1 : -s.radius - 0.5;
    const Vec3 heading = frame.turned({sign * std::cos(s.approach), 0.0, std::sin(s.approach)});
    PlayerState state = at(frame.out({begin, (falls ? s.rise : 0.0) + s.half_height + m.skin, 0.0}));
    for (int i = 0; i < 5; ++i)
        state = step(lab.scene(), m, state, {}, dt).state;

    BarrierWalk walk;
    Random random(s.seed + 5);
    const double stop = -s.radius * random.between(0.0, 1.0);  // where the stick is let go, at a cliff
    bool let_go = false;
    const int ticks = static_cast<int>(s.rate * 4.0);
    for (int i = 0; i < ticks; ++i) {
        PlayerInput input{.wish = Vec2(heading.x(), heading.z())};
        if (falls && frame.in(state.position).x() < stop) let_go = true;
        if (let_go) input.wish = Vec2::Zero();
        if (kind == Barrier::jumped_wall)
            input.buttons.set(Button::jump, i % static_cast<int>(s.rate / 4.0) == 0);
        state = step(lab.scene(), m, state, input, dt).state;
        if (overlaps_any(lab.world(), m.radii, state.position)) ++walk.overlaps;
        const Vec3 p = frame.in(state.position);
        const double feet = p.y() - s.half_height;
        if (!falls && state.grounded && feet > s.step_height + 0.01) walk.beaten = true;
    }
    if (falls) {
        // An edge is stood on where it is no steeper than the slope limit.
        const double tangent = std::sin(s.max_slope) / std::cos(s.max_slope);
        const double reach =
            s.radius * s.radius * tangent /
            std::sqrt(s.radius * s.radius * tangent * tangent + s.half_height * s.half_height);
        const Vec3 p = frame.in(state.position);
        walk.beaten = state.grounded && p.x() < -reach - 0.02 && p.y() - s.half_height > 0.05;
    }
    return walk;
}

inline BarrierWalk walk_barrier(const Stair& s, Barrier kind) {
    return walk_barrier(s, kind, settings_of(s));
}

}  // namespace slipface::test
