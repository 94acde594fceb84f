// Poses of many instances of one mesh: slipface_bench --benchmark_filter=Pose
#include <benchmark/benchmark.h>

#include "slipface/mesh/animation.h"
#include "slipface/mesh/import.h"

namespace slipface {
namespace {

// The figure of the game, 14 nodes that turn; each instance is elsewhere in its clip. Per iteration: all of
// them once.
void PoseInstances(benchmark::State& state) {
    const auto figure = import_mesh(std::string(SLIPFACE_SOURCE_DIR) + "/assets/props/islander.gltf");
    if (!figure) return state.SkipWithError(figure.error().text().c_str());
    const auto count = static_cast<std::size_t>(state.range(0));
    std::vector<Animation> animations(count, Animation{.clip = "walk"});
    for (std::size_t i = 0; i < count; ++i)
        animations[i].phase_s = 0.01 * static_cast<double>(i);
    std::vector<RigPose> poses(count);
    double time_s = 0.0;
    for (auto _ : state) {
        for (std::size_t i = 0; i < count; ++i)
            pose_at(*figure->mesh, animations[i], time_s, poses[i]);
        benchmark::DoNotOptimize(poses.data());
        time_s += 1.0 / 60.0;
    }
}
BENCHMARK(PoseInstances)->Arg(1)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace slipface
