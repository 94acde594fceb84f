// Snags that were planted by someone who had not read the rules.
#pragma once

#include <algorithm>
#include <numbers>

#include "snags.h"

namespace slipface::test {

inline std::vector<Snag> SnagMaker::make_others() {
    std::vector<Snag> snags;
    const MovementSettings settings;
    const double z = -4.0;
    const auto floor = [&](double to = -30.0) {
        Shapes shapes;
        shapes.group("floor").material("plaster").box({-8, -1, to}, {8, 0, 5});
        shapes.group("snag").material("stone");
        return shapes;
    };
    const auto add = [&](const char* kind, const std::string& size, const Shapes& shapes,
                         std::set<StopCause> causes,
                         const char* inputs = "15 wish 0,0\n200 wish 0,-1\n") -> Snag& {
        Snag snag = snag_of(kind, size, shapes, settings, std::move(causes), inputs);
        snag.passed_z = z - 3.0;
        snag.level.fall_limit = -8.0;
        snags.push_back(std::move(snag));
        return snags.back();
    };
    // A jump over a gap that begins at z; the far side is `shore`.
    const auto gap = [&](double length) {
        Shapes shapes;
        shapes.group("snag").material("plaster").box({-8, -1, z}, {8, 0, 5});
        shapes.group("shore").box({-8, -1, -40}, {8, 0, z - length});
        return shapes;
    };
    const auto must_land = [&](Snag& snag, double length) {
        snag.passed_z = z - length - 0.6;
        snag.lowest_y = -0.5;
    };
    {
        const double speed = between(1.5, 4.0), length = between(9.0, 13.0), side = coin() ? 1.0 : -1.0;
        Shapes shapes;
        shapes.group("floor").material("plaster").box({-8, -1, z}, {8, 0, 5});
        shapes.group("shore").box({-8, -1, -40}, {8, 0, z - length});
        shapes.group("snag").material("rubber__aside").box({-1.5, -0.4, z - length}, {1.5, 0, z});
        Snag& snag = add("belt off a bridge", metres(speed) + "/s", shapes, {StopCause::fall},
                         "15 wish 0,0\n240 wish 0,-1\n");
        SurfaceType belt;
        belt.name = "aside";
        belt.velocity = Vec3(side * speed, 0, 0);
        snag.level.surfaces.push_back(belt);
        snag.headline = "because of the type `aside`";
        must_land(snag, length);
    }
    {
        const double speed = between(2.0, 6.0), side = coin() ? 1.0 : -1.0, length = 14.0;
        Shapes shapes;
        shapes.group("floor").material("plaster").box({-8, -1, z}, {8, 0, 5});
        shapes.group("shore").box({-8, -1, -40}, {8, 0, z - length});
        shapes.group("bridge").box({-1.2, -0.4, z - length}, {1.2, 0, z});
        shapes.group("snag").box({std::min(side * 3, side * 5), 0.05, z - 9},
                                 {std::max(side * 3, side * 5), 2, z - 1});
        Snag& snag = add("pushed off a bridge", metres(speed) + "/s", shapes, {StopCause::fall},
                         "15 wish 0,0\n90 wish 0,-1\n300 wish 0,0\n");
        snag.level.platforms.push_back({.name = "pusher",
                                        .group = "snag",
                                        .path = {{.offset = Vec3::Zero(), .speed = speed, .pause_s = 2.5},
                                                 {.offset = Vec3(-side * 4.5, 0, 0), .speed = speed}}});
        snag.headline = "pushed you off `bridge`";
        snag.lowest_y = -0.5;
    }
    {
        // The rider stands still.
        const double speed = between(1.5, 3.0), low = between(0.6, 1.6);
        Shapes shapes;
        shapes.group("floor").material("plaster").box({-8, -1, -3}, {8, 0, 5});
        shapes.group("ferry").box({-1.5, -0.3, -6}, {1.5, 0, -3});
        shapes.group("snag").box({-4, low, -10.3}, {4, low + 0.3, -10});
        Snag& snag = add("beam over a ferry", metres(low), shapes, {StopCause::fall},
                         "15 wish 0,0\n46 wish 0,-1\n500 wish 0,0\n");
        snag.level.platforms.push_back({.name = "ferry",
                                        .group = "ferry",
                                        .path = {{.offset = Vec3::Zero(), .speed = speed, .pause_s = 2.0},
                                                 {.offset = Vec3(0, 0, -12), .speed = speed}},
                                        .repeat = PathRepeat::once});
        snag.lowest_y = -0.5;
        snag.passed_z = -14.0;
    }
    {
        const double low = between(3.0, 5.0);
        Shapes shapes = floor();
        shapes.group("rungs")
            .material("wood__ladder")
            .polygon({{-2, 0, z}, {2, 0, z}, {2, low + 1, z}, {-2, low + 1, z}});
        shapes.group("snag").material("stone").box({-3, low, z}, {3, low + 0.1, z + 2});
        Snag& snag = add("hatch above a ladder", metres(low), shapes, {StopCause::overhead},
                         "15 wish 0,0\n300 wish 0,-1\n");
        snag.passed_y = low + 0.95;
        snag.passed_z = 10.0;
    }
    {
        const double slope = between(52, 62), high = between(0.6, 2.0);
        const double length = high / std::tan(slope * std::numbers::pi / 180);
        Shapes shapes = floor();
        shapes.polygon({{-6, 0, z}, {6, 0, z}, {6, high, z - length}, {-6, high, z - length}});
        shapes.group("top").box({-6, -1, -30}, {6, high, z - length});
        Snag& snag = add("steep bank", degrees_text(slope), shapes, {StopCause::slope});
        snag.passed_y = high;
    }
    {
        // The height is that of the kerb above the ramp's end, not above the player's feet.
        const double slope = between(10, 40) * std::numbers::pi / 180, length = between(2.0, 4.0);
        const double rise = length * std::tan(slope), high = between(0.45, 0.8);
        Shapes shapes = floor();
        shapes.group("ramp").ramp({-4, 0, z}, 8, length, rise);
        shapes.group("snag").box({-4, 0, -30}, {4, rise + high, z - length});
        Snag& snag = add("kerb at the end of a ramp", metres(high), shapes, {StopCause::step});
        snag.passed_z = z - length - 0.8;
        snag.size_m = high;
    }
    {
        const double slope = between(10, 25) * std::numbers::pi / 180, from = between(1.0, 3.0);
        const double low = between(1.6, 1.72);
        Shapes shapes = floor();
        shapes.group("ramp").ramp({-4, 0, z}, 8, 6, 6 * std::tan(slope));
        const double y = from * std::tan(slope) + low;
        shapes.group("snag").box({-4, y, z - from - 0.3}, {4, y + 1.5, z - from});
        Snag& snag = add("header above a ramp", metres(low), shapes, {StopCause::overhead});
        snag.passed_z = z - from - 1.2;
        snag.size_m = low;
    }
    {
        const double height = between(0.45, 0.6), low = 2.0 * height - between(0.03, 0.2);
        Shapes shapes = floor();
        shapes.box({-8, low, z - 5}, {8, 3, z});
        Snag& snag = add("tunnel to crawl through", metres(low), shapes, {StopCause::overhead},
                         "15 wish 0,0\n240 wish 0,-1 crouch\n");
        snag.level.movement.crouch = true;
        snag.level.movement.crouch_radius_y = height;
        snag.passed_z = z - 1.5;
        snag.size_m = low;
        snag.cure = "Crouched radius Y";
    }
    {
        const double wide = between(0.2, 0.6), between_m = between(0.4, 0.74);
        Shapes shapes = floor();
        for (const double side : {-1.0, 1.0}) {
            const double x = side * (wide + 0.5 * between_m), cz = z - 1.0;
            std::vector<Vec3> ring;
            for (int i = 0; i < 12; ++i)
                ring.emplace_back(x + wide * std::cos(i * std::numbers::pi / 6), 0.0,
                                  cz - wide * std::sin(i * std::numbers::pi / 6));
            const Vec3 up(0, 3, 0);
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vec3 a = ring[i], b = ring[(i + 1) % ring.size()];
                shapes.polygon({a, b, b + up, a + up});
            }
        }
        add("two columns", metres(between_m), shapes, {StopCause::gap, StopCause::wall});
    }
    {
        const double length = between(3.0, 4.0);
        Snag& snag = add("jump that is late", metres(length), gap(length), {StopCause::fall},
                         "15 wish 0,0\n52 wish 0,-1\n60 wish 0,-1 jump\n30 wish 0,-1\n");
        snag.level.movement.coyote_time = 0.05;
        snag.cure = "Coyote";
        must_land(snag, length);
    }
    {
        const double speed = between(2.5, 4.0), length = 0.8 * speed + between(0.3, 0.8);
        char inputs[96];
        std::snprintf(inputs, sizeof inputs, "15 wish 0,0\n%d wish 0,-1\n60 wish 0,-1 jump\n30 wish 0,-1\n",
                      static_cast<int>(60 * 3.7 / speed) + 4);
        Snag& snag = add("jump that is too slow", metres(length), gap(length), {StopCause::fall}, inputs);
        snag.level.movement.walk_speed = speed;
        snag.headline = "short of `shore`";
        must_land(snag, length);
    }
    {
        const double length = between(2.5, 3.6), high = between(1.75, 2.2);
        Shapes shapes;
        shapes.group("snag").material("plaster").box({-8, -1, z}, {8, 0, 5});
        shapes.group("shore").box({-8, -5, -40}, {8, high, z - length});
        Snag& snag = add("far side that is too high", metres(high), shapes, {StopCause::fall},
                         "15 wish 0,0\n43 wish 0,-1\n60 wish 0,-1 jump\n90 wish 0,-1\n");
        snag.headline = "too low for `shore`";
        must_land(snag, length);
        snag.passed_y = high;
    }
    {
        const double length = between(5.6, 6.8);
        Snag& snag =
            add("dash that is off", metres(length), gap(length), {StopCause::fall},
                "15 wish 0,0\n43 wish 0,-1\n20 wish 0,-1 jump\n10 wish 0,-1 jump dash\n60 wish 0,-1\n");
        snag.cure = "Dash on";
        must_land(snag, length);
    }
    return snags;
}

}  // namespace slipface::test
