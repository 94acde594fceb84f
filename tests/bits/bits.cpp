// slipface_bits [THREADS]: a hash of every state of every demo, off and on, and of random walkers in the
// demos' levels. scripts/compare_bits.sh compares what builds by different compilers print.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "slipface/base/hash.h"
#include "slipface/base/parallel.h"
#include "slipface/base/system.h"
#include "slipface/level/level_scene.h"
#include "slipface/scenes/demo.h"
#include "slipface/sim/simulate.h"

namespace slipface {
namespace {

constexpr std::size_t walkers = 8;
constexpr int walk_ticks = 600;

std::uint64_t hash_of_tape(const Demo& demo, const MovementSettings& settings) {
    Result<LevelScene> scene = LevelScene::build(demo.level, settings);
    if (!scene) return 0;
    PlayerState state = scene->player_at(demo.level.spawn);
    std::uint64_t hash = 0;
    std::size_t tick = 0;
    for (const TapeSegment& segment : demo.tape.segments) {
        for (int i = 0; i < segment.ticks; ++i, ++tick) {
            const double time = static_cast<double>(tick) * demo.tape.dt;
            state = step(scene->at(time, demo.tape.dt), settings, state, segment.input, demo.tape.dt).state;
            hash = state_hash(state, hash);
        }
    }
    return hash;
}

std::uint64_t hash_of_walker(const Demo& demo, std::uint64_t seed) {
    Result<LevelScene> scene = LevelScene::build(demo.level, demo.on);
    if (!scene) return 0;
    PlayerState state = scene->player_at(demo.level.spawn);
    std::uint64_t random = 2 * seed + 1, hash = 0;
    PlayerInput input;
    for (int tick = 0; tick < walk_ticks; ++tick) {
        if (tick % 20 == 0) {
            random = random * 6364136223846793005ULL + 1442695040888963407ULL;
            input.wish = {static_cast<double>(random >> 48) / 32768.0 - 1.0,
                          static_cast<double>((random >> 32) & 0xffff) / 32768.0 - 1.0};
            input.buttons.set(Button::jump, (random >> 31 & 1) != 0);
        }
        state = step(scene->at(tick / 60.0, 1.0 / 60), demo.on, state, input, 1.0 / 60).state;
        hash = state_hash(state, hash);
    }
    return hash;
}

void run(int threads) {
    const ThreadLimit limit(threads);
    const auto demos = demo_table();
    std::vector<std::string> lines(demos.size());
    parallel_for(demos.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Demo demo = make_demo(demos[i]);
            Hasher walks;
            for (std::size_t w = 0; w < walkers; ++w)
                walks.u64(hash_of_walker(demo, w));
            lines[i] = fmt::format("{} {:016x} {:016x} {:016x}\n", demos[i].name,
                                   hash_of_tape(demo, demo.off), hash_of_tape(demo, demo.on), walks.value());
        }
    });
    for (const std::string& line : lines)
        fmt::print("{}", line);
}

}  // namespace
}  // namespace slipface

int main(int count, char** arguments) {
    const std::vector<std::string> words = slipface::begin_program(count, arguments);
    slipface::run(words.size() > 1 ? std::atoi(words[1].c_str()) : 1);
}
