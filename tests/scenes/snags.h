// Planted snags: small levels of random sizes in which a walk is stopped by something that is known.
#pragma once

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <set>

#include "shapes.h"
#include "slipface/level/preset.h"
#include "slipface/sim/stops.h"

namespace slipface::test {

struct Snag {
    std::string kind;
    std::string size;  // "0.23 m"
    Level level;
    Tape tape;
    std::string group = "snag";  // the face to blame belongs to it
    std::set<StopCause> causes;  // any of these is the right rule
    bool has_cure = true;        // false: nothing single helps
    double passed_z = -4.0;      // the player got on if it came further along -Z
    double passed_y = -1e9;      // and at least this high
    double lowest_y = -1e9;      // and never lower than this
    double passed_x = -1e9;      // and at last further along X
    std::string headline = {};   // what the headline says
    std::string cure = {};       // and the first cure
    double size_m = 0.0;         // the number in the headline; 0: any
};

class SnagMaker {
  public:
    explicit SnagMaker(std::uint64_t seed) : state_(seed * 2 + 1) {}

    double between(double low, double high) {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return low + (high - low) * (static_cast<double>(state_ >> 11) * 0x1.0p-53);
    }
    bool coin() { return between(0, 1) < 0.5; }

    // One of each kind, with new sizes at every call: under the lecture's settings, and under those of a new
    // level.
    std::vector<Snag> make();
    std::vector<Snag> make_under_defaults();
    std::vector<Snag> make_others();

  private:
    std::uint64_t state_;
};

// The old settings of the lecture: what is off there is the cure of many.
inline MovementSettings lecture_settings() {
    return find_preset("lecture")->settings;
}

// Whether there is a floor below the others, onto which a player falls.
inline bool cellar = false;

// Starts at the origin and walks along -Z for two seconds.
inline Snag snag_of(std::string kind, std::string size, Shapes shapes, const MovementSettings& settings,
                    std::set<StopCause> causes, const char* inputs = "15 wish 0,0\n120 wish 0,-1\n") {
    Snag snag;
    snag.kind = std::move(kind);
    snag.size = std::move(size);
    if (cellar) shapes.group("cellar").material("plaster").box({-30, -5, -60}, {30, -4, 30});
    snag.level = shapes.level();
    snag.level.movement = settings;
    snag.level.spawn = Vec3(0, settings.radii.y() + settings.skin, 0);
    snag.tape = parse_tape(std::string("slipface-tape 1\ndt 1/60\n") + inputs, "snag").value();
    snag.causes = std::move(causes);
    return snag;
}

inline std::string metres(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f m", value);
    return text;
}

inline std::string number_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", value);
    return text;
}

inline std::string degrees_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f deg", value);
    return text;
}

