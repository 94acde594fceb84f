// Motion is relative to what carries the player: a run on moving ground is the run on still ground, seen from
// the ground.
#include <gtest/gtest.h>

#include <algorithm>

#include "movement/test_geometry.h"
#include "slipface/level/preset.h"
#include "slipface/mesh/build.h"
#include "slipface/sim/stops.h"

namespace slipface::test {
namespace {

class Soup {
  public:
    explicit Soup(std::vector<std::string> groups) {
        soup_.groups = std::move(groups), soup_.face_first_corner = {0};
    }
    void quad(std::uint32_t group, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        for (const Vec3& corner : {a, b, c, d})
            soup_.corner_position.push_back(corner.cast<float>());
        soup_.face_first_corner.push_back(static_cast<std::uint32_t>(soup_.corner_position.size()));
        soup_.face_group.push_back(group);
    }
    void box(std::uint32_t group, const Vec3& low, const Vec3& high) {
        const auto at = [&](int x, int y, int z) {
            return Vec3(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
        };
        quad(group, at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
        quad(group, at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
        quad(group, at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
        quad(group, at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
        quad(group, at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
        quad(group, at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
    }
    Level level() const {
        Level level;
        level.mesh_path = "frames.obj";
        level.mesh = build_mesh(soup_).value();
        level.overrides.resize(level.mesh->face_count());
        level.fall_limit = -1e6;
        return level;
    }

  private:
    PolygonSoup soup_;
};

constexpr std::uint32_t still = 0, deck = 1;

Platform moving(const Vec3& velocity) {
    Platform platform;
    platform.name = platform.group = "deck";
    platform.repeat = PathRepeat::once;
    platform.path = {{.offset = Vec3::Zero(), .speed = velocity.norm()},
                     {.offset = velocity * 1000.0, .speed = velocity.norm()}};
    return platform;
}

Platform turning(const Vec3& axis, double rate) {
    Platform platform = moving(Vec3::UnitX());
    platform.path.clear();
    platform.spin_axis = axis;
    platform.spin_rate = rate;
    return platform;
}

// A deck of 60 m with ramps, boxes and kerbs on it.
Level yard(Random& random) {
    Soup soup({"still", "deck"});
    soup.box(still, {-1, -5001, -1}, {1, -5000, 1});
    soup.box(deck, {-30, -1, -30}, {30, 0, 30});
    for (int i = 0; i < 12; ++i) {
        const double x = random.between(-12, 12), z = random.between(-12, 12);
        const double w = random.between(0.3, 2), d = random.between(0.3, 2), h = random.between(0.1, 2);
        if (std::abs(x) < 5.5 && std::abs(z) < 3.5) continue;  // the start
        if (random.below(3) > 0) {
            soup.box(deck, {x - w, -0.5, z - d}, {x + w, h, z + d});
        } else {
            soup.quad(deck, {x, 0, z - d}, {x, 0, z + d}, {x + 2 * w, h, z + d}, {x + 2 * w, h, z - d});
        }
    }
    return soup.level();
}

struct Inputs {
    Random random;
    double rate;
    Vec2 wish = Vec2::Zero();
    bool jump = false;
    int left = 0;

    PlayerInput next(bool jumps) {
        if (left-- <= 0) {
            left = static_cast<int>(rate * random.between(0.1, 0.8));
            const double a = random.between(0, 2 * pi), size = random.below(4) == 0 ? 0.0 : 1.0;
            wish = size * Vec2(std::cos(a), std::sin(a));
            jump = jumps && random.below(2) == 0;
        }
        return {.wish = wish, .buttons = {Button::jump, jump && left % 2 == 0}};
    }
};

constexpr std::array rates{30, 60, 120, 240};

// Presets in which platforms act.
std::vector<MovementSettings> presets() {
    std::vector<MovementSettings> presets;
    for (const ShippedPreset& shipped : shipped_presets())
        if (shipped.preset.settings.platforms) presets.push_back(shipped.preset.settings);
    return presets;
}

struct Pair {
    PlayerState moving, still;
};

// Steps both by the same inputs and returns the largest distance in the frame of the ground, m.
template <class ToGround>
double apart(LevelScene& moving_scene, LevelScene& still_scene, const MovementSettings& s, Pair at, int rate,
             int ticks, Inputs inputs, bool jumps, const ToGround& to_ground) {
    double worst = 0.0;
    const double dt = 1.0 / rate;
    for (int i = 0; i < ticks; ++i) {
        const PlayerInput input = inputs.next(jumps);
        at.moving = step(moving_scene.at(i * dt, dt), s, at.moving, input, dt).state;
        at.still = step(still_scene.at(i * dt, dt), s, at.still, input, dt).state;
        worst = std::max(worst, (to_ground(at.moving.position, (i + 1) * dt) - at.still.position).norm());
    }
    return worst;
}

Pair starts(const Vec3& velocity, const MovementSettings& s) {
    Pair pair;
    pair.still.position = pair.moving.position = {0, s.radii.y() + 0.05, 0};
    pair.moving.velocity = pair.moving.air_frame = velocity;
    pair.still.carrier = pair.moving.carrier = Carrier::level;
    return pair;
}

Vec3 random_velocity(Random& random, double most) {
    Vec3 v(random.between(-1, 1), 0, random.between(-1, 1));
    if (random.below(2) == 0) v.y() = random.between(-1, 1);
    return most * random.between(0.05, 1) * v.normalized();
}

TEST(Frames, ARunOnAPlatformIsTheRunOnStillGround) {
    const auto all = presets();
    for (std::uint64_t seed = 0; seed < 120; ++seed) {
        Random random(seed);
        Level still_level = yard(random), moving_level = still_level;
        const Vec3 velocity = random_velocity(random, 12);
        moving_level.platforms = {moving(velocity)};
        const MovementSettings s = all[seed % all.size()];
        const int rate = rates[static_cast<std::size_t>(random.below(4))];
        LevelScene still_scene = LevelScene::build(still_level, s).value();
        LevelScene moving_scene = LevelScene::build(moving_level, s).value();
        const double worst = apart(moving_scene, still_scene, s, starts(velocity, s), rate, 6 * rate,
                                   {Random(seed + 1000), double(rate)}, true,
                                   [&](const Vec3& at, double time) { return Vec3(at - velocity * time); });
        EXPECT_LT(worst, 1e-3) << "seed " << seed << ", " << rate << " Hz, preset " << seed % all.size()
                               << ", velocity " << velocity.transpose();
    }
}

TEST(Frames, ARunOnABeltIsTheRunOnStillGround) {
    const auto all = presets();
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        Soup soup({"still"});
        soup.quad(still, {-200, 0, -200}, {-200, 0, 200}, {200, 0, 200}, {200, 0, -200});
        Level still_level = soup.level(), moving_level = still_level;
        Vec3 velocity = random_velocity(random, 8);
        velocity.y() = 0;
        moving_level.surfaces[conveyor].velocity = velocity;
        moving_level.overrides[0] = conveyor;
        const MovementSettings s = all[seed % all.size()];
        const int rate = rates[static_cast<std::size_t>(random.below(4))];
        LevelScene still_scene = LevelScene::build(still_level, s).value();
        LevelScene moving_scene = LevelScene::build(moving_level, s).value();
        const double worst = apart(moving_scene, still_scene, s, starts(velocity, s), rate, 6 * rate,
                                   {Random(seed + 1000), double(rate)}, true,
                                   [&](const Vec3& at, double time) { return Vec3(at - velocity * time); });
        EXPECT_LT(worst, 1e-3) << "seed " << seed << ", " << rate << " Hz, preset " << seed % all.size();
    }
}

// A platform that turns about a vertical axis, and a turntable: the stick turns with them.
TEST(Frames, AWalkOnWhatTurnsIsTheWalkOnStillGround) {
    const auto all = presets();
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const bool platform = seed % 2 == 0;
        Soup soup({"still", "deck"});
        soup.box(still, {-1, -5001, -1}, {1, -5000, 1});
        soup.box(deck, {-30, -1, -30}, {30, 0, 30});
        Level still_level = soup.level(), moving_level = still_level;
        const double spin = random.between(-2, 2);
        if (platform) {
            moving_level.platforms = {turning(Vec3::UnitY(), spin)};
        } else {
            moving_level.surfaces[turntable].angular_velocity = spin;
            for (FaceId face = 6; face < 12; ++face)
                moving_level.overrides[face] = turntable;
        }
        MovementSettings s = all[seed % all.size()];
        s.sub_step = 0.0;  // the stick turns once per tick
        const int rate = rates[static_cast<std::size_t>(random.below(4))];
        LevelScene still_scene = LevelScene::build(still_level, s).value();
        LevelScene moving_scene = LevelScene::build(moving_level, s).value();
        Inputs inputs{Random(seed + 1000), double(rate)};
        const double dt = 1.0 / rate;
        PlayerState fixed, turns;
        fixed.position = turns.position = {3, s.radii.y() + s.skin, 2};
        double worst = 0.0;
        for (int i = 0; i < 4 * rate; ++i) {
            PlayerInput input = i < rate / 5 ? PlayerInput{} : inputs.next(false);
            fixed = step(still_scene.at(i * dt, dt), s, fixed, input, dt).state;
            const Pose turn = rotation_about(Vec3::Zero(), Vec3::UnitY(), spin * (i + 1) * dt);
            const Vec3 wish = turn.rotate(Vec3(input.wish.x(), 0, input.wish.y()));
            input.wish = {wish.x(), wish.z()};
            turns = step(moving_scene.at(i * dt, dt), s, turns, input, dt).state;
            if (i < rate / 5) {  // both have landed
                turns.position = turn.apply(fixed.position);
                turns.velocity = turn.rotate(fixed.velocity);
                continue;
            }
            worst = std::max(worst, (turn.undo(turns.position) - fixed.position).norm());
        }
        EXPECT_LT(worst, 1e-3) << "seed " << seed << ", " << rate << " Hz, preset " << seed % all.size();
    }
}

TEST(Frames, AnIdleRiderStaysWhereItIs) {
    const auto all = presets();
    for (std::uint64_t seed = 0; seed < 120; ++seed) {
        Random random(seed);
        Soup soup({"still", "deck"});
        soup.box(still, {-1, -5001, -1}, {1, -5000, 1});
        const double rise = std::tan(random.between(0, radians(35)));
        soup.quad(deck, {-30, -30 * rise, -30}, {-30, -30 * rise, 30}, {30, 30 * rise, 30},
                  {30, 30 * rise, -30});
        Level level = soup.level();
        const Vec3 velocity = random_velocity(random, 10);
        const double roll = random.below(2) == 0 ? 0.0 : random.between(-0.1, 0.1);
        Platform platform = moving(velocity);
        platform.spin_axis =
            roll == 0.0 ? Vec3::UnitY() : Vec3(random.between(-1, 1), random.between(-1, 1), 1);
        platform.spin_rate = roll == 0.0 ? random.between(-1, 1) : roll;
        level.platforms = {platform};
        const MovementSettings s = all[seed % all.size()];
        const int rate = rates[static_cast<std::size_t>(random.below(4))];
        LevelScene scene = LevelScene::build(level, s).value();
        const double dt = 1.0 / rate;
        PlayerState state;
        const Vec3 slope = slope_normal(std::atan(rise));
        state.position = {0, centre_height(s, slope) + 0.01, 0};
        state.velocity = state.air_frame = velocity;
        state.carrier = Carrier::level;
        Vec3 spot = Vec3::Zero();
        double worst = 0.0;
        int airborne = 0, pushed = 0;
        for (int i = 0; i < 2 * rate; ++i) {
            TraceRecorder trace;
            state = step(scene.at(i * dt, dt), s, state, {}, dt, &trace).state;
            if (i < rate / 4) continue;
            // The ground below the centre.
            const Pose pose = scene.pose(0, (i + 1) * dt);
            const Vec3 normal = pose.rotate(slope);
            const Vec3 on = pose.apply(Vec3::Zero());
            const double height = (state.position - on).dot(normal) / normal.y();
            const Vec3 foot = pose.undo(state.position - Vec3(0, height, 0));
            if (i == rate / 4) spot = foot;
            worst = std::max(worst, (foot - spot).norm());
            airborne += !state.grounded;
            for (const TraceRecord& record : trace.records) {
                const auto* decision = std::get_if<DecisionRecord>(&record);
                pushed += std::holds_alternative<PushOutRecord>(record) ||
                          (decision != nullptr && decision->kind == Decision::platform_pushed);
            }
        }
        EXPECT_LT(worst, s.skin) << "seed " << seed << ", " << rate << " Hz, preset " << seed % all.size()
                                 << " rise " << rise << " roll " << roll << " rate " << platform.spin_rate;
        EXPECT_EQ(airborne, 0) << "seed " << seed << " preset " << seed % all.size();
        EXPECT_EQ(pushed, 0) << "seed " << seed << " preset " << seed % all.size();
    }
}

TEST(Frames, HopsNeverAddUp) {
    for (const MovementSettings& s : presets()) {
        for (const int rate : rates) {
            for (const bool belt : {true, false}) {
                Soup soup({"still", "deck"});
                soup.box(still, {-1, -5001, -1}, {1, -5000, 1});
                soup.quad(deck, {-2000, 0, -2000}, {-2000, 0, 2000}, {2000, 0, 2000}, {2000, 0, -2000});
                Level level = soup.level();
                if (belt) {
                    level.surfaces[conveyor].velocity = {6, 0, 0};
                    level.overrides[6] = conveyor;
                } else {
                    level.platforms = {moving({6, 0, 0})};
                }
                LevelScene scene = LevelScene::build(level, s).value();
                const double dt = 1.0 / rate;
                PlayerState state;
                state.position = {0, s.radii.y() + s.skin, 0};
                int hops = 0;
                double fastest = 0.0;
                for (int i = 0; i < 60 * rate && hops < 12; ++i) {
                    const PlayerInput input{.wish = Vec2::Zero(),
                                            .buttons = {Button::jump, state.grounded && !state.jump_held}};
                    const bool grounded = state.grounded;
                    state = step(scene.at(i * dt, dt), s, state, input, dt).state;
                    hops += grounded && !state.grounded;
                    const Vec3 v = velocity_in_level(scene.at(i * dt, dt), s, state);
                    fastest = std::max(fastest, std::hypot(v.x(), v.z()));
                }
                EXPECT_EQ(hops, 12);
                EXPECT_LT(fastest, 6.0 + 1e-6) << rate << (belt ? " Hz, belt" : " Hz, platform");
            }
        }
    }
}

// v*v/(2g) above the lift, whatever it does, and every press is a jump.
TEST(Frames, JumpsOnALiftAreAsHighAsOnTheFloor) {
    for (const MovementSettings& s : presets()) {
        for (const int rate : rates) {
            for (const double rise : {-4.0, 3.0, 5.0, 20.0}) {
                Soup soup({"still", "deck"});
                soup.box(still, {-1, -5001, -1}, {1, -5000, 1});
                soup.box(deck, {-4, -1, -4}, {4, 0, 4});
                Level level = soup.level();
                level.platforms = {moving({0, rise, 0})};
                LevelScene scene = LevelScene::build(level, s).value();
                const double dt = 1.0 / rate, floor = s.radii.y() + s.skin;
                PlayerState state;
                state.position = {0, floor, 0};
                state.velocity = state.air_frame = {0, rise, 0};
                state.carrier = Carrier::level;
                double highest = 0.0;
                int jumps = 0;
                for (int i = 0; i < 3 * rate; ++i) {
                    const bool grounded = state.grounded,
                               press = i > rate / 4 && grounded && !state.jump_held;
                    state = step(scene.at(i * dt, dt), s, state,
                                 {.wish = Vec2::Zero(),
                                  .buttons = {Button::jump, press || (state.jumping && state.jump_held)}},
                                 dt)
                                .state;
                    highest = std::max(highest, state.position.y() - rise * (i + 1) * dt - floor);
                    if (press) {
                        ++jumps;
                        EXPECT_FALSE(state.grounded) << "a press that was lost";
                    }
                }
                const double height = s.jump_speed * s.jump_speed / (2 * s.gravity);
                EXPECT_GT(jumps, 1);
                EXPECT_NEAR(highest, height, 0.5 * s.gravity * dt * dt / 4 + 3e-3)
                    << rate << " Hz, " << rise << " m/s";
            }
        }
    }
}

TEST(Frames, LeaveModesKeepWhatTheySay) {
    const std::pair<LeaveMode, Vec3> kept[] = {{LeaveMode::none, {0, 0, 0}},
                                               {LeaveMode::upward, {0, 2, 0}},
                                               {LeaveMode::horizontal, {3, 0, -1}},
                                               {LeaveMode::not_downward, {3, 2, -1}},
                                               {LeaveMode::all, {3, 2, -1}}};
    for (const double sign : {1.0, -1.0}) {
        for (auto [mode, keeps] : kept) {
            MovementSettings s;
            s.leave_mode = mode;
            Soup soup({"still", "deck"});
            soup.box(still, {-1, -5001, -1}, {1, -5000, 1});
            soup.box(deck, {-4, -1, -4}, {4, 0, 4});
            Level level = soup.level();
            level.platforms = {moving({3, 2 * sign, -1})};
            LevelScene scene = LevelScene::build(level, s).value();
            if (sign < 0.0) keeps.y() = mode == LeaveMode::all ? -2.0 : 0.0;
            PlayerState state;
            state.position = {0, s.radii.y() + s.skin, 0};
            state.velocity = {3, 2 * sign, -1};
            state.carrier = Carrier::level;
            for (int i = 0; i < 31; ++i)
                state = step(scene.at(i * tick, tick), s, state, wish(0, 0, i == 30), tick).state;
            ASSERT_FALSE(state.grounded);
            EXPECT_LT((state.air_frame - keeps).norm(), 1e-6);
            EXPECT_LT((state.velocity - keeps - Vec3(0, s.jump_speed - s.gravity * tick, 0)).norm(), 1e-6);
        }
    }
}

TEST(Frames, APressCrushesAndSendsBack) {
    Soup soup({"floor", "press"});
    soup.box(0, {-5, -1, -5}, {5, 0, 5});
    soup.box(1, {-3, 3, -3}, {3, 4, 3});
    Level level = soup.level();
    Platform press;
    press.name = press.group = "press";
    press.path = {{.offset = {0, 0, 0}, .speed = 2, .pause_s = 0.5}, {.offset = {0, -3, 0}, .speed = 2}};
    level.platforms = {press};
    LevelScene scene = LevelScene::build(level, level.movement).value();
    Tape tape;
    tape.segments = {{250, {}}};
    auto shared = std::make_shared<Tape>(tape);
    const TickScene ticks(scene);
    const SimulationReport report = simulate(ticks, level.movement, {0.25, 0.902, 0}, tape);
    EXPECT_GT(report.crushed, 0u);
    ASSERT_FALSE(report.events.empty());
    const auto crushed = std::find_if(report.events.begin(), report.events.end(),
                                      [](const SimulationEvent& event) { return event.kind == "crushed"; });
    ASSERT_NE(crushed, report.events.end());
    // 1.2 m above the head, at 2 m/s after half a second.
    EXPECT_NEAR(static_cast<double>(crushed->tick) * tape.dt, 0.5 + 0.6, 0.05);
    TapeRun run(shared, level.movement, {0.25, 0.902, 0});
    run.advance(ticks, 250);
    const std::vector<Stop> stops = find_stops(ticks, run, level);
    ASSERT_FALSE(stops.empty());
    EXPECT_NE(stops[0].headline.find("Crushed between `press`"), std::string::npos) << stops[0].headline;
    EXPECT_NE(stops[0].headline.find("and `floor`"), std::string::npos) << stops[0].headline;
}

}  // namespace
}  // namespace slipface::test
