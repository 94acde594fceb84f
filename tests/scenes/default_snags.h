// Snags under the settings of a new level: what stops a player for whom every hack is on.
#pragma once

#include <numbers>

#include "snags.h"

namespace slipface::test {

inline std::vector<Snag> SnagMaker::make_under_defaults() {
    std::vector<Snag> snags;
    const MovementSettings settings;
    const double z = -4.0;
    const auto floor = [&](double from = 5.0, double to = -24.0) {
        Shapes shapes;
        shapes.group("floor").material("plaster").box({-8, -1, to}, {8, 0, from});
        shapes.group("snag").material("stone");
        return shapes;
    };
    const auto add = [&](const char* kind, const std::string& size, const Shapes& shapes,
                         std::set<StopCause> causes,
                         const char* inputs = "15 wish 0,0\n150 wish 0,-1\n") -> Snag& {
        Snag snag = snag_of(kind, size, shapes, settings, std::move(causes), inputs);
        snag.passed_z = z - 3.0;
        snags.push_back(std::move(snag));
        return snags.back();
    };
    {
        const double h = between(0.95, 1.35);
        Shapes shapes = floor();
        shapes.box({-8, 0, -24}, {8, h, z});
        add("block", metres(h), shapes, {StopCause::wall, StopCause::step});
    }
    {
        const double sill = between(0.05, 0.38), clear = between(1.1, 1.75);
        Shapes shapes = floor();
        shapes.group("sill").box({-8, 0, z - 0.3}, {8, sill, z});
        shapes.group("snag").box({-8, sill + clear, z - 0.3}, {8, 3.5, z});
        add("sill under a lintel", metres(sill) + ", " + metres(clear), shapes, {StopCause::overhead});
    }
    {
        const double slope = between(50.5, 65.0);
        Shapes shapes = floor();
        shapes.ramp({-6, -0.01, z}, 12, 6, 6 * std::tan(slope * std::numbers::pi / 180));
        add("steep slope", degrees_text(slope), shapes, {StopCause::slope}).passed_z = z - 0.8;
    }
    {
        const double angle = between(70, 120) * std::numbers::pi / 180, turn = between(-0.2, 0.2);
        Shapes shapes = floor();
        // Two walls that meet ahead.
        const Vec3 tip(0, 0, z - 1.0);
        const auto wall = [&](double side) {
            const double heading = side * 0.5 * angle + turn;
            const Vec3 end = tip + 8.0 * Vec3(std::sin(heading), 0, std::cos(heading));
            shapes.group(side < 0.0 ? "west" : "east");
            const Vec3 up(0, 3, 0);
            if (side < 0.0)
                shapes.polygon({end, tip, tip + up, end + up});
            else
                shapes.polygon({tip, end, end + up, tip + up});
        };
        wall(-1.0);
        wall(1.0);
        add("corner", degrees_text(angle * 180 / std::numbers::pi), shapes, {StopCause::corner}).group = "";
    }
    {
        const double length = between(1.5, 3.0);
        Shapes shapes;
        shapes.group("floor")
            .material("plaster")
            .box({-8, -1, z}, {8, 0, 5})
            .box({-8, -1, -24}, {8, 0, z - length});
        shapes.group("snag").material("cloth__ghost").box({-1, -0.2, z - length}, {1, 0, z});
        Snag& snag = add("bridge that is not solid", metres(length), shapes, {StopCause::fall});
        SurfaceType ghost;
        ghost.name = "ghost";
        ghost.solid = false;
        snag.level.surfaces.push_back(ghost);
        snag.level.fall_limit = -6.0;
        snag.lowest_y = -0.5;
    }
    {
        const double gap = between(2.8, 3.8), low = between(1.95, 2.6);
        Shapes shapes;
        shapes.group("floor")
            .material("plaster")
            .box({-8, -1, z}, {8, 0, 5})
            .box({-8, -1, -40}, {8, 0, z - gap});
        shapes.group("snag").material("stone").box({-8, low, z - 2}, {8, low + 0.3, z - 0.5});
        Snag& snag = add("beam over a jump", metres(low), shapes, {StopCause::fall},
                         "15 wish 0,0\n41 wish 0,-1\n30 wish 0,-1 jump\n60 wish 0,-1\n");
        snag.level.fall_limit = -6.0;
        snag.lowest_y = -0.5;
        snag.passed_z = z - gap - 1;
    }
    {
        const double gap = between(5.5, 8.0);
        Shapes shapes;
        shapes.group("snag").material("plaster").box({-8, -1, z}, {8, 0, 5});
        shapes.group("far").box({-8, -1, -40}, {8, 0, z - gap});
        Snag& snag = add("gap too wide to jump", metres(gap), shapes, {StopCause::fall},
                         "15 wish 0,0\n41 wish 0,-1\n30 wish 0,-1 jump\n60 wish 0,-1\n");
        snag.level.fall_limit = -6.0;
        snag.lowest_y = -0.5;
        snag.passed_z = z - gap - 1;
    }
    {
        const double degrees = between(58, 74), heading = degrees * std::numbers::pi / 180;
        Shapes shapes;
        shapes.group("floor").material("plaster").box({-40, -1, -60}, {40, 0, 60});
        shapes.group("snag").material("stone").box({2.0, 0, -60}, {2.5, 3, 60});
        char inputs[96];
        std::snprintf(inputs, sizeof inputs, "15 wish 0,0\n200 wish %.6f,%.6f\n", std::sin(heading),
                      -std::cos(heading));
        Snag& snag = add("oblique wall", degrees_text(degrees), shapes, {StopCause::wall}, inputs);
        snag.passed_z = 0.0;
        snag.passed_x = 3.0;
    }
    {
        const double rise = between(0.22, 0.38), run = between(0.36, 0.6);
        const int missing = 2 + static_cast<int>(between(0, 3));
        Shapes shapes = floor();
        for (int step = 0; step < 8; ++step) {
            if (step == missing) continue;
            shapes.group(step == missing + 1 ? "snag" : "stairs");
            shapes.box({-3, 0, step == 7 ? -24.0 : z - run * (step + 1)},
                       {3, rise * (step + 1), z - run * step});
        }
        Snag& snag = add("tread that is missing", metres(rise), shapes, {StopCause::gap, StopCause::wall});
        snag.passed_z = z - run * 8;
        snag.passed_y = rise * 8;
    }
    {
        const double speed = between(0.5, 2.5);
        Shapes shapes = floor();
        shapes.group("wall").box({1.0, 0, -24}, {1.5, 3, 5});
        shapes.group("snag").box({-7, 0.05, -12}, {-4, 2.5, 5});
        Snag& snag = add("press", metres(speed) + "/s", shapes, {StopCause::crushed},
                         "15 wish 0,0\n30 wish 0,-1\n900 wish 0,-0.02\n");
        snag.level.platforms.push_back(
            {.name = "press",
             .group = "snag",
             .path = {{.offset = Vec3::Zero(), .speed = speed}, {.offset = Vec3(5, 0, 0), .speed = speed}},
             .repeat = PathRepeat::once});
        snag.passed_z = -100.0;
        snag.has_cure = false;
    }
    {
        const double rise = between(0.2, 0.35), run = rise * between(1.2, 1.8), low = between(1.0, 1.6);
        Shapes shapes = floor();
        shapes.group("stairs").stairs({-4, 0, z}, 8, 12, rise, run);
        shapes.group("snag").material("stone").box({-8, 4 * rise + low, -24},
                                                   {8, 4 * rise + low + 6, z - 4 * run});
        Snag& snag = add("stairs under a ceiling", metres(low), shapes, {StopCause::overhead});
        snag.passed_z = z - 6 * run;
    }
    {
        const double w = between(0.4, 0.76);
        Shapes shapes = floor();
        shapes.box({-8, 0, z - 0.3}, {-0.5 * w, 2.4, z}).box({0.5 * w, 0, z - 0.3}, {8, 2.4, z});
        add("narrow door", metres(w), shapes, {StopCause::gap});
    }
    {
        const double deep = between(1.8, 3.0), length = between(2.0, 3.0);
        Shapes shapes;
        shapes.group("floor").material("plaster").box({-8, -4, z}, {8, 0, 5});
        shapes.group("pit").box({-8, -4, z - length}, {8, -deep, z});
        shapes.group("snag").material("stone").box({-8, -4, -24}, {8, 0, z - length});
        add("pit", metres(deep), shapes, {StopCause::wall}).passed_y = -0.5;
    }
    {
        const double h = between(1.9, 2.6);
        Shapes shapes = floor();
        shapes.box({-8, 0, -24}, {8, h, z});
        Snag& snag = add("ledge above the jump", metres(h), shapes, {StopCause::wall, StopCause::step},
                         "15 wish 0,0\n30 wish 0,-1\n30 wish 0,-1 jump\n60 wish 0,-1\n");
        snag.passed_y = h;
    }
    {
        const double h = between(0.1, 0.38), low = between(1.2, 1.7);
        Shapes shapes = floor();
        shapes.group("ramp").ramp({-4, 0, z}, 8, 4, 4 * std::tan(h));
        shapes.group("snag").material("stone").box({-8, low + 2 * std::tan(h), z - 2.5}, {8, 6, z - 2});
        add("lintel over a ramp", metres(low), shapes, {StopCause::overhead});
    }
    {
        const double deep = between(0.45, 1.2), wide = between(0.85, 1.6);
        Shapes shapes;
        shapes.group("floor").material("plaster").box({-8, -3, z}, {8, 0, 5});
        shapes.group("bottom").box({-8, -3, z - wide}, {8, -deep, z});
        shapes.group("snag").material("stone").box({-8, -3, -24}, {8, 0, z - wide});
        char inputs[96];
        std::snprintf(inputs, sizeof inputs, "15 wish 0,0\n300 wish 0,-0.3\n");
        add("ditch", metres(deep), shapes, {StopCause::wall, StopCause::step}, inputs).passed_y = -0.2;
    }
    return snags;
}

}  // namespace slipface::test
