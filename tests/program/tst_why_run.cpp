// `slipface why --run` with runs of a controller that is wrong in a known place: the place must be named.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

#include "program/run_program.h"

namespace slipface::test {
namespace {

using Json = nlohmann::ordered_json;

// Rows of tiles along +X, a metre each, of which one may lie higher, and a wall at the end: groups tile_0,
// tile_1, ..., wall.
struct TiledLevel {
    int tiles = 24;
    int high = -1;
    double rise = 0.0, wall_at = 20.0;

    std::string obj() const {
        std::string text;
        int vertex = 1;
        const auto quad = [&](const std::string& name, const std::array<std::array<double, 3>, 4>& corners) {
            text += "g " + name + "\n";
            for (const auto& c : corners)
                text += fmt::format("v {} {} {}\n", c[0], c[1], c[2]);
            text += fmt::format("f {} {} {} {}\n", vertex, vertex + 1, vertex + 2, vertex + 3);
            vertex += 4;
        };
        for (int i = -2; i < tiles; ++i) {
            const double x = i, y = i == high ? rise : 0.0;
            const std::string name = fmt::format("tile_{}", i + 2);
            quad(name, {{{x, y, -3}, {x, y, 3}, {x + 1, y, 3}, {x + 1, y, -3}}});
            if (i != high || rise == 0.0) continue;
            quad(name, {{{x, 0, -3}, {x, 0, 3}, {x, y, 3}, {x, y, -3}}});
            quad(name, {{{x + 1, y, -3}, {x + 1, y, 3}, {x + 1, 0, 3}, {x + 1, 0, -3}}});
        }
        quad("wall", {{{wall_at, 0, 3}, {wall_at, 4, 3}, {wall_at, 4, -3}, {wall_at, 0, -3}}});
        return text;
    }
};

struct Row {
    double x = 0.0, y = 0.0, z = 0.0, wish = 1.0;
};

struct Faults {
    Json json;
    std::string text;
};

Faults why(const TiledLevel& level, const std::vector<Row>& rows, bool with_wish, double rate) {
    const ScratchFolder folder;
    std::string csv =
        fmt::format("# slipface-run 1\n# rate {}\n{}\n", rate, with_wish ? "x,y,z,wish_x,wish_z" : "x,y,z");
    for (const Row& row : rows)
        csv += with_wish ? fmt::format("{},{},{},{},0\n", row.x, row.y, row.z, row.wish)
                         : fmt::format("{},{},{}\n", row.x, row.y, row.z);
    const std::string arguments =
        "why " + folder.write("level.obj", level.obj()) + " --run " + folder.write("run.csv", csv);
    const ProgramRun run = run_program(arguments + " --json 2>/dev/null"), text = run_program(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.output;
    const std::size_t begin = run.output.find('{');
    return {Json::parse(begin == std::string::npos ? "{}" : run.output.substr(begin)), text.output};
}

// A walk at `speed` along +X from 0 for `seconds`; `change(row, tick)` may spoil a row and the way on.
template <class Change>
std::vector<Row> walk(double speed, double seconds, double rate, Change&& change) {
    std::vector<Row> rows;
    Row row;
    for (int tick = 0; tick < static_cast<int>(seconds * rate); ++tick) {
        row.wish = 1.0;
        double step = speed / rate;
        change(row, tick, step);
        row.x += step;
        rows.push_back(row);
    }
    return rows;
}

TEST(WhyRun, AGoodWalkHasNoFault) {
    for (const bool with_wish : {true, false}) {
        const Faults faults = why({}, walk(6.0, 3.0, 60, [](Row&, int, double&) {}), with_wish, 60);
        EXPECT_EQ(faults.json["faults"].size(), 0u) << faults.json.dump(1);
        EXPECT_NE(faults.text.find("Nothing disturbed"), std::string::npos) << faults.text;
    }
}

// A snag at the edge of the tile that is higher by some millimetres, or at a seam where nothing is in the
// way.
TEST(WhyRun, ASnagNamesTheTileAtWhichItHappened) {
    std::mt19937 random(5);
    const auto draw = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() % 1000) / 1000.0;
    };
    for (int round = 0; round < 12; ++round) {
        const bool seam = round % 2 == 0;
        TiledLevel level;
        level.high = seam ? -1 : 8 + static_cast<int>(random() % 6);
        level.rise = seam ? 0.0 : draw(0.008, 0.03);
        const int tile = seam ? 8 + static_cast<int>(random() % 6) : level.high;
        const double speed = draw(4, 7), rate = round % 3 == 0 ? 50 : 60, radius = 0.4;
        // Where a capsule touches the edge, or where its lowest point crosses the seam.
        const double at = tile - (seam ? 0.0 : std::sqrt(radius * radius - std::pow(radius - level.rise, 2)));
        int held = 0;
        const auto rows = walk(speed, (level.tiles - 6) / speed, rate, [&](Row& row, int, double& step) {
            if (held == 0 && row.x + step >= at) held = 1;
            if (held >= 1 && held <= 2) step = held++ == 1 ? std::max(0.0, at - row.x) * 0.5 : 0.1 * step;
            if (held > 2 && row.x > tile - 0.1 && row.x < tile + 1) row.y = level.rise;
            if (row.x >= tile + 1) row.y = 0.0;
        });
        const Faults faults = why(level, rows, round % 4 < 2, rate);
        ASSERT_EQ(faults.json["faults"].size(), 1u) << round << faults.json.dump(1);
        const Json& fault = faults.json["faults"][0];
        EXPECT_EQ(fault["kind"], "snag") << faults.text;
        const std::string named = fmt::format("`tile_{}`", tile + 2),
                          before = fmt::format("`tile_{}`", tile + 1);
        EXPECT_NE(faults.text.find(named), std::string::npos) << named << " in " << faults.text;
        if (seam)
            EXPECT_NE(faults.text.find(before), std::string::npos) << before << " in " << faults.text;
        else
            EXPECT_NE(faults.text.find(fmt::format("{:.0f} mm edge", level.rise * 1000)), std::string::npos)
                << level.rise << faults.text;
        EXPECT_EQ(fault["slipface_passes"], true) << faults.text;
    }
}

TEST(WhyRun, AStopAtTheWallIsOneForSlipfaceToo) {
    for (const bool with_wish : {true, false}) {
        TiledLevel level;
        level.wall_at = 11.3;
        const Faults faults = why(
            level,
            walk(6.0, 3.0, 60,
                 [&](Row& row, int, double& step) { step = std::min(step, std::max(0.0, 10.88 - row.x)); }),
            with_wish, 60);
        ASSERT_EQ(faults.json["faults"].size(), 1u) << faults.json.dump(1);
        EXPECT_EQ(faults.json["faults"][0]["kind"], "stop");
        EXPECT_NE(faults.text.find("`wall`"), std::string::npos) << faults.text;
        EXPECT_EQ(faults.json["faults"][0]["slipface_passes"], false) << faults.text;
    }
}

TEST(WhyRun, AWayThroughTheWallIsSeen) {
    TiledLevel level;
    level.wall_at = 9.0;
    const Faults faults = why(level, walk(6.0, 2.0, 60, [](Row&, int, double&) {}), true, 60);
    ASSERT_FALSE(faults.json["faults"].empty());
    EXPECT_EQ(faults.json["faults"][0]["kind"], "through") << faults.text;
    EXPECT_NE(faults.text.find("`wall`"), std::string::npos) << faults.text;
}

TEST(WhyRun, AHopTremblingAndCreepingAreSeen) {
    const Faults hop =
        why({},
            walk(6.0, 2.5, 60,
                 [](Row& row, int tick, double&) { row.y = tick == 70 || tick == 71 ? 0.02 : 0.0; }),
            true, 60);
    ASSERT_EQ(hop.json["faults"].size(), 1u) << hop.json.dump(1);
    EXPECT_EQ(hop.json["faults"][0]["kind"], "hop");
    EXPECT_EQ(hop.json["faults"][0]["first"], 70);

    TiledLevel near_wall;
    near_wall.wall_at = 8.0;
    const Faults tremble = why(near_wall,
                               walk(6.0, 3.0, 60,
                                    [](Row& row, int tick, double& step) {
                                        if (row.x > 7.4)
                                            step = 0.0, row.x = 7.55 + (tick % 2 == 0 ? 0.02 : -0.02);
                                    }),
                               true, 60);
    const auto trembles = [](const Json& fault) { return fault["kind"] == "jitter"; };
    const Json& found = tremble.json["faults"];
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), trembles)) << found.dump(1);
    EXPECT_NE(tremble.text.find("`wall`"), std::string::npos) << tremble.text;

    const Faults creep = why({},
                             walk(6.0, 5.0, 60,
                                  [](Row& row, int tick, double& step) {
                                      if (tick > 60) row.wish = 0.0, step = 0.0005;
                                  }),
                             true, 60);
    ASSERT_EQ(creep.json["faults"].size(), 1u) << creep.json.dump(1);
    EXPECT_EQ(creep.json["faults"][0]["kind"], "creep");
}

