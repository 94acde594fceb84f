// The table of docs/movesets.md: what each preset does, against what its game's source says and what the page
// claims was measured.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include "slipface/base/text.h"
#include "slipface/level/preset.h"
#include "slipface/sim/reach.h"

namespace slipface {
namespace {

constexpr double dt = 1.0 / 240;

// A floor, or a wall at x = 0 without one.
struct Place {
    std::vector<SurfaceType> surfaces{SurfaceType{}};
    CollisionWorld world;
    explicit Place(bool wall) {
        const std::vector<Vec3f> corners{{-900, 0, -900}, {-900, 0, 900}, {900, 0, 900},  {900, 0, -900},
                                         {0, -900, 900},  {0, 900, 900},  {0, 900, -900}, {0, -900, -900}};
        const std::vector<std::array<std::uint32_t, 3>> triangles =
            wall ? std::vector<std::array<std::uint32_t, 3>>{{4, 6, 5}, {4, 7, 6}}
                 : std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}};
        world = CollisionWorld::build({corners, triangles, std::vector<FaceId>{0, 0}, {}}).value();
    }
    MovementScene scene() const { return {world, surfaces}; }
};

PlayerState play(const Place& place, const MovementSettings& s, PlayerState state, const PlayerInput& input,
                 int ticks, double tick = dt) {
    for (int i = 0; i < ticks; ++i)
        state = step(place.scene(), s, state, input, tick).state;
    return state;
}

PlayerState standing(const Place& floor, const MovementSettings& s) {
    return play(floor, s, {.position = {0, s.radii.y() + s.skin, 0}}, {}, 10);
}

double run_up(const MovementSettings& s) {
    const Place floor(false);
    PlayerState state = standing(floor, s);
    int ticks = 0;
    for (; ticks < 5000 && Vec2(state.velocity.x(), state.velocity.z()).norm() < s.walk_speed - 1e-9; ++ticks)
        state = step(floor.scene(), s, state, {.wish = {1, 0}}, 0.001).state;
    return ticks * 0.001;
}

double crouched_speed(const MovementSettings& s) {
    const Place floor(false);
    return play(floor, s, standing(floor, s), {.wish = {1, 0}, .buttons = Button::crouch}, 480).velocity.x();
}

double crouched_height(const MovementSettings& s) {
    const Place floor(false);
    return 2 * body_radii(s, play(floor, s, standing(floor, s), {.buttons = Button::crouch}, 5)).y();
}

PlayerState after_dash(const MovementSettings& s) {
    const Place floor(false);
    PlayerState state{.position = {0, 20, 0}};
    for (int i = 0; i < 1000 && (i == 0 || state.move_s > 0); ++i)
        state =
            step(floor.scene(), s, state, {.wish = {1, 0}, .buttons = {Button::dash, i == 0}}, 0.001).state;
    return state;
}

PlayerState beside_wall(const MovementSettings& s, bool jumps) {
    const Place wall(true);
    PlayerState state{.position = {-s.radii.x() - s.skin, 0, 0}, .velocity = {0, -1, 0}};
    state = play(wall, s, state, {.wish = {1, 0}}, 240);
    return jumps ? play(wall, s, state, {.wish = {1, 0}, .buttons = Button::jump}, 1) : state;
}

const std::map<std::string, std::function<double(const MovementSettings&)>> measures{
    {"top speed", [](const auto& s) { return measure_reach(s, dt).top_speed; }},
    {"run-up", run_up},
    {"jump height", [](const auto& s) { return measure_reach(s, dt).running.height_m; }},
    {"air time", [](const auto& s) { return measure_reach(s, dt).running.duration_s; }},
    {"jump distance", [](const auto& s) { return measure_reach(s, dt).running.distance_m; }},
    {"crouched speed", crouched_speed},
    {"crouched height", crouched_height},
    {"dash length", [](const auto& s) { return after_dash(s).position.x(); }},
    {"speed after a dash", [](const auto& s) { return after_dash(s).velocity.x(); }},
    {"wall slide speed", [](const auto& s) { return -beside_wall(s, false).velocity.y(); }},
    {"wall jump speed", [](const auto& s) { return -beside_wall(s, true).velocity.x(); }},
};

TEST(Movesets, DoWhatTheirGamesDo) {
    const std::filesystem::path source = SLIPFACE_SOURCE_DIR;
    std::ifstream page(source / "docs/movesets.md");
    std::map<std::string, int> rows;
    for (std::string line; std::getline(page, line);) {
        if (!line.starts_with("| `")) continue;
        std::vector<std::string> cells;
        std::istringstream words(line);
        for (std::string cell; std::getline(words, cell, '|');)
            cells.emplace_back(trim(cell));
        ASSERT_EQ(cells.size(), 6U) << line;
        const std::string name = cells[1].substr(1, cells[1].size() - 2);
        const Result<Preset> preset = load_preset(source / "assets/movesets" / (name + ".json"));
        ASSERT_TRUE(preset.ok()) << preset.error().text();
        const auto measure = measures.find(cells[2]);
        ASSERT_NE(measure, measures.end()) << line;
        const double published = parse_double(cells[4]).value(), measured = measure->second(preset->settings);
        EXPECT_NEAR(measured / published, 1.0, 0.02) << line;
        EXPECT_EQ(fmt::format("{:.4g}", measured), cells[5]) << line;
        ++rows[name];
    }
    EXPECT_EQ(rows.size(), 5U);
    for (const auto& [name, count] : rows)
        EXPECT_GE(count, 4) << name;
}

}  // namespace
}  // namespace slipface
