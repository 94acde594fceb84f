// One run in a few numbers, for comparing many.
#pragma once

#include "slipface/sim/stops.h"

namespace slipface {

struct RunSummary {
    double distance_m = 0.0;  // along the path of the centre, ways back to the start left out
    double advanced_m = 0.0;  // of it towards the stick
    double air_s = 0.0;       // neither grounded nor climbing nor stuck
    std::size_t stops = 0;
    double lost_s = 0.0;         // in all stops
    std::size_t falls = 0;       // out of the level
    std::size_t hazards = 0;     // touched
    double top_speed_m_s = 0.0;  // horizontal
};

// Of a complete run.
RunSummary summarize(const TickScene& scene, const TapeRun& run, const StoryNames& names);

// The same tape under whole sets of settings.
struct NamedSettings {
    std::string name;
    MovementSettings settings;
};
struct SummaryRow {
    std::string name;
    RunSummary summary;
};
// One row per set, in their order; `start` is where the tape begins. The level's sectors act as each set
// says.
std::vector<SummaryRow> compare_settings(const Level& level, const std::shared_ptr<const Tape>& tape,
                                         const Vec3& start, std::span<const NamedSettings> sets);

}  // namespace slipface