TEST(WhyRun, AxesScaleAndJsonLinesAreTheSameRun) {
    const ScratchFolder folder;
    TiledLevel level;
    level.wall_at = 9.0;
    const std::string obj = folder.write("level.obj", level.obj());
    std::string csv = "# slipface-run 1\n# axes x,z,-y\n# scale 0.01\n# position centre\nX,Y,Z\n",
                json = "{\"slipface_run\":1}\n";
    for (int i = 0; i < 100; ++i) {
        csv += fmt::format("{},{},{}\n", 10 * i, -50, 90);
        json += fmt::format("{{\"position\":[{},0,0.5]}}\n", 0.1 * i);
    }
    const ProgramRun a = run_program("why " + obj + " --run " + folder.write("a.csv", csv));
    const ProgramRun b = run_program("why " + obj + " --run " + folder.write("b.jsonl", json));
    EXPECT_NE(a.output.find("passes through `wall`"), std::string::npos) << a.output;
    EXPECT_EQ(a.output, b.output);
}

TEST(WhyRun, BadFilesAreRefusedWithTheirLine) {
    const ScratchFolder folder;
    const std::string obj = folder.write("level.obj", TiledLevel().obj());
    const struct {
        std::string text, found;
    } rows[] = {
        {"", "found 0 ticks"},
        {"x,y\n1,2\n", "run.csv:1: found a first row without it, expected a column z"},
        {"x,y,z\n0,0,0\n0,zero,0\n", "run.csv:3: found \"zero\""},
        {"x,y,z\n0,0,0\n0,0\n", "run.csv:3: found 2 cells"},
        {"x,y,z\n0,0,0\n0,0,1e99\n", "run.csv:3: found \"1e99\""},
        {"t,x,y,z\n0,0,0,0\n0,0,0,0\n", "run.csv:3: found the time 0 after 0"},
        {"# radius -1\nx,y,z\n", "run.csv:1: found \"-1\""},
        {"# axes x,x,z\nx,y,z\n", "run.csv:1: found \"x,x,z\""},
        {"{\"position\":[0,0]}\n", "run.csv:1: found another position"},
        {"{\"position\":[0,0,0]}\n{\n", "run.csv:2: found \"{\", expected JSON"},
    };
    for (const auto& row : rows) {
        const ProgramRun run = run_program("why " + obj + " --run " + folder.write("run.csv", row.text));
        EXPECT_EQ(run.exit_code, 2) << row.text;
        EXPECT_NE(run.output.find(row.found), std::string::npos) << row.text << run.output;
    }
    EXPECT_EQ(run_program("why " + obj).exit_code, 64);
}

}  // namespace
}  // namespace slipface::test
