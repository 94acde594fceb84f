// Random walkers that try to leave a level, to end inside its geometry, or to get stuck. They move like the
// player of a tape: platforms move, sectors and terrain act, hazards send a walker back to the spawn point.
//
// Every walker is a pure function of the seed and its number. The report does not depend on the number of
// threads, and an audit that ran in shards and was merged gives the same bytes as one that ran whole.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/base/shard.h"
#include "slipface/level/level.h"
#include "slipface/sim/tape.h"

namespace slipface {

struct AuditOptions {
    std::uint32_t walkers = 100;
    double duration_s = 60.0;  // simulated seconds per walker
    std::uint64_t seed = 1;
    double dt = 1.0 / 60.0;
    std::string dt_text = "1/60";
    std::vector<double> speeds;  // m/s; walker i runs at speeds[i % size]. Empty: the level's walk_speed
    // Where lives begin, in turn, at rest; the level's coordinates. Empty: at the spawn point.
    std::vector<Vec3> starts;
    Shard shard;        // the walkers that this part runs
    bool heat = false;  // also fill AuditReport::heat; about a tenth slower
    // Called from any thread, about once per simulated second of a walker, with the steps done since its last
    // call. Returning false cancels the audit.
    std::function<bool(std::uint64_t steps)> progress;
};

enum class FindingKind : std::uint8_t { passed_through, left_level, overlap, stuck };
inline constexpr std::size_t finding_kind_count = 4;

// One row per kind, for the verb, the panel and the reports.
struct FindingKindInfo {
    const char* name;     // in JSON and in the names of tapes: "passed_through"
    const char* label;    // "Passed through a face"
    const char* meaning;  // when an audit reports it
    const char* remedy;   // how to fix it
};
const FindingKindInfo& info_of(FindingKind kind);

struct AuditFinding {
    FindingKind kind = FindingKind::passed_through;
    std::uint32_t walker = 0;
    // A walker that left the level starts its next life, at its next start and at the level's time 0.
    std::uint32_t life = 0;
    std::uint64_t tick = 0;        // of the life; the state after this many ticks shows the finding
    Vec3 position = Vec3::Zero();  // in the level's coordinates
    // passed_through, left_level: metres moved in that tick; overlap: depth as a fraction of the radii;
    // stuck: seconds without moving.
    double amount = 0.0;
    // passed_through, overlap: that face. left_level: the last ground face. stuck: a face that holds the
    // walker. May be no_id.
    FaceId face = no_id;
    FaceId other = no_id;    // stuck: a second face that holds it
    std::uint64_t hash = 0;  // of the life, that tick included: SimulationReport::end_hash of its tape
    std::string text{};      // one sentence for a designer, the same in every output
    friend bool operator==(const AuditFinding&, const AuditFinding&) = default;
};

// What happened on a face, summed over all walkers. Whole numbers, so that every order gives the same sum.
struct FaceHeat {
    std::uint64_t visits = 0;         // times a walker came to touch it, not counting returns within 0.5 s
    std::uint64_t lost_us = 0;        // microseconds of walking along the stick that contacts with it cost
    std::uint64_t stood = 0;          // ticks stood, climbed or stuck on it
    std::uint64_t stuck = 0;          // ticks on it with less than a tenth of the requested motion
    std::uint64_t missed_ground = 0;  // ticks falling within 5 cm above it without being grounded
    FaceHeat& operator+=(const FaceHeat& more);
};

// A way out of a level that is not closed: lives that left it, last from this ground.
struct AuditExit {
    FaceId face = no_id;  // no_id: never stood
    std::uint64_t times = 0;
    std::uint32_t walker = 0;      // the first of them
    Vec3 position = Vec3::Zero();  // where that one left the level's bounds, in the level's coordinates
    friend bool operator==(const AuditExit&, const AuditExit&) = default;
};
// Adds up what is of one face; ascending by face.
std::vector<AuditExit> summed_exits(std::vector<AuditExit> exits);
// Those by which most lives left come first.
std::vector<AuditExit> busiest_first(std::vector<AuditExit> exits);
std::string exit_text(const AuditExit& exit);  // "12 times, last from face 171"

struct AuditReport {
    // What was run.
    std::string level_name;
    std::uint64_t level_fingerprint = 0;
    std::uint64_t scene_fingerprint = 0;  // of spawn, surface types, painted faces and platforms
    std::uint64_t settings_hash = 0;
    std::string program;  // version of the program; parts of different versions are not merged
    std::uint32_t walkers = 0;
    double duration_s = 0.0;
    std::uint64_t seed = 0;
    std::string dt_text;
    std::vector<double> speeds;
    std::uint64_t starts = 0, starts_hash = 0;  // AuditOptions::starts; 0: the spawn point
    Shard shard;                                // the part that this report is
    bool closed = false;                        // no ray from the spawn point leaves the level

    // The results.
    std::uint64_t steps = 0;
    // Steps not made, because very many triangles lie where the walkers went: a walker ends there when each
    // query of its steps has looked at more than 600 on average over its whole duration.
    std::uint64_t untried = 0;
    std::uint64_t lives = 0;
    std::uint64_t hazards = 0;
    std::uint64_t crushed = 0;     // times a platform left a walker no room (PlayerState::crushed)
    std::uint64_t left = 0;        // lives that ended by leaving a level that is not closed
    std::vector<AuditExit> exits;  // of these lives; ascending by face
    std::uint64_t falls = 0;       // lives that ended below the fall limit, but inside the level
    std::array<std::uint64_t, finding_kind_count> counts{};  // [FindingKind]; a life counts once per kind
    std::uint64_t hash = 0;              // sum over walkers of a hash of the end hashes of their lives
    std::vector<AuditFinding> findings;  // by walker, life, tick; the first of each kind in each life
    std::vector<FaceHeat> heat;          // [face], or empty
    bool cancelled = false;

    std::uint64_t count(FindingKind kind) const { return counts[static_cast<std::size_t>(kind)]; }
    bool clean() const { return counts == decltype(counts){} && !cancelled; }
};

// Runs the audit. Errors: a level without triangles; a start inside geometry, or where a player who stands
// still touches a hazard within a second; options out of range.
Result<AuditReport> run_audit(const Level& level, const AuditOptions& options);

// Those of `starts` where the lives of an audit can begin.
Result<std::vector<Vec3>> usable_starts(const Level& level, const std::vector<Vec3>& starts, double dt);

// The tape of the finding's life, up to and including its tick. simulate() repeats it bit by bit, and the
// tape's `end` proves that.
Tape audit_tape(const Level& level, const AuditOptions& options, const AuditFinding& finding);

// The report as JSON. It has nothing that differs between runs of the same audit, such as times or machines.
std::string audit_to_json(const AuditReport& report);
Result<AuditReport> audit_from_json(std::string_view json, const std::string& location);

// A report, and the file that errors name for it.
struct AuditPart {
    std::string file;
    AuditReport report;
};

// Merges all parts of one audit into the report of the whole. Errors: parts of different audits, a part that
// is there twice, a missing part.
Result<AuditReport> merge_audits(const std::vector<AuditPart>& parts);

}  // namespace slipface
