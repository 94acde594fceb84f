// A run that another program's controller made, as a file of positions (docs/recorded-runs.md).
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "slipface/base/result.h"
#include "slipface/base/types.h"

namespace slipface {

struct RecordedTick {
    double time_s = 0.0;         // at its end
    Vec3 feet = Vec3::Zero();    // the body's lowest point then, in the level's coordinates
    std::optional<Vec2> wish{};  // the stick during it, as PlayerInput::wish; nothing: not recorded
    bool jump = false;           // the button was held
};

struct RecordedRun {
    double radius = 0.4, height = 1.8;   // m, of the body
    std::optional<double> walk_speed{};  // m/s at full stick; nothing: to be read from the motion
    std::vector<RecordedTick> ticks{};   // at least 3; times ascend, by 1e-4 to 10 s
};

inline constexpr std::size_t max_recorded_ticks = 1'000'000;

// CSV or JSON lines, by the first byte. Errors name file and line, what was found and what was expected.
Result<RecordedRun> read_recorded_run(const std::filesystem::path& file);

}  // namespace slipface
