// The lab promises that, after a slider moves, the recorded run and the run under the new settings are
// available within a frame (16.7 ms). Measured: two runs of 1000 ticks on the shipped level, compared tick by
// tick.
#include <benchmark/benchmark.h>

#include <cstdlib>

#include "slipface/level/level_file.h"
#include "slipface/sim/compare.h"

namespace slipface::bench {
namespace {

const LoadedLevel& easy() {
    static const LoadedLevel level = [] {
        Result<LoadedLevel> loaded = load_level(SLIPFACE_SOURCE_DIR "/assets/levels/easy.obj");
        if (!loaded) std::abort();
        return std::move(*loaded);
    }();
    return level;
}

// The shipped walk, repeated until it is long enough.
std::shared_ptr<const Tape> thousand_ticks() {
    Result<Tape> tour = load_tape(SLIPFACE_SOURCE_DIR "/assets/tapes/easy-tour.tape");
    if (!tour) std::abort();
    Tape tape = std::move(*tour);
    while (tape.tick_count() < 1000)
        tape.segments.insert(tape.segments.end(), tape.segments.begin(), tape.segments.end());
    return std::make_shared<const Tape>(cut_tape(tape, 1000));
}

void two_runs_of_1000_ticks(benchmark::State& state) {
    const Level& level = easy().level;
    Result<LevelScene> built = LevelScene::build(level);
    if (!built) return state.SkipWithError("no scene");
    const TickScene scene(*built);
    const auto tape = thousand_ticks();
    MovementSettings other = level.movement;
    other.walk_speed *= 0.9;
    for (auto _ : state) {
        TapeRun recorded(tape, level.movement, level.spawn), now = TapeRun::under(tape, other, level.spawn);
        recorded.advance(scene, 1000);
        now.advance(scene, 1000);
        benchmark::DoNotOptimize(compare_runs(recorded, now));
    }
}
BENCHMARK(two_runs_of_1000_ticks)->Unit(benchmark::kMillisecond);

void story_of_a_tick(benchmark::State& state) {
    const Level& level = easy().level;
    Result<LevelScene> built = LevelScene::build(level);
    if (!built) return state.SkipWithError("no scene");
    const TickScene scene(*built);
    TapeRun run(thousand_ticks(), level.movement, level.spawn);
    run.advance(scene, 1000);
    std::size_t tick = 0;
    for (auto _ : state) {
        tick = (tick + 331) % 1000;
        benchmark::DoNotOptimize(run.trace(scene, tick));
    }
}
BENCHMARK(story_of_a_tick)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace slipface::bench
