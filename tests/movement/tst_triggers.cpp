// Triggers: what is not solid reports when a body enters, stays and leaves.
#include <algorithm>

#include "slipface/movement/triggers.h"
#include "test_geometry.h"

namespace slipface::test {

namespace {

enum : SurfaceId { goal = 8, water = 9 };

struct TriggerLab : Lab {
    TriggerLab() {
        surfaces.push_back({.name = "goal", .solid = false});
        surfaces.push_back({.name = "water", .solid = false});
    }
    void box(const Vec3& low, const Vec3& high, SurfaceId type) {
        const auto corner = [&](int x, int y, int z) {
            return Vec3(x != 0 ? high.x() : low.x(), y != 0 ? high.y() : low.y(),
                        z != 0 ? high.z() : low.z());
        };
        polygon({corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)}, type);
        polygon({corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)}, type);
        polygon({corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)}, type);
        polygon({corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0)}, type);
        polygon({corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0)}, type);
        polygon({corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)}, type);
    }
};

// Where the ellipsoid is a sphere a box is a box: its nearest point is the centre clamped.
double distance(const Vec3& low, const Vec3& high, const Vec3& radii, const Vec3& at) {
    return (at - at.cwiseMax(low).cwiseMin(high)).cwiseQuotient(radii).norm();
}

std::vector<StepEvent> track(const MovementScene& scene, const Vec3& radii, const Vec3& from, const Vec3& to,
                             TriggerMemory& memory) {
    std::array<StepEvent, 32> events;
    const std::size_t count = track_triggers(scene, radii, from, to, memory, events);
    return {events.begin(), events.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

// Against the box by itself, also deep inside, where no face is touched.
TEST(Triggers, ABoxIsEnteredStayedInAndLeft) {
    int entered = 0, deep = 0;
    for (int round = 0; round < 60; ++round) {
        Random random(static_cast<std::uint64_t>(round) + 3);
        const Vec3 low(random.between(-4, 0), random.between(-4, 0), random.between(-4, 0));
        const Vec3 high = low + Vec3(random.between(0.2, 8), random.between(0.2, 8), random.between(0.2, 8));
        TriggerLab fixed, moving;
        const bool moves = round % 2 == 1;
        (moves ? moving : fixed)
            .box(low.cast<float>().cast<double>(), high.cast<float>().cast<double>(), goal);
        fixed.ready();
        moving.ready();
        const Vec3 radii(random.between(0.2, 0.6), random.between(0.3, 1), random.between(0.2, 0.6));
        TriggerMemory memory;
        bool was = false;
        Vec3 from(random.between(-6, 6), random.between(-6, 6), random.between(-6, 6));
        Vec3 offset = Vec3::Zero();
        for (int i = 0; i < 120; ++i) {
            const Vec3 to = from + Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
            if (moves) offset += Vec3(random.between(-0.2, 0.2), 0, random.between(-0.2, 0.2));
            MovingPart part;
            part.rest = &moving.world();
            part.begin.offset = part.end.offset = offset;
            MovementScene scene = fixed.scene();
            scene.platforms = {&part, 1};
            const double there = distance(low + offset, high + offset, radii, to);
            double on_the_way = there;
            for (int k = 0; k <= 200; ++k)
                on_the_way = std::min(
                    on_the_way, distance(low + offset, high + offset, radii, from + (to - from) * k / 200.0));
            const auto events = track(scene, radii, from, to, memory);
            const bool is = memory.count == 1;
            if (there < 1.0 - 1e-6) {
                ASSERT_TRUE(is) << round << " " << i;
            }
            if (on_the_way > 1.02) {
                ASSERT_FALSE(is) << round << " " << i;
            }
            ASSERT_EQ(events.size(), is || was ? 1U : 0U);
            if (is || was) {
                ASSERT_EQ(events[0].kind, is && was ? StepEventKind::stayed
                                          : is      ? StepEventKind::entered
                                                    : StepEventKind::departed);
                ASSERT_EQ(events[0].surface, goal);
                ASSERT_EQ(events[0].platform, moves ? 0U : no_id);
            }
            entered += is && !was;
            deep += there == 0.0;
            was = is;
            from = to;
        }
    }
    EXPECT_GT(entered, 50);
    EXPECT_GT(deep, 100);
}

// A sheet of many triangles across the way, thinner than a step: entered once, and left in the next tick.
TEST(Triggers, ASheetIsNotJumpedOverAndReportsOnce) {
    TriggerLab lab;
    for (int i = -5; i < 5; ++i)
        lab.wall({3, 2.0 * i}, {3, 2.0 * (i + 1)}, -5, 5, goal);
    lab.wall({6, -9}, {6, 9}, -5, 5, water);
    lab.ready();
    Random random(2);
    for (int round = 0; round < 100; ++round) {
        TriggerMemory memory;
        const double speed = random.between(0.02, 5.0);
        Vec3 at(0.0, random.between(-1, 1), random.between(-5, 5));
        std::vector<StepEventKind> goals, waters;
        while (at.x() < 9.0) {
            const Vec3 next = at + Vec3(speed, 0.0, 0.0);
            for (const StepEvent& event : track(lab.scene(), Vec3(0.4, 0.9, 0.4), at, next, memory))
                if (event.kind != StepEventKind::stayed)
                    (event.surface == goal ? goals : waters).push_back(event.kind);
            at = next;
        }
        for (int i = 0; i < 2; ++i)
            for (const StepEvent& event : track(lab.scene(), Vec3(0.4, 0.9, 0.4), at, at, memory))
                if (event.kind != StepEventKind::stayed)
                    (event.surface == goal ? goals : waters).push_back(event.kind);
        const std::vector<StepEventKind> once{StepEventKind::entered, StepEventKind::departed};
        EXPECT_EQ(goals, once) << speed;
        EXPECT_EQ(waters, once) << speed;
    }
}

// A player walks through it as if it were not there, and a filter hides it.
TEST(Triggers, DoNotStopAPlayerAndHonourTheFilter) {
    TriggerLab lab, without;
    lab.floor();
    without.floor();
    lab.box({1, -1, -1}, {3, 2, 1}, goal);
    lab.ready();
    without.ready();
    const MovementSettings settings;
    PlayerState state = at({-1, centre_height(settings, Vec3::UnitY()), 0}), plain = state;
    TriggerMemory memory, blind;
    SceneFilter filter;
    filter.ignored[goal] = true;
    int inside = 0;
    for (int i = 0; i < 90; ++i) {
        const PlayerState before = state;
        state = step(lab.scene(), settings, state, wish(1, 0), tick).state;
        plain = step(without.scene(), settings, plain, wish(1, 0), tick).state;
        ASSERT_EQ(state.position, plain.position);
        track(lab.scene(), settings.radii, before.position, state.position, memory);
        MovementScene seen = lab.scene();
        seen.filter = &filter;
        EXPECT_TRUE(track(seen, settings.radii, before.position, state.position, blind).empty());
        inside += memory.count > 0;
    }
    EXPECT_GT(inside, 20);
    EXPECT_EQ(memory.count, 0U);
}

}  // namespace slipface::test