inline std::vector<Snag> SnagMaker::make() {
    std::vector<Snag> snags;
    const auto ground = [&](double to = -24.0) {
        Shapes shapes;
        shapes.group("floor").material("plaster").box({-8, -1, to}, {8, 0, 5});
        shapes.group("snag").material("stone");
        return shapes;
    };
    const double z = -3.0;
    {
        const double h = between(0.16, 0.34);
        MovementSettings s = lecture_settings();
        Shapes shapes = ground();
        shapes.box({-8, 0, -24}, {8, h, z});
        snags.push_back(snag_of("kerb, step up off", metres(h), shapes, s, {StopCause::step}));
    }
    {
        const double h = between(0.42, 0.75);
        MovementSettings s = lecture_settings();
        s.step_up = s.snap_down = true;
        s.step_height = 0.35;
        Shapes shapes = ground();
        shapes.box({-8, 0, -24}, {8, h, z});
        snags.push_back(snag_of("kerb, too high", metres(h), shapes, s, {StopCause::step}));
    }
    {
        const double rise = between(0.15, 0.3), run = rise * between(1.1, 1.8);
        Shapes shapes = ground();
        shapes.stairs({-4, 0, z}, 8, 30, rise, run);
        snags.push_back(snag_of("stairs", metres(rise), shapes, lecture_settings(), {StopCause::step}));
    }
    {
        const double limit = between(20, 50), over = between(0.3, 4.0);
        MovementSettings s = lecture_settings();
        s.max_slope = limit * std::numbers::pi / 180;
        Shapes shapes = ground();
        const double length = 12.0;
        shapes.ramp({-4, 0, z}, 8, length, length * std::tan((limit + over) * std::numbers::pi / 180));
        snags.push_back(snag_of("slope over the limit",
                                degrees_text(limit + over) + ", limit " + degrees_text(limit), shapes, s,
                                {StopCause::slope}));
    }
    {
        const double h = between(0.003, 0.02);
        MovementSettings s = lecture_settings();
        s.max_slope = between(3.0, 8.0) * std::numbers::pi / 180;
        Shapes shapes = ground();
        shapes.box({-8, 0, -24}, {8, h, z});
        snags.push_back(snag_of("seam", metres(h), shapes, s, {StopCause::step, StopCause::slope}));
    }
    {
        const double h = between(0.2, 0.8);
        Shapes shapes = ground();
        shapes.polygon({{-8, 0, z}, {8, 0, z}, {8, h, z}, {-8, h, z}});
        snags.push_back(snag_of("low fence", metres(h), shapes, lecture_settings(), {StopCause::step}));
    }
    {
        const double h = between(1.2, 3.0);
        Shapes shapes = ground();
        shapes.polygon({{-8, 0, z}, {8, 0, z}, {8, h, z}, {-8, h, z}});
        snags.push_back(snag_of("thin wall", metres(h), shapes, lecture_settings(), {StopCause::wall}));
    }
    {
        const double h = between(1.2, 3.0);
        Shapes shapes = ground();
        shapes.polygon({{8, 0, z}, {-8, 0, z}, {-8, h, z}, {8, h, z}});
        snags.push_back(
            snag_of("one-sided wall from behind", metres(h), shapes, lecture_settings(), {StopCause::back}));
    }
    {
        const double h = between(1.0, 1.7);
        Shapes shapes = ground();
        shapes.box({-8, h, -24}, {8, 3, z});
        snags.push_back(snag_of("low ceiling", metres(h), shapes, lecture_settings(), {StopCause::overhead}));
    }
    {
        const double h = between(1.2, 1.7);
        Shapes shapes = ground();
        shapes.polygon({{-8, h, z}, {8, h, z}, {8, 3, z}, {-8, 3, z}});
        snags.push_back(snag_of("low lintel", metres(h), shapes, lecture_settings(), {StopCause::overhead}));
    }
    {
        const double w = between(0.3, 0.74);
        Shapes shapes = ground();
        shapes.box({-8, 0, z - 2}, {-0.5 * w, 3, z}).box({0.5 * w, 0, z - 2}, {8, 3, z});
        snags.push_back(snag_of("needle gap", metres(w), shapes, lecture_settings(), {StopCause::gap}));
    }
    {
        const double w = between(0.3, 0.7),
                     half = std::tan(between(5, 25) * std::numbers::pi / 180) * 3 + 0.5 * w;
        Shapes shapes = ground();
        shapes.polygon({{-half, 0, z}, {-0.5 * w, 0, z - 3}, {-0.5 * w, 3, z - 3}, {-half, 3, z}});
        shapes.polygon({{0.5 * w, 0, z - 3}, {half, 0, z}, {half, 3, z}, {0.5 * w, 3, z - 3}});
        Snag snag = snag_of("wedge of two walls", metres(w), shapes, lecture_settings(), {StopCause::gap});
        snag.passed_z = z - 3.3;
        snags.push_back(std::move(snag));
    }
    {
        const double w = between(0.5, 0.75), slow = between(0.15, 0.3);
        Shapes shapes;
        shapes.group("floor").material("plaster").box({-8, -3, z}, {8, 0, 5});
        shapes.group("snag").material("stone").box({-8, -3, -24}, {8, 0, z - w});
        char inputs[96];
        std::snprintf(inputs, sizeof inputs, "15 wish 0,0\n300 wish 0,-%.3f\n", slow);
        snags.push_back(snag_of("crack in the floor", metres(w), shapes, lecture_settings(),
                                {StopCause::step, StopCause::gap, StopCause::slope, StopCause::wall},
                                inputs));
    }
    {
        const double speed = between(1.0, 4.0);
        Shapes shapes = ground();
        shapes.polygon({{-8, 0, -9}, {8, 0, -9}, {8, 3, -9}, {-8, 3, -9}});
        Snag snag =
            snag_of("moving wall", metres(speed) + "/s", shapes, lecture_settings(), {StopCause::platform});
        snag.level.platforms.push_back(
            {.name = "crusher",
             .group = "snag",
             .path = {{.offset = Vec3::Zero(), .speed = speed}, {.offset = Vec3(0, 0, 12), .speed = speed}},
             .repeat = PathRepeat::once});
        snag.passed_z = -9.0;
        snags.push_back(std::move(snag));
    }
    {
        const double speed = between(4.0, 9.0);
        Shapes shapes;
        shapes.group("floor")
            .material("plaster")
            .box({-8, -1, z}, {8, 0, 5})
            .box({-8, -1, -24}, {8, 0, z - 6});
        shapes.group("snag").material("belt__against").box({-8, -1, z - 6}, {8, 0, z});
        Snag snag = snag_of("conveyor against", metres(speed) + "/s", shapes, lecture_settings(),
                            {StopCause::carried});
        SurfaceType belt;
        belt.name = "against";
        belt.velocity = Vec3(0, 0, speed);
        snag.level.surfaces.push_back(belt);
        snags.push_back(std::move(snag));
    }
    {
        const double slope = between(15, 40), hold = between(0.0, 0.09);
        Shapes shapes = ground();
        shapes.group("snag").material("mud__slippery");
        shapes.ramp({-8, 0, z}, 16, 12, 12 * std::tan(slope * std::numbers::pi / 180));
        Snag snag = snag_of("slippery slope", degrees_text(slope) + ", friction " + number_text(hold), shapes,
                            lecture_settings(), {StopCause::slippery}, "15 wish 0,0\n240 wish 0,-1\n");
        SurfaceType mud;
        mud.name = "slippery";
        mud.friction = hold;
        snag.passed_z = z - 6.0;  // a run-up takes the player up a little
        snag.level.surfaces.push_back(mud);
        snags.push_back(std::move(snag));
    }
    {
        const double h = between(0.16, 0.34);
        Shapes shapes;
        shapes.group("floor").material("frozen__ice").box({-8, -1, -24}, {8, 0, 5});
        shapes.group("snag").material("stone").box({-8, 0, -24}, {8, h, z});
        Snag snag = snag_of("lip at the end of ice", metres(h), shapes, lecture_settings(),
                            {StopCause::step, StopCause::slope}, "15 wish 0,0\n240 wish 0,-1\n");
        snags.push_back(std::move(snag));
    }
    {
        const double h = between(1.2, 2.5);
        Shapes shapes = ground();
        shapes.group("rungs")
            .material("wood__ladder")
            .polygon({{-2, 0, z}, {2, 0, z}, {2, h, z}, {-2, h, z}});
        shapes.group("snag").material("stone").polygon(
            {{-2, h, z}, {2, h, z}, {2, h + 1.5, z}, {-2, h + 1.5, z}});
        shapes.group("top").polygon(
            {{-2, h + 1.5, z}, {2, h + 1.5, z}, {2, h + 1.5, -12}, {-2, h + 1.5, -12}});
        Snag snag = snag_of("ladder that ends", metres(h), shapes, lecture_settings(),
                            {StopCause::ladder_end}, "15 wish 0,0\n300 wish 0,-1\n");
        snag.passed_y = h + 1.0;
        snag.passed_z = z;
        snags.push_back(std::move(snag));
    }
    {
        const double length = between(0.5, 3.0);
        Shapes shapes;
        shapes.group("floor")
            .material("plaster")
            .box({-8, -1, z}, {8, 0, 5})
            .box({-8, -1, -24}, {8, 0, z - length});
        shapes.group("snag").material("glue__sticky").box({-8, -1, z - length}, {8, 0, z});
        snags.push_back(
            snag_of("sticky patch", metres(length), shapes, lecture_settings(), {StopCause::sticky}));
    }
    {
        const double length = between(0.5, 3.0);
        Shapes shapes;
        shapes.group("floor")
            .material("plaster")
            .box({-8, -1, z}, {8, 0, 5})
            .box({-8, -1, -24}, {8, 0, z - length});
        shapes.group("snag").material("lava__hazard").box({-8, -1, z - length}, {8, 0, z});
        Snag snag = snag_of("hazard", metres(length), shapes, lecture_settings(), {StopCause::hazard});
        snag.passed_z = z - length;
        snags.push_back(std::move(snag));
    }
    {
        const double h = between(1.7, 2.2);
        Shapes shapes = ground();
        shapes.box({-8, 0, -24}, {8, h, z});
        Snag snag =
            snag_of("ledge too high to jump", metres(h), shapes, lecture_settings(),
                    {StopCause::wall, StopCause::step}, "15 wish 0,0\n15 wish 0,-1\n90 wish 0,-1 jump\n");
        snag.passed_y = h;
        snags.push_back(std::move(snag));
    }
    {
        // Two sheets of one floor, one of them too high: nothing stands between them.
        const double h = between(0.004, 0.03);
        MovementSettings s = lecture_settings();
        s.max_slope = between(3.0, 8.0) * std::numbers::pi / 180;
        Shapes shapes;
        shapes.group("floor").material("plaster").polygon({{-8, 0, 5}, {8, 0, 5}, {8, 0, z}, {-8, 0, z}});
        shapes.group("snag").polygon({{-8, h, z}, {8, h, z}, {8, h, -24}, {-8, h, -24}});
        snags.push_back(
            snag_of("raised sheet of floor", metres(h), shapes, s, {StopCause::step, StopCause::slope}));
    }
    {
        // A tile that looks down, of a type that is solid from the front alone.
        const double length = between(1.5, 4.0);
        Shapes shapes;
        const auto sheet = [&](double from, double to, bool up) {
            if (up)
                shapes.polygon({{-8, 0, from}, {8, 0, from}, {8, 0, to}, {-8, 0, to}});
            else
                shapes.polygon({{-8, 0, to}, {8, 0, to}, {8, 0, from}, {-8, 0, from}});
        };
        shapes.group("floor").material("plaster__thin");
        sheet(5, z, true);
        shapes.group("snag");
        sheet(z, z - length, false);
        shapes.group("floor");
        sheet(z - length, -24, true);
        Snag snag = snag_of("flipped tile of one-sided floor", metres(length), shapes, lecture_settings(),
                            {StopCause::fall}, "15 wish 0,0\n240 wish 0,-1\n");
        SurfaceType thin;
        thin.name = "thin";
        thin.one_sided = true;
        snag.level.surfaces.push_back(thin);
        snag.level.fall_limit = -6.0;
        snag.passed_z = z - length;
        snag.passed_y = -0.5;
        snag.lowest_y = -0.5;
        snags.push_back(std::move(snag));
    }
    {
        const double speed = between(1.0, 5.0), h = between(1.2, 3.0);
        Shapes shapes;
        shapes.group("floor").material("plaster").box({-8, -1, z}, {8, 0, 5}).box({-8, -1, -24}, {8, 0, -7});
        shapes.group("belt").material("belt__along").box({-8, -1, -7}, {8, 0, z});
        shapes.group("snag").material("stone").polygon({{-8, 0, -6}, {8, 0, -6}, {8, h, -6}, {-8, h, -6}});
        Snag snag = snag_of("conveyor into a wall", metres(speed) + "/s", shapes, lecture_settings(),
                            {StopCause::wall});
        SurfaceType belt;
        belt.name = "along";
        belt.velocity = Vec3(0, 0, -speed);
        snag.level.surfaces.push_back(belt);
        snag.passed_z = -6.5;
        snags.push_back(std::move(snag));
    }
    {
        // One step of a flight is higher than the others, which are climbed.
        const double rise = between(0.15, 0.3), high = between(0.45, 0.8), run = between(0.35, 0.6);
        MovementSettings s = lecture_settings();
        s.step_up = s.snap_down = true;
        s.step_height = 0.4;
        Shapes shapes = ground();
        shapes.group("stairs").stairs({-4, 0, z}, 8, 3, rise, run);
        const double top = 3 * rise, end = z - 3 * run;
        shapes.group("snag").box({-4, top - 0.1, -24}, {4, top + high, end - run});
        shapes.group("stairs").box({-4, 0, end - run}, {4, top, end});
        Snag snag = snag_of("one step of a flight too high", metres(high), shapes, s, {StopCause::step});
        snag.passed_z = end - run - 0.5;
        snags.push_back(std::move(snag));
    }
    {
        // A ramp that ends below the floor that it leads to.
        const double slope = between(10, 30), lip = between(0.15, 0.34), length = between(2.0, 4.0);
        const double rise = length * std::tan(slope * std::numbers::pi / 180);
        Shapes shapes = ground();
        shapes.group("ramp").ramp({-4, 0, z}, 8, length, rise);
        shapes.group("snag").box({-4, 0, -24}, {4, rise + lip, z - length});
        Snag snag =
            snag_of("lip at the end of a ramp", metres(lip), shapes, lecture_settings(), {StopCause::step});
        snag.passed_z = z - length - 0.8;
        snags.push_back(std::move(snag));
    }
    {
        // A bar across the way at the height of the face.
        const double low = between(1.0, 1.55), thick = between(0.05, 0.3);
        Shapes shapes = ground();
        shapes.box({-8, low, z - thick}, {8, low + thick, z});
        snags.push_back(
            snag_of("bar overhead", metres(low), shapes, lecture_settings(), {StopCause::overhead}));
    }
    {
        // A post narrower than the player, met by its middle.
        const double w = between(0.3, 1.2);
        Shapes shapes = ground();
        shapes.box({-0.5 * w, 0, z - w}, {0.5 * w, 3, z});
        Snag snag = snag_of("post", metres(w), shapes, lecture_settings(), {StopCause::wall});
        snag.passed_z = z - w - 0.5;
        snags.push_back(std::move(snag));
    }
    {
        const double in = between(0.05, 0.2), half = between(8, 15) * std::numbers::pi / 180;
        MovementSettings s = lecture_settings();
        s.push_out = PushOut::off;
        // A corner of two walls that the player begins inside of, and walks along.
        Shapes shapes = ground();
        const double x = 0.4 - in, far = 6.0 * std::tan(half);
        shapes.polygon({{-x, 0, 3}, {-x + far, 0, -3}, {-x + far, 3, -3}, {-x, 3, 3}});
        Snag snag = snag_of("begins inside a wall", metres(in), shapes, s,
                            {StopCause::inside, StopCause::wall, StopCause::back, StopCause::gap});
        snag.group = "";
        snag.passed_z = -2.0;
        snags.push_back(std::move(snag));
    }
    return snags;
}

}  // namespace slipface::test
