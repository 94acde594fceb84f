// Demos of jumping, of moving things, and of worlds that are not only triangles.
#include <algorithm>
#include <array>
#include <cmath>

#include "demos.h"
#include "shapes.h"
#include "slipface/level/level_file.h"

namespace slipface {

namespace {

// Two ledges with a gap of `gap` metres along -Z from z = 0.
Shapes ledges(double gap) {
    Shapes shapes;
    shapes.material("plaster").box({-5, -4.5, -16}, {5, -4, 10});
    shapes.material("stone").box({-2, -4, 0}, {2, 0, 8}).box({-2, -4, -gap - 6}, {2, 0, -gap});
    return shapes;
}

const auto air_rows = std::to_array<DemoInfo>({
    {"heightfield", "heightfield", "Heightfield", "Terrain that is only heights has no triangles to hit.",
     "Lift the player to the height below it.",
     [] {
         MovementSettings on = basic_settings();
         constexpr int side = 33;
         Shapes shapes;
         shapes.material("stone").box({-2, 0, 6}, {2, 2.4, 9});
         // Posts at the far corners, so that the bounds of the mesh, which frame the images, include the
         // hills.
         shapes.box({-11.9, -1, -13.9}, {-11.5, 2.6, -13.5}).box({11.5, -1, -13.9}, {11.9, 2.6, -13.5});
         Demo demo = demo_of(shapes.level(), {0, standing_on_flat(on, 2.4), 7.5}, on,
                             "20 wish 0,0\n145 wish 0,-1\n", {13, 8, 11}, {0, 0.5, -1});
         demo.level.heightfield = HeightfieldSource{.file = "heightfield-terrain.png",
                                                    .origin = {-12, 0, -14},
                                                    .size = {24, 28},
                                                    .low = -1.0,
                                                    .high = 2.0};
         GreyImage image{.width = side, .height = side, .values = {}};
         for (int row = 0; row < side; ++row) {
             for (int column = 0; column < side; ++column) {
                 const double x = column / 5.0, z = row / 4.0;
                 const double wave = 0.5 + 0.25 * std::sin(x) * std::cos(z) + 0.2 * std::sin(0.6 * z + 1.0);
                 image.values.push_back(static_cast<std::uint16_t>(std::clamp(wave, 0.0, 1.0) * 65535.0));
             }
         }
         demo.level.terrain =
             std::make_shared<const Heightfield>(make_heightfield(*demo.level.heightfield, image));
         return demo;
     }},
    {"sectors", "sectors", "Sectors", "A million metres out, rounded coordinates close a gate.",
     "Compute in the coordinates of the player's sector.",
     [] {
         MovementSettings on = basic_settings();
         // A tilted floor of small tiles: a corner that is moved sideways is also too high or too low.
         Shapes shapes;
         shapes.material("stone");
         const auto height = [](double x, double z) { return 0.25 * x - 0.15 * z; };
         const auto corner = [&](int i, int k) {
             const double x = 0.57 * i - 4.0, z = 0.57 * k - 12.0;
             return Vec3(x, height(x, z), z);
         };
         for (int k = 0; k < 32; ++k) {
             for (int i = 0; i < 14; ++i)
                 shapes.polygon({corner(i, k), corner(i, k + 1), corner(i + 1, k + 1), corner(i + 1, k)});
         }
         // Gates 0.81 m wide for a player of 0.8 m. A million metres out the positions of their posts are
         // rounded to multiples of 0.0625 m, which leaves 0.75 m.
         constexpr double gate = 0.405;
         shapes.material("brick");
         for (const double z : {0.0, -3.0, -6.0}) {
             const double low = height(0, z) - 0.8, high = height(0, z) + 2.4;
             shapes.box({-gate - 0.3, low, z - 0.2}, {-gate, high, z + 0.2});
             shapes.box({gate, low, z - 0.2}, {gate + 0.3, high, z + 0.2});
         }
         Demo demo = demo_of(shapes.level(), {0, standing_on_flat(on, 0), 3.1}, on,
                             "30 wish 0,0\n120 wish 0,-0.9\n", {6, 4.5, 5}, {0.5, 1, -1.5});
         demo.level.sectors = {.size = 1000.0, .placement = {1e6, 0, -1e6}};
         return demo;
     }},
    {"leave-mode", "leave_mode", "Velocity kept on leaving",
     "A jump off a moving cart loses the cart's velocity.", "Keep the velocity of the ground that was left.",
     [] {
         MovementSettings on = basic_settings();
         Shapes shapes;
         shapes.material("plaster").box({-5, -4.5, -16}, {5, -4, 12});
         shapes.material("stone").box({-2, -4, -16}, {2, 0, -5.5});
         shapes.group("cart").material("wood").box({-1.5, -0.4, 5}, {1.5, 0, 8});
         // The cart goes 6 m in a second and stops at 0.4 m past z = 0; the jump comes before that.
         Demo demo = demo_of(shapes.level(), {0, standing_on_flat(on, 0), 6.5}, on,
                             "55 wish 0,0\n40 wish 0,-1 jump\n30 wish 0,0\n", {11, 3, 1}, {0, 0, -2});
         Platform cart;
         cart.name = cart.group = "cart";
         cart.repeat = PathRepeat::once;
         cart.path = {{.offset = {0, 0, 0}, .speed = 6.0}, {.offset = {0, 0, -6}, .speed = 6.0}};
         demo.level.platforms = {cart};
         return demo;
     },
     "leave_mode=none"},
    {"coyote", "coyote", "Coyote time", "A jump that is pressed 3 ticks after the ledge is ignored.",
     "For a moment after the ground, jump anyway.",
     [] {
         MovementSettings on = basic_settings();
         on.coyote = true;
         // From 6 m before the rim, at 6 m/s, the player passes the rim in about tick 65; the jump comes 3
         // ticks later.
         return demo_of(ledges(4).level(), {0, standing_on_flat(on, 0), 6}, on,
                        "5 wish 0,0\n69 wish 0,-1\n30 wish 0,-1 jump\n30 wish 0,0\n", {11, 3, 1}, {0, 0, -2});
     }},
    {"jump-buffer", "jump_buffer", "Jump buffer", "A jump that is pressed 4 ticks before landing is ignored.",
     "Remember the press, and jump on landing.",
     [] {
         MovementSettings on = basic_settings();
         on.jump_buffer = true;
         Shapes shapes;
         shapes.material("plaster")
             .box({-4, -0.5, -16}, {4, 0, 8})
             .material("brick")
             .box({-3, 0, -10}, {3, 1, -7});
         // The first jump lasts 2 * 8 / 20 s, 48 ticks; the second press comes 4 ticks before it ends.
         return demo_of(
             shapes.level(), {0, standing_on_flat(on, 0), 5}, on,
             "10 wish 0,0\n10 wish 0,-1\n1 wish 0,-1 jump\n43 wish 0,-1\n1 wish 0,-1 jump\n60 wish 0,-1\n",
             {11, 4, 0}, {0, 1, -2});
     }},
    {"variable-jump", "variable_jump", "Variable jump height", "A short press jumps as high as a long one.",
     "Cut the upward speed when the button is released.",
     [] {
         MovementSettings on = basic_settings();
         on.variable_jump = true;
         Shapes shapes;
         shapes.material("plaster")
             .box({-4, -0.5, -12}, {4, 0, 6})
             .material("brick")
             .box({-3, 2.65, -3}, {3, 3.1, -1});
         return demo_of(shapes.level(), {0, standing_on_flat(on, 0), 4}, on,
                        "10 wish 0,0\n35 wish 0,-1\n6 wish 0,-1 jump\n60 wish 0,-1\n", {10, 3.5, 0},
                        {0, 1.2, -1.5});
     }},
    {"air-jump", "air_jump", "Air jump", "A gap is too wide for one jump.", "Allow a second jump in the air.",
     [] {
         MovementSettings on = basic_settings();
         on.air_jump = true;
         return demo_of(ledges(7).level(), {0, standing_on_flat(on, 0), 6}, on,
                        "5 wish 0,0\n60 wish 0,-1\n30 wish 0,-1 jump\n5 wish 0,-1\n40 wish 0,-1 jump\n"
                        "20 wish 0,0\n",
                        {12, 3.5, -1}, {0, 0, -3.5});
     }},
    {"wall-slide", "wall_slide", "Wall slide", "A fall along a wall is too fast to steer out of.",
     "Limit the falling speed at a wall.",
     [] {
         MovementSettings on = basic_settings();
         on.wall_slide = true;
         Shapes shapes;
         shapes.material("plaster").box({-4, -6.5, -8}, {4, -6, 8});
         shapes.material("stone").box({-2, -6, 0}, {2, 0, 6}).box({-2, -6, -1.8}, {2, -3.2, 0});
         shapes.material("brick").box({-2, -6, -4.5}, {2, 4, -3.5});
         return demo_of(shapes.level(), {0, standing_on_flat(on, 0), 3}, on,
                        "5 wish 0,0\n28 wish 0,-1\n20 wish 0,-1 jump\n50 wish 0,-1\n60 wish 0,1\n",
                        {13, 0, 0}, {0, -2, -1.5});
     }},
    {"wall-jump", "wall_jump", "Wall jump", "A player cannot leave a shaft between two walls.",
     "Jump off the wall: up, and away along its normal.",
     [] {
         MovementSettings on = basic_settings();
         on.wall_jump = true;
         on.jump_buffer = true;
         Shapes shapes;
         shapes.material("plaster").box({-6, -0.5, -4}, {6, 0, 4});
         shapes.material("brick").box({-4.4, 0, -2}, {-1.4, 4, 2}).box({1.4, 0, -2}, {2.4, 7, 2});
         return demo_of(shapes.level(), {0, standing_on_flat(on, 0), 0}, on,
                        "5 wish 0,0\n13 wish -1,0 jump\n7 wish -1,0\n4 wish -1,0 jump\n14 wish 1,0\n"
                        "8 wish 1,0 jump\n40 wish -1,0 jump\n20 wish 0,0\n",
                        {1, 4, 14}, {-1, 3, 0});
     }},
    {"air-control", "air_control", "Air control",
     "In the air the stick changes nothing, and the jump misses the pillar.",
     "Accelerate towards the stick in the air, too.",
     [] {
         MovementSettings on = basic_settings();
         Shapes shapes;
         shapes.material("plaster")
             .box({-5, -4.5, -14}, {9, -4, 8})
             .material("stone")
             .box({-2, -4, 0}, {2, 0, 7});
         shapes.material("brick__pillar").box({0.8, -4, -3.6}, {3.2, 0, -1.4});
         Demo demo = demo_of(shapes.level(), {0, standing_on_flat(on, 0), 4}, on,
                             "10 wish 0,0\n38 wish 0,-1\n10 wish 0,-1 jump\n14 wish 1,0 jump\n70 wish 0,0\n",
                             {-9, 6, 3.5}, {0.5, -1, -1});
         demo.level.surfaces.push_back(painted("pillar", {0.30F, 0.55F, 0.85F}));
         return demo;
     }},
    {"keep-speed", "keep_speed", "Keep speed",
     "In the air the stick slows a fast player to the walking speed.",
     "Let it steer, and take no speed away.",
     [] {
         MovementSettings on = basic_settings();
         on.keep_speed = true;
         Shapes shapes;
         shapes.material("plaster").box({-5, -4.5, -16}, {5, -4, 12});
         shapes.material("stone").box({-2, -4, -14}, {2, -1, -3.9});
         shapes.material("metal__ice").polygon({{-2, 4, 11}, {2, 4, 11}, {2, 0, 3}, {-2, 0, 3}});
         shapes.polygon({{-2, 0, 3}, {2, 0, 3}, {2, 0, 0}, {-2, 0, 0}});
         return demo_of(shapes.level(), {0, standing_on_flat(on, 3.5), 8.2}, on,
                        "110 wish 0,-1\n30 wish 0,0\n", {13, 5, 0}, {0, 0, -1});
     }},
    {"moving-platforms", "platforms", "Moving platforms", "A raft slides away under the player's feet.",
     "Make the rider move as the raft moves.",
     [] {
         MovementSettings on = basic_settings();
         Shapes shapes = ledges(6);
         shapes.group("raft").material("wood").box({-1.2, -0.3, -1.6}, {1.2, 0, 0});
         Demo demo = demo_of(shapes.level(), {0, standing_on_flat(on, 0), -0.8}, on,
                             "210 wish 0,0\n60 wish 0,-1\n", {11, 4, -1}, {0, 0, -3.2});
         Platform raft;
         raft.name = "raft";
         raft.group = "raft";
         raft.path = {{.offset = {0, 0, 0}, .speed = 1.6, .pause_s = 0.5},
                      {.offset = {0, 0, -4.4}, .speed = 1.6, .pause_s = 2}};
         demo.level.platforms = {raft};
         return demo;
     }},
    {"turntable", "platforms", "Turntable", "A turntable rotates away under the player's feet.",
     "Make the rider rotate with it.",
     [] {
         MovementSettings on = basic_settings();
         Shapes shapes;
         shapes.material("plaster").box({-7, -1, -7}, {7, -0.5, 7}).group("table").material("wood__disc");
         std::vector<Vec3> rim;
         for (int i = 0; i < 24; ++i) {
             const double angle = -2.0 * 3.141592653589793 * i / 24;
             rim.emplace_back(5 * std::cos(angle), 0, 5 * std::sin(angle));
         }
         shapes.polygon(rim);
         shapes.material("brick").box({-0.3, 0, -4.5}, {0.3, 0.6, -2});
         Demo demo = demo_of(shapes.level(), {3, standing_on_flat(on, 0), 0}, on, "180 wish 0,0\n", {6, 9, 8},
                             {0, 0, 0});
         Platform table;
         table.name = "table";
         table.group = "table";
         table.spin_rate = 1.2;
         demo.level.platforms = {table};
         demo.level.surfaces.push_back(painted("disc", {0.72F, 0.56F, 0.36F}));
         return demo;
     }},
});

}  // namespace

std::span<const DemoInfo> air_demos() {
    return air_rows;
}

}  // namespace slipface
