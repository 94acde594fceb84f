// A part of a run played again, with other settings or in a changed scene.
#pragma once

#include <algorithm>
#include <cmath>

#include "slipface/sim/run.h"

namespace slipface {

inline std::size_t ticks_in(const TapeRun& run, double seconds) {
    return static_cast<std::size_t>(std::ceil(seconds / run.dt()));
}
// The tick so long before `tick`, but not before an earlier way back to the start.
inline std::size_t ticks_before(const TapeRun& run, std::size_t tick, double seconds) {
    std::size_t at = tick - std::min(tick, ticks_in(run, seconds));
    for (std::size_t i = at; i < tick; ++i)
        if (run.samples()[i].respawned) at = i + 1;
    return at;
}

// A stretch of the tape run with a change. Ends where the player is sent back to the start.
struct Trial {
    std::size_t tick = 0, end = 0;
    std::vector<std::string> settings;
    PlayerState state;

    double advanced_m = 0.0;         // towards the stick
    double advanced_before_m = 0.0;  // of it before the tick `mark`
    double at_mark_end_m = 0.0;      // until the tick `mark_end`
    std::size_t mark = 0, mark_end = 0;
    std::optional<std::size_t> sent_back;

    bool done() const { return tick >= end || sent_back; }

    std::size_t advance(const TickScene& scene, const TapeRun& run, const RunStart& start, std::size_t ticks,
                        TraceSink* trace = nullptr) {
        std::size_t used = 0;
        for (; used < ticks && !done(); ++used, ++tick) {
            if (tick == mark) advanced_before_m = advanced_m;
            MovementSettings now = run.settings_at(tick);
            for (const std::string& change : settings)
                (void)set_setting(now, change);
            const PlayerInput input = run.input_at(tick);
            const TickResult result = play_tick(scene.at(tick, run.dt()), now, state, input, run.dt(), start,
                                                trace, step_of(run.tape()));
            const Vec3 moved = scene.to_level(result.stepped) - scene.to_level(state);
            const Vec3 requested(input.wish.x(), 0.0, input.wish.y());
            const double towards = requested.isZero(0.0) ? 0.0 : moved.dot(requested) / requested.norm();
            // Uphill along the ground. The stick into a ladder asks for height.
            const bool uphill = result.stepped.grounded && towards > 0.0 && moved.y() > 0.0;
            advanced_m += uphill ? std::hypot(towards, moved.y()) : towards;
            if (state.climbing && moved.y() > 0.0) advanced_m += moved.y();
            if (tick < mark_end) at_mark_end_m = advanced_m;
            if (result.respawn != Respawn::none) sent_back = tick;
            state = result.state;
        }
        return used;
    }
};

}  // namespace slipface
