// Demos of walking on ground that does not move.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "demos.h"
#include "shapes.h"

namespace slipface {

namespace {

// The height of the centre of a player whose feet touch a slope of `angle` radians that has the height `y`
// below the centre.
double standing(const MovementSettings& s, double y, double angle = 0.0) {
    const double up = std::cos(angle), along = std::sin(angle);
    return y + std::sqrt(std::pow(s.radii.y() * up, 2) + std::pow(s.radii.z() * along, 2)) / up + s.skin / up;
}

}  // namespace

Demo demo_of(Level level, const Vec3& spawn, const MovementSettings& on, const char* inputs, const Vec3& eye,
             const Vec3& target) {
    Demo demo;
    demo.level = std::move(level);
    demo.level.spawn = spawn;
    demo.on = on;
    // The texts of the demos are valid tapes; a test reads all of them.
    demo.tape = parse_tape(std::string("slipface-tape 1\ndt 1/60\n") + inputs, "demo").value();
    demo.tape.start = spawn;  // exact, even if a spawn there would be pushed out of a wall
    demo.camera = {.name = "", .eye = eye, .target = target};
    return demo;
}

SurfaceType painted(const char* name, const std::array<float, 3>& color) {
    SurfaceType type;
    type.name = name;
    type.color = color;
    return type;
}

namespace {

const auto ground_rows = std::to_array<DemoInfo>({
    {"static-friction", "static_friction", "Static friction",
     "Gravity makes a player that stands on a slope creep down it.",
     "Let only the horizontal part of the move slide.",
     [] {
         MovementSettings on = basic_settings();
         const double angle = pi / 6;
         Shapes shapes;
         shapes.material("plaster").box({-7, -0.5, -12}, {7, 0, 8}).material("brick");
         shapes.ramp({-3, 0, 2}, 6, 10, 10 * std::tan(angle));
         const Vec3 spawn(0, standing(on, 3.5 * std::tan(angle), angle), -1.5);
         return demo_of(shapes.level(), spawn, on, "600 wish 0,0\n", {11, 6, 4}, {0, 1.6, -0.5});
     }},
    {"ground-velocity", "ground_velocity", "Ground velocity",
     "With no vertical velocity on the ground a player hops down ramps.",
     "Press it down as fast as the slope falls.",
     [] {
         MovementSettings on = basic_settings();
         const double rise = 14 * std::tan(pi / 6);
         Shapes shapes;
         shapes.material("plaster")
             .box({-6, -0.5, -26}, {6, 0, 12})
             .material("brick")
             .ramp({-2, 0, 4}, 4, 14, rise);
         shapes.material("stone").box({-2, 0, -20}, {2, rise, -10});
         return demo_of(shapes.level(), {0, standing(on, rise), -14}, on, "20 wish 0,0\n190 wish 0,1\n",
                        {17, 7, -2}, {0, 3, -3});
     }},
    // A stripe along the heading is painted over floor and ramp, and the camera looks straight down: a path
    // that leaves the stripe has been deflected.
    {"straight-ahead", "straight_ahead", "Straight ahead on ramps",
     "A ramp that is hit at an angle turns the player aside.",
     "Keep the heading, and change only the height.",
     [] {
         MovementSettings on = basic_settings();
         constexpr double left = -12, right = 10, near = 7, far = -8;
         const double slope = std::tan(pi / 6), half = 0.35;
         // The x at which the middle of the stripe crosses a line of constant z: from the spawn at (-6, 5) at
         // 45 degrees.
         const auto middle = [](double z) { return -1.0 - z; };
         Shapes shapes;
         const auto strip = [&](double from, double to, double x0_from, double x1_from, double x0_to,
                                double x1_to) {
             const double low = std::max(0.0, -from) * slope, high = std::max(0.0, -to) * slope;
             shapes.polygon(
                 {{x0_from, low, from}, {x1_from, low, from}, {x1_to, high, to}, {x0_to, high, to}});
         };
         for (const auto& [from, to] : {std::pair{near, 0.0}, std::pair{0.0, far}}) {
             const double a = middle(from), b = middle(to);
             shapes.material("plaster");
             strip(from, to, left, a - half, left, b - half);
             strip(from, to, a + half, right, b + half, right);
             shapes.material("plaster__stripe");
             strip(from, to, a - half, a + half, b - half, b + half);
         }
         Demo demo =
             demo_of(shapes.level(), {-6, standing(on, 0), 5}, on,
                     "10 wish 0,0\n150 wish 0.70710678,-0.70710678\n", {-1, 60, -0.5}, {-1, 1.5, -0.5});
         demo.camera.fov_y = 0.3;
         demo.level.surfaces.push_back(painted("stripe", {0.30F, 0.55F, 0.85F}));
         return demo;
     }},
    {"constant-slope-speed", "constant_slope_speed", "Constant slope speed",
     "Down a slope a player that walks as fast on the map is faster than on the flat.",
     "Count the speed along the slope.",
     [] {
         MovementSettings on = basic_settings();
         on.constant_slope_speed = true;
         const double rise = 10 * std::tan(2 * pi / 9);
         Shapes shapes;
         shapes.material("plaster").box({-5, -0.5, -12}, {5, 0, 12}).material("brick");
         shapes.ramp({-2, 0, 4}, 4, 10, rise);
         shapes.material("stone").box({-2, 0, -10}, {2, rise, -6});
         return demo_of(shapes.level(), {0, standing(on, rise), -7}, on, "20 wish 0,0\n100 wish 0,1\n",
                        {16, 7, 0}, {0, 3, -1});
     }},
    {"keep-energy", "keep_energy", "Keep energy", "Each flat face of a half-pipe takes speed away.",
     "At a glancing hit turn the velocity, and keep its length.",
     [] {
         MovementSettings on = basic_settings();
         on.slippery_acceleration = 0.0;
         constexpr int segments = 12;
         const double radius = 5.0;
         Shapes shapes;
         shapes.material("metal__ice");
         for (int i = 0; i < segments; ++i) {
             const double a = pi * (1.0 + static_cast<double>(i) / segments);
             const double b = pi * (1.0 + static_cast<double>(i + 1) / segments);
             const Vec3 p(radius * std::cos(a), radius + radius * std::sin(a), 6);
             const Vec3 q(radius * std::cos(b), radius + radius * std::sin(b), 6);
             const Vec3 back(0, 0, -12);
             shapes.polygon({p, q, q + back, p + back});
         }
         shapes.material("plaster").box({-9, 4.5, -6}, {-5.02, 5, 6}).box({5.02, 4.5, -6}, {9, 5, 6});
         return demo_of(shapes.level(), {-4.2, 5.2, 0}, on, "240 wish 0,0\n", {0, 6.5, 15}, {0, 2.6, 0});
     }},
    // Walking straight out of the wedge also works with the switch off. So the stick pushes across the wedge,
    // past the end of the right wall; each component of that leads further into one of the walls.
    {"push-out", "push_out", "Push-out", "A player that begins inside a wedge cannot move across it.",
     "Put it onto the common line of both planes.",
     [] {
         MovementSettings on = basic_settings();
         on.push_out = PushOut::analytic;
         const double half = pi / 18;
         const Vec3 apex(0, 0, -3);
         const auto rim = [&](double side) {
             return Vec3(apex + 1.7 * Vec3(side * std::sin(half), 0, std::cos(half)));
         };
         const Vec3 up(0, 2.0, 0);
         Shapes shapes;
         shapes.material("plaster").box({-2.5, -0.5, -4}, {4.5, 0, 0.6}).material("brick");
         shapes.polygon({apex, rim(-1), rim(-1) + up, apex + up});
         shapes.polygon({rim(1), apex, apex + up, rim(1) + up});
         Demo demo = demo_of(shapes.level(), {0, standing(on, 0), -1.6}, on,
                             "20 wish 0,0\n40 wish 0.9,-0.43\n", {1, 15, 4}, {1, 0.5, -1.5});
         demo.camera.fov_y = 0.35;
         return demo;
     }},
    // Four posts with less room between them than the player's width: a player inside touches all of them,
    // and every direction leads further into one.
    {"nudge", "nudge", "Nudge", "Between posts on all sides there is no plane to push out of.",
     "Try small offsets in 26 directions.",
     [] {
         MovementSettings on = basic_settings();
         on.nudge = true;
         on.nudge_distance = 0.8;
         Shapes shapes;
         shapes.material("plaster").box({-2, -0.5, -2}, {4.5, 0, 4}).material("brick");
         for (const double x : {-0.33, 0.33}) {
             for (const double z : {-0.33, 0.33})
                 shapes.box({x - 0.06, 0, z - 0.06}, {x + 0.06, 2.2, z + 0.06});
         }
         return demo_of(shapes.level(), {0, standing(on, 0), 0}, on,
                        "20 wish 0,0\n20 wish 1,0\n20 wish 0,1\n", {3.6, 3.6, 3.8}, {1.1, 0.7, 0.5});
     }},
    {"step-up", "step_up", "Step up", "Stairs act as a wall.",
     "Lift the player by a step, move it, and drop it again.",
     [] {
         MovementSettings on = basic_settings();
         on.step_up = true;
         on.snap_down = true;
         Shapes shapes;
         shapes.material("plaster").box({-6, -0.5, -14}, {6, 0, 6});
         shapes.material("stone").stairs({-2, 0, 0}, 4, 10, 0.3, 0.4);
         shapes.box({-2, 0, -8}, {2, 3, -4});
         return demo_of(shapes.level(), {0, standing(on, 0), 3}, on, "10 wish 0,0\n110 wish 0,-1\n",
                        {10, 5, 3}, {0, 1.8, -2});
     }},
    {"bounce", "bounce", "Bounce", "A slide takes away all of the speed into a trampoline.",
     "Negate that part of the velocity, times a coefficient.",
     [] {
         MovementSettings on = basic_settings();
         Shapes shapes;
         shapes.material("plaster")
             .box({-8, -0.5, -3}, {12, 0, 3})
             .material("wood__bouncy")
             .box({-5, 0, -2}, {10, 0.2, 2});
         return demo_of(shapes.level(), {-4, 5, 0}, on, "300 wish 0.35,0\n", {2, 3.5, 14}, {2, 2, 0});
     }},
    {"sticky", "stick", "Sticky", "A player that jumps at a wall slides off it.",
     "While a sticky face holds it: no velocity, no gravity.",
     [] {
         MovementSettings on = basic_settings();
         Shapes shapes;
         shapes.material("plaster")
             .box({-5, -0.5, -6}, {5, 0, 5})
             .material("stone")
             .box({-3, 0, -4}, {3, 4, -2});
         shapes.material("stone__sticky")
             .polygon({{-3, 0, -1.98}, {3, 0, -1.98}, {3, 4, -1.98}, {-3, 4, -1.98}});
         // The jump hits the wall near its highest point, 2.4 m away; the stick continues to push.
         return demo_of(shapes.level(), {0, standing(on, 0), 2.6}, on,
                        "10 wish 0,0\n20 wish 0,-1\n30 wish 0,-1 jump\n60 wish 0,-1\n", {8, 4, 3.5},
                        {0, 1.6, -0.8});
     }},
    {"snap-down", "snap_down", "Snap to floor", "Down stairs a player leaves the ground at every step.",
     "After the move, sweep down to ground that is near.",
     [] {
         MovementSettings on = basic_settings();
         on.step_up = true;
         on.snap_down = true;
         Shapes shapes;
         shapes.material("plaster").box({-6, -0.5, -14}, {6, 0, 8});
         shapes.material("stone").stairs({-2, 0, 0}, 4, 10, 0.3, 0.4);
         shapes.box({-2, 0, -8}, {2, 3, -4});
         return demo_of(shapes.level(), {0, standing(on, 3), -6}, on, "10 wish 0,0\n100 wish 0,1\n",
                        {10, 5, 3}, {0, 1.8, -1});
     }},
    // The floor is modelled at the end of its rise.
    {"seam-filter", "seam_filter", "Seam filter",
     "A floor that rises into the player stops it at the edges of triangles.",
     "At an edge inside a smooth floor take the floor's normal.",
     [] {
         MovementSettings on = basic_settings();
         on.seam_filter = true;
         // A floor that rises into the player, as in a game that moves its geometry without platforms.
         on.platforms = false;
         constexpr double rise = 0.8, x = 3, front = 5, back = -11;
         Shapes shapes;
         shapes.material("plaster").box({-6, -1.4, -13}, {6, -rise - 0.1, 8}).group("lift").material("stone");
         shapes.floor({-x, 0, back}, {x, 0, front}, 0.8);
         const std::array<Vec3, 4> rim{{{-x, 0, front}, {x, 0, front}, {x, 0, back}, {-x, 0, back}}};
         for (std::size_t i = 0; i < 4; ++i) {
             const Vec3 &a = rim.at(i), &b = rim.at((i + 1) % 4), down(0, -rise, 0);
             shapes.polygon({a, a + down, b + down, b});
         }
         Demo demo = demo_of(shapes.level(), {0.1, standing(on, -rise), 3}, on, "120 wish 0.05,-0.998\n",
                             {9, 4, 5}, {0, 0, -3});
         Platform lift;
         lift.name = "lift";
         lift.group = "lift";
         lift.repeat = PathRepeat::once;
         lift.path = {{.offset = {0, -rise, 0}, .speed = 2.0}, {.offset = {0, 0, 0}, .speed = 2.0}};
         demo.level.platforms = {lift};
         return demo;
     }},
    {"surface-types", "surface_types", "Surface types",
     "A ladder acts as a wall, and a conveyor stands still.", "Give faces types, which choose the response.",
     [] {
         MovementSettings on = basic_settings();
         Shapes shapes;
         shapes.material("plaster")
             .box({-6, -0.5, -10}, {6, 0, 6})
             .material("stone")
             .box({-3, 0, -8}, {3, 4, -2});
         shapes.material("wood__ladder")
             .polygon({{-0.6, 0, -1.98}, {0.6, 0, -1.98}, {0.6, 4, -1.98}, {-0.6, 4, -1.98}});
         shapes.material("metal__conveyor")
             .polygon({{-1, 4.01, -2.6}, {1, 4.01, -2.6}, {1, 4.01, -8}, {-1, 4.01, -8}});
         return demo_of(shapes.level(), {0, standing(on, 0), 2}, on,
                        "10 wish 0,0\n170 wish 0,-1\n60 wish 0,0\n", {9, 6, 5}, {0, 2.2, -3});
     }},
});

}  // namespace

std::span<const DemoInfo> ground_demos() {
    return ground_rows;
}

}  // namespace slipface
