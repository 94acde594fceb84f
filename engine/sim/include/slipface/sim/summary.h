// A run in a few numbers, to compare many runs.
#pragma once

#include "slipface/sim/stops.h"

namespace slipface {

struct RunSummary {
    double distance_m = 0.0;     // along the path of the centre, without returns to the start
    double advanced_m = 0.0;     // the part of it towards the stick
    double air_s = 0.0;          // neither grounded nor climbing nor stuck
    std::size_t stops = 0;       // without falls and hazards
    double lost_s = 0.0;         // in these stops
    std::size_t falls = 0;       // out of the level
    std::size_t hazards = 0;     // returns to the start after touching one
    double top_speed_m_s = 0.0;  // horizontal
};

// Of a complete run. `scene` is the one it ran in.
RunSummary summarize(const TickScene& scene, const TapeRun& run, const StoryNames& names);

// A name and complete settings.
struct NamedSettings {
    std::string name;
    MovementSettings settings;
};
struct SummaryRow {
    std::string name;
    RunSummary summary;
};
// Runs the same tape under each set of settings: one row per set, in their order, except for sets for which
// the level's scene cannot be built. `start` is in the level's coordinates. Each set decides whether the
// level's sectors act.
std::vector<SummaryRow> compare_settings(const Level& level, const std::shared_ptr<const Tape>& tape,
                                         const Vec3& start, std::span<const NamedSettings> sets);

}  // namespace slipface
