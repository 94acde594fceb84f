// Motion that a wall took is found whether a step up was tried at it or not.
#include <gtest/gtest.h>

#include <algorithm>

#include "slipface/sim/stops.h"

namespace slipface::test {
namespace {

TEST(Loss, OfAWallIsFoundWhetherAStepUpWasTriedOrNot) {
    // The wall ends above the lifted player, or below it: then the step is tried, and refused.
    for (const float height : {9.0F, 1.2F}) {
        const std::vector<Vec3f> positions{{-9, 0, -9}, {-9, 0, 9},      {9, 0, 9},      {9, 0, -9},
                                           {1, -1, -9}, {1, height, -9}, {1, height, 9}, {1, -1, 9}};
        const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}};
        const std::vector<FaceId> faces{0, 0, 1, 1};
        const Result<CollisionWorld> world = CollisionWorld::build({positions, triangles, faces});
        ASSERT_TRUE(world.ok());
        const std::vector<SurfaceType> surfaces = preset_surface_types();
        const MovementScene scene{*world, surfaces};
        TickTrace trace;
        trace.dt = 1.0 / 60;
        trace.input.wish = Vec2(0.99, 0.1);
        trace.settings.step_up = true;
        trace.before.position = Vec3(0.5, trace.settings.radii.y() + trace.settings.skin, 0);
        TraceRecorder recorder;
        int tried = 0;
        for (int tick = 0; tick < 20; ++tick) {
            recorder.records.clear();
            trace.from = trace.before.position;
            const StepResult result =
                step(scene, trace.settings, trace.before, trace.input, trace.dt, &recorder);
            trace.to = result.state.position;
            trace.records = recorder.records;
            tried = static_cast<int>(std::ranges::count_if(trace.records, [](const TraceRecord& record) {
                const auto* sweep = std::get_if<SweepRecord>(&record);
                return sweep != nullptr && sweep->pass == Pass::step;
            }));
            if (tick < 19) trace.before = result.state;
        }
        EXPECT_EQ(tried > 0, height < 2.0F);
        const std::optional<Loss> loss = loss_of(trace);
        ASSERT_TRUE(loss) << height;
        EXPECT_EQ(loss->cause, StopCause::wall) << height;
        EXPECT_EQ(loss->face, 1U) << height;
    }
}

}  // namespace
}  // namespace slipface::test
