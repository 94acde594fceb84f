// Demos of the lecture's first half, before its hacks: bounce, slide, the contact plane, the epsilon. They
// are played with the lecture's own mover (slipface/sim/lecture_mover.h).
#include <array>
#include <cmath>

#include "demos.h"
#include "shapes.h"
#include "slipface/level/level_file.h"

namespace slipface {

namespace {

Demo by_lecture(Demo demo) {
    demo.tape.mover = find_mover("lecture");
    return demo;
}

MovementSettings slides(int count) {
    MovementSettings on = basic_settings();
    on.max_slides = count;
    on.skin = 1e-4;  // the way back to what was touched is no way along it
    return on;
}

// A floor, and on its far side a round wall of faces about `face` metres long: a quarter of a circle of
// `radius` metres around the origin, from straight ahead (-Z) to the right (+X).
Shapes round_wall(double radius, double face) {
    Shapes shapes;
    shapes.material("plaster").box({-3, -0.5, -radius - 1}, {radius + 1, 0, 2}).material("brick");
    const int faces = static_cast<int>(std::ceil(0.5 * pi * radius / face));
    const auto at = [&](int i, double y) {
        const double angle = 0.5 * pi * i / faces;
        return Vec3(radius * std::sin(angle), y, -radius * std::cos(angle));
    };
    for (int i = 0; i < faces; ++i)
        shapes.polygon({at(i, 0), at(i + 1, 0), at(i + 1, 1.2), at(i, 1.2)});
    return shapes;
}

// The stick leads along the round wall and into it by 30 degrees.
constexpr const char* along_wall =
    "14 wish 0,-1\n"
    "8 wish 0.91,-0.39\n"
    "8 wish 0.96,-0.23\n"
    "8 wish 0.99,-0.06\n"
    "8 wish 0.98,0.11\n"
    "8 wish 0.95,0.28\n"
    "8 wish 0.89,0.44\n"
    "8 wish 0.80,0.59\n"
    "8 wish 0.68,0.72\n"
    "8 wish 0.55,0.83\n";

const auto lecture_rows = std::to_array<DemoInfo>({
    {"bounce-scalar",
     "bounce",
     "Bounce scalar",
     "Negate the whole velocity into a surface, and a player bounces for ever.",
     "Negate a fraction e of it: each surface has its own.",
     [] {
         Shapes shapes;
         shapes.material("plaster").box({-7, -0.5, -2.5}, {7, -0.2, 2.5});
         Demo demo;
         for (int i = 0; i < 3; ++i)
             shapes.material("wood__e" + std::to_string(80 - 30 * i))
                 .box({-6.0 + 4.0 * i, -0.2, -1.5}, {-2.0 + 4.0 * i, 0, 1.5});
         demo = demo_of(shapes.level(), {-5.5, 4, 0}, basic_settings(), "330 wish 0.33,0\n", {0, 3, 10},
                        {0, 1.7, 0});
         for (int i = 0; i < 3; ++i) {
             const std::string name = "e" + std::to_string(80 - 30 * i);
             demo.level.surfaces.push_back(
                 painted(name.c_str(), {0.35F + 0.25F * static_cast<float>(i), 0.55F, 0.85F}));
             demo.level.surfaces.back().restitution = 0.8 - 0.3 * i;
         }
         return by_lecture(std::move(demo));
     },
     "mover lecture-whole-bounce",
     {"bounce", "bouncing: fractional scales", "V' = V - (1 + e) N (N.V)"},
     "A rebound rises to e e h: compute all that are above 0.1 m, then"},
    {"one-slide",
     "max_slides",
     "One slide",
     "A player that stops at its first contact cannot even walk on a floor.",
     "Project what is left onto the contact plane, and move again.",
     [] {
         Shapes shapes;
         shapes.material("plaster").floor({-3, 0, -7}, {3, 0, 3}, 2.0);
         return by_lecture(demo_of(shapes.level(), {0, standing_on_flat(slides(2), 0.3), 2}, slides(2),
                                   "80 wish 0,-1\n", {6, 3.4, 3.2}, {0, 0.4, -2.2}));
     },
     "max_slides=1",
     {"max_slides", "iteration one", "V' = V - N (N.V)"},
     "why does the player with one sweep not fall through the floor? Then"},
    {"two-slides",
     "max_slides",
     "Two slides",
     "One slide is used up by the floor, and the player sticks to the wall.",
     "Slide a second time: along floor and wall.",
     [] {
         Shapes shapes;
         shapes.material("plaster").box({-4, -0.5, -3}, {6, 0, 3}).material("brick");
         shapes.box({-4, 0, -3}, {6, 1.2, -2.4});
         return by_lecture(demo_of(shapes.level(), {-3, standing_on_flat(slides(3), 0), 2}, slides(3),
                                   "110 wish 0.8,-0.6\n", {1, 6.5, 4.2}, {1, 0, -0.6}));
     },
     "max_slides=2",
     {"max_slides", "iteration two", "V' = V - N (N.V)"},
     "turn the stick so that two sweeps are enough:"},
    {"three-slides",
     "max_slides",
     "Three slides",
     "A round wall has two faces in one tick: floor and wall leave nothing for the second.",
     "Slide a third time; more changes nothing.",
     [] {
         return by_lecture(demo_of(round_wall(5, 0.07).level(), {0, standing_on_flat(slides(4), 0), -3.2},
                                   slides(4), along_wall, {2.3, 8, -0.4}, {2.3, 0, -2.2}));
     },
     "max_slides=3",
     {"max_slides", "2-3 iterations", "V' = V - N (N.V)"},
     "what does a fifth sweep change? Then"},
    {"remainder",
     "max_slides",
     "What is left",
     "A slide by the whole displacement at each contact speeds the player up.",
     "Slide by what is left of it after the contact.",
     [] {
         MovementSettings on = slides(6);
         on.skin = 0.002;
         return by_lecture(demo_of(round_wall(5, 0.25).level(), {0, standing_on_flat(on, 0), -3.2}, on,
                                   along_wall, {2.3, 8, -0.4}, {2.3, 0, -2.2}));
     },
     "mover lecture-whole-displacement",
     {"max_slides", "the rest of the velocity, not the original", "V' = V - N (N.V),  V: what is left"},
     "how fast is the player at most, in m/s? Then"},
    {"contact-plane",
     "radius_y",
     "Contact plane",
     "A normal times R is wrong: the slide leads into the ramp.",
     "Divide the sphere's normal by R once more.",
     [] {
         Shapes shapes;
         shapes.material("plaster").box({-3, -0.5, -7}, {3, 0, 5}).material("brick");
         shapes.ramp({-2, 0, 1}, 4, 7, 7 * std::tan(pi / 6));
         return by_lecture(demo_of(shapes.level(), {0, standing_on_flat(slides(3), 0), 4}, slides(3),
                                   "95 wish 0,-1\n", {9, 4, 2.5}, {0, 1.5, -1.5}));
     },
     "mover lecture-times-radii",
     {"radius_y", "contact plane in ellipsoid space", "N = (E - P) / R / R,  V' = V - N (N.V)"},
     "for which radii are both normals the same? Then"},
    {"epsilon",
     "skin",
     "Epsilon",
     "Rounding leaves a player just inside the floor, where the sweep misses it.",
     "Push it a little along the normal after each contact.",
     [] {
         Shapes shapes;
         shapes.material("plaster").polygon({{-3, -0.3, 4}, {3, -0.3, 4}, {3, 0.7, -8}, {-3, 0.7, -8}});
         MovementSettings on = slides(3);
         on.skin = 0.002;
         return by_lecture(demo_of(shapes.level(), {0, standing_on_flat(on, 0), 2}, on, "75 wish 0,-1\n",
                                   {8, 1.2, 2}, {0, -0.4, -2}));
     },
     "mover lecture-no-epsilon",
     {"skin", "epsilon", "E' = E + skin N"},
     "how deep in the floor is the player when it falls through? Then"},
});

}  // namespace

std::span<const DemoInfo> lecture_demos() {
    return lecture_rows;
}

}  // namespace slipface
