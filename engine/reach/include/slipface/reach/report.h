// What a search says about a level, as lists for people and as JSON.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "slipface/reach/search.h"

namespace slipface {

struct ReachReport {
    std::string level_name;
    std::uint64_t level_fingerprint = 0;
    std::vector<std::string> settings;  // what differs from basic_settings()
    Vec3 start = Vec3::Zero();
    std::uint64_t seed = 1;
    std::size_t face_count = 0;
    struct Face {
        FaceId face = no_id;
        double time_s = 0.0;
    };
    std::vector<Face> reached;      // ascending by face
    std::vector<FaceId> walkable;   // ascending, as the next two
    std::vector<FaceId> unreached;  // walkable, and never stood on
    std::vector<FaceId> traps;      // stood on, and no way from there leads back to the start
    // Faces reached whose status is unknown: cells beyond them are barely explored.
    std::size_t undecided = 0;
    struct Exit {
        Vec3 from, hole;
        FaceId face = no_id;
        double time_s = 0.0;
        std::uint32_t times = 0;
    };
    std::vector<Exit> exits;  // those that were left through most often first
    struct NamedGoal {
        std::string name;
        std::optional<double> time_s;  // nothing: not reached
    };
    std::vector<NamedGoal> goals;  // those that begin at this start
    std::size_t cells = 0, nodes = 0, bytes = 0;
    double cell_m = 0.0;
    std::uint64_t steps = 0, hash = 0;
    std::vector<ReachRound> rounds;
    bool exhausted = false;  // nothing was left to try
};

ReachReport make_reach_report(const ReachSearch& search);
// Without an indent all on one line. The curve has at most 100 points.
std::string reach_to_json(const ReachReport& report, bool indent);

// What one search reached and another did not.
struct ReachDifference {
    std::vector<FaceId> gained, lost;  // by the second
    struct Slower {
        FaceId face = no_id;
        double before_s = 0.0, after_s = 0.0;
    };
    std::vector<Slower> slower;  // by more than a tenth and half a second, the most first
    std::vector<std::string>
        settings;  // of the second, where they differ, and those of the first in brackets
    std::vector<std::string> goals_gained, goals_lost;
    std::vector<FaceId> new_traps;
};
ReachDifference compare_reach(const ReachReport& a, const ReachReport& b);
// What compare_reach() needs of a report, from its JSON or from a file of ReachSearch::store(). An error
// names `place`.
Result<ReachReport> parse_reach_report(std::string_view text, const std::string& position);

// Whether a goal of the level holds, and what to say of it.
struct GoalAnswer {
    std::size_t goal = 0;  // of the level
    bool holds = false;
    std::optional<double> time_s;  // it was reached after so long
    std::string text;          // "roof: not reached after 1200000 steps; 0.12 m short of it, last on face 7"
    std::optional<Tape> tape;  // the way there, or the one that came nearest
};

// Searches from each start that the goals name, as far as `limits` go for each.
Result<std::vector<GoalAnswer>> check_goals(const Level& level, const Vec3& start,
                                            const ReachOptions& options, const ReachLimits& limits,
                                            Progress* progress = nullptr);

// What breaks a goal of `now` that is answered by `broken`: settings and types with which, taken back to what
// they are in `before`, it holds again; else the faces that are gone, new or of another type where the way
// that held, or that should not be, parts from what it was. Empty: not known.
std::vector<std::string> causes_of(const GoalAnswer& broken, const Level& before, const Level& now,
                                   const Vec3& start, const ReachOptions& options, const ReachLimits& limits);

}  // namespace slipface
