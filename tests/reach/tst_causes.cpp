// A goal that breaks, and the setting or the face that broke it.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "reach/reach_scenes.h"

namespace slipface::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Two ledges, a bridge between them, far wider than a jump, and a goal beyond.
Level bridge_level(bool bridge) {
    Shapes shapes;
    shapes.box({-2, -1, 0}, {2, 0, 4}).box({-2, -1, -20}, {2, 0, -16});
    if (bridge) shapes.material("bridge").box({-1, -0.2, -16}, {1, 0, 0});
    Level level = shapes.level();
    level.movement = MovementSettings{};
    level.spawn = {0, 0.91, 2};
    Goal goal;
    goal.name = "over";
    goal.position = {0, 0.9, -18};
    level.goals = {goal};
    level.overrides.resize(level.mesh->face_count());
    return level;
}

std::vector<std::string> causes(const Level& before, const Level& now, std::uint64_t rounds = 25) {
    ReachLimits limits;
    limits.rounds = rounds;
    EXPECT_TRUE(check_goals(before, before.spawn, {}, limits)->front().holds);
    const GoalAnswer broken = check_goals(now, now.spawn, {}, limits)->front();
    EXPECT_FALSE(broken.holds) << broken.text;
    return causes_of(broken, before, now, now.spawn, {}, limits);
}

TEST(ReachCauses, NameTheSettingOfTheLevelThatWasLowered) {
    Level before = bridge_level(true), now = before;
    for (Level* level : {&before, &now})
        level->goals[0].within_s = 6.0;
    now.movement.walk_speed = 1.0;
    now.movement.gravity = before.movement.gravity + 1.0;
    EXPECT_THAT(causes(before, now),
                ElementsAre(fmt::format("holds with walk_speed={}", before.movement.walk_speed)));
}

TEST(ReachCauses, NameTheFaceThatIsGone) {
    const Level before = bridge_level(true), now = bridge_level(false);
    const std::vector<std::string> found = causes(before, now);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_THAT(found[0], HasSubstr("`bridge`"));
    EXPECT_THAT(found[0], HasSubstr("is gone"));
}

TEST(ReachCauses, NameTheFaceThatWasPainted) {
    const Level before = bridge_level(true);
    Level now = before;
    const FaceId top = face_at(now, {0, 0, -8});
    now.overrides[top] = find_surface(now, "hazard").value();
    const std::vector<std::string> found = causes(before, now);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_THAT(found[0], HasSubstr(fmt::format("face {}", top)));
    EXPECT_THAT(found[0], HasSubstr("is hazard and was default"));
}

TEST(ReachCauses, NameTheTypeThatWasChanged) {
    Level before = bridge_level(true);
    const SurfaceId ice = find_surface(before, "ice").value();
    before.overrides[face_at(before, {0, 0, -8})] = ice;
    Level now = before;
    now.surfaces[ice].hazardous = true;
    EXPECT_THAT(causes(before, now), ElementsAre("holds with the type ice of before"));
}

TEST(ReachCauses, NameThePlatformThatWasChanged) {
    const Level before = bridge_level(true);
    Shapes shapes;
    shapes.box({-2, -1, 0}, {2, 0, 4}).box({-2, -1, -20}, {2, 0, -16});
    shapes.group("ferry").box({-1, -0.4, -2.2}, {1, 0, -0.2});
    Level level = shapes.level();
    level.movement = MovementSettings{};
    level.spawn = before.spawn;
    level.goals = before.goals;
    Platform ferry;
    ferry.name = ferry.group = "ferry";
    ferry.path = {{Vec3::Zero(), 4.0, 0.5}, {Vec3(0, 0, -13.5), 4.0, 0.5}};
    level.platforms.push_back(ferry);
    Level now = level;
    now.platforms[0].path[1].offset.z() = -4.0;
    EXPECT_THAT(causes(level, now, 60), ElementsAre("holds with the platform ferry of before"));
    now = level;
    now.platforms.clear();
    EXPECT_THAT(causes(level, now, 60), ElementsAre("holds with the platform ferry of before"));
}

// What must never be reached, and is since a wall has gone.
TEST(ReachCauses, NameTheWallThatIsGone) {
    const auto yard = [](bool wall) {
        Shapes shapes;
        shapes.box({-4, -1, -8}, {4, 0, 4});
        for (const double side : {-4.0, 4.0})
            shapes.box({side - 0.1, 0, -8}, {side + 0.1, 9, 4});
        if (wall) shapes.material("wall").box({-4, 0, -2.1}, {4, 9, -1.9});
        Level level = shapes.level();
        level.movement = MovementSettings{};
        level.spawn = {0, 0.91, 2};
        Goal goal;
        goal.name = "vault";
        goal.kind = GoalKind::never;
        goal.position = {0, 0.9, -6};
        level.goals = {goal};
        level.overrides.resize(level.mesh->face_count());
        return level;
    };
    const std::vector<std::string> found = causes(yard(true), yard(false), 6);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_THAT(found[0], HasSubstr("`wall`"));
    EXPECT_THAT(found[0], HasSubstr("is gone"));
}

}  // namespace
}  // namespace slipface::test
