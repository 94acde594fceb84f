#include "slipface/sim/summary.h"

#include <algorithm>
#include <cmath>

namespace slipface {

RunSummary summarize(const TickScene& scene, const TapeRun& run, const StoryNames& names) {
    RunSummary summary;
    Vec3 before = run.start();
    for (std::size_t tick = 0; tick < run.samples().size(); ++tick) {
        const TickSample& sample = run.samples()[tick];
        const Vec3 moved = sample.position - before;
        before = sample.position;
        const Vec3& v = sample.velocity;
        summary.top_speed_m_s = std::max(summary.top_speed_m_s, std::hypot(v.x(), v.z()));
        if (!(sample.grounded || sample.climbing || sample.stuck || sample.hanging))
            summary.air_s += run.dt();
        if (sample.respawned) continue;
        summary.distance_m += moved.norm();
        const Vec2 wish = run.input_at(tick).wish;
        if (!wish.isZero(0.0)) summary.advanced_m += Vec2(moved.x(), moved.z()).dot(wish.normalized());
    }
    for (const Stop& stop : count_stops(scene, run, names)) {
        if (stop.loss.cause == StopCause::fall) {
            ++summary.falls;
        } else if (stop.loss.cause == StopCause::hazard) {
            ++summary.hazards;
        } else {
            ++summary.stops;
            summary.lost_s += stop.lost_s;
        }
    }
    return summary;
}

std::vector<SummaryRow> compare_settings(const Level& level, const std::shared_ptr<const Tape>& tape,
                                         const Vec3& start, std::span<const NamedSettings> sets) {
    std::vector<SummaryRow> rows;
    for (const NamedSettings& set : sets) {
        Result<LevelScene> built = LevelScene::build(level, set.settings);
        if (!built) continue;
        const TickScene scene(*built);
        TapeRun run = TapeRun::under(tape, set.settings, start);
        run.advance(scene, TapeRun::max_ticks);
        rows.push_back({set.name, summarize(scene, run, level)});
    }
    return rows;
}

}  // namespace slipface
