// A crowd of random walkers that tries to break a level: do they leave it, end inside it, or get stuck?
// They walk through the level as tapes do: its platforms move, its sectors and terrain act, hazards send back
// to the spawn point.
//
// Every walker is a pure function of (seed, its number): the report is the same for any number of threads,
// and an audit cut into shards and merged is the same as one that ran whole, byte for byte.
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
    double duration_s = 60.0;  // simulated, each walker
    std::uint64_t seed = 1;
    double dt = 1.0 / 60.0;
    std::string dt_text = "1/60";
    std::vector<double> speeds;  // m/s; walker i runs at speeds[i % size]. Empty: the level's walk_speed
    Shard shard;                 // the walkers that this part runs
    bool heat = false;           // also fill AuditReport::heat, which costs about a tenth of the speed
    // Called from any thread about once a simulated second with the steps done since the last call; false
    // ends the audit early.
    std::function<bool(std::uint64_t steps)> progress;
};

enum class FindingKind : std::uint8_t { passed_through, left_level, overlap, stuck };
inline constexpr std::size_t finding_kind_count = 4;

// One row per kind: the verb, the panel and the reports are made from it.
struct FindingKindInfo {
    const char* name;     // in JSON and in the names of tapes: "passed_through"
    const char* label;    // "Passed through a face"
    const char* meaning;  // when an audit reports it
    const char* remedy;   // what to do about it
};
const FindingKindInfo& info_of(FindingKind kind);

struct AuditFinding {
    FindingKind kind = FindingKind::passed_through;
    std::uint32_t walker = 0;
    // A walker who left the level begins again at the spawn point and at the level's time 0, as its next
    // life.
    std::uint32_t life = 0;
    std::uint64_t tick = 0;        // of the life; the state after this many ticks is the bad one
    Vec3 position = Vec3::Zero();  // in the level's coordinates
    // passed_through, left_level: metres done in that tick; overlap: depth as a fraction of the radii; stuck:
    // seconds without moving.
    double amount = 0.0;
    // passed_through, overlap: that face. left_level: the one last stood on. stuck: one that holds the
    // walker.
    FaceId face = no_id;
    FaceId other = no_id;    // stuck: a second face that holds it
    std::uint64_t hash = 0;  // of the life up to and with that tick, SimulationReport::end_hash of its tape
    std::string text{};      // one sentence for a designer; every output shows this one
    friend bool operator==(const AuditFinding&, const AuditFinding&) = default;
};

// What happened on a face, added up over all walkers. Whole numbers, so that the order of adding is free.
struct FaceHeat {
    std::uint64_t visits = 0;         // times a walker came to touch it, not counting returns within 0.5 s
    std::uint64_t lost_us = 0;        // microseconds of walking that contacts with it cost, along the stick
    std::uint64_t stood = 0;          // ticks stood, climbed or stuck on it
    std::uint64_t stuck = 0;          // ticks on it that moved less than a tenth of what was asked
    std::uint64_t missed_ground = 0;  // ticks falling within 5 cm above it without being grounded
    FaceHeat& operator+=(const FaceHeat& more);
};

struct AuditReport {
    // What was run.
    std::string level_name;
    std::uint64_t level_fingerprint = 0;
    std::uint64_t scene_fingerprint = 0;  // of spawn, surface types, painted faces and platforms
    std::uint64_t settings_hash = 0;
    std::string program;  // version that ran it; parts of different versions are not merged
    std::uint32_t walkers = 0;
    double duration_s = 0.0;
    std::uint64_t seed = 0;
    std::string dt_text;
    std::vector<double> speeds;
    Shard shard;          // the part that this report is
    bool closed = false;  // no ray from the spawn point leaves the level

    // What came of it.
    std::uint64_t steps = 0;
    std::uint64_t lives = 0;
    std::uint64_t hazards = 0;
    std::uint64_t crushed = 0;  // times a platform left a walker no room (PlayerState::trapped)
    std::uint64_t left = 0;     // walkers' lives that ended by leaving an open level
    std::array<std::uint64_t, finding_kind_count> counts{};  // [FindingKind]; a life counts once per kind
    std::uint64_t hash = 0;              // sum over walkers of a hash of the end hashes of their lives
    std::vector<AuditFinding> findings;  // by walker, life, tick; the first of each kind in each life
    std::vector<FaceHeat> heat;          // [face], or empty
    bool cancelled = false;

    std::uint64_t count(FindingKind kind) const { return counts[static_cast<std::size_t>(kind)]; }
    bool clean() const { return counts == decltype(counts){} && !cancelled; }
};

// Refuses a level without triangles, a spawn point inside geometry or where a player who stands still dies,
// and options out of range.
Result<AuditReport> run_audit(const Level& level, const AuditOptions& options);

// The run up to and with the tick of a finding: `simulate` repeats it bit by bit, and its `end` says so.
Tape audit_tape(const Level& level, const AuditOptions& options, const AuditFinding& finding);

// The report as JSON without anything that differs between runs of the same audit (no duration, no machine).
std::string audit_to_json(const AuditReport& report);
Result<AuditReport> audit_from_json(std::string_view json, const std::string& location);

// A report and the file that it was read from, which errors name.
struct AuditPart {
    std::string file;
    AuditReport report;
};

// All parts of one audit as the report of the whole. Refuses parts of different audits, parts that come twice
// and parts that are missing.
Result<AuditReport> merge_audits(const std::vector<AuditPart>& parts);

}  // namespace slipface
