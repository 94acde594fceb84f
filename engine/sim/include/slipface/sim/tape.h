// A tape: the inputs of a run as text, enough to repeat it bit by bit.
//
//   slipface-tape 1
//   level easy.obj 1f2e3d4c5b6a7988      (name, mesh fingerprint; optional)
//   surfaces 8a7b6c5d4e3f2a1b            (of all else that is met, scene_fingerprint(); optional)
//   dt 1/60
//   settings basic                       (optional: begin with basic_settings(), not with the level's;
//                                         "settings defaults" is the same)
//   set max_slope=0.7                    (any number of settings)
//   start 0,1,0                          (optional; else the level's spawn)
//   60 wish 0,-1                         (for 60 ticks: walk along -Z)
//   set step_up=off                      (from the next tick on)
//   1 wish 0,-1 jump
//   end 0123456789abcdef                 (state_hash() after the last tick; optional)
//
// With `settings basic`, `start` and `end` a tape is a whole bug report: where, under which settings, what
// was pressed, and what came of it.
//   # comments and empty lines are ignored
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "slipface/movement/step.h"

namespace slipface {

struct TapeSegment {
    int ticks = 1;
    PlayerInput input;
};

// A setting changed on the way: counts from tick `tick` on.
struct TapeChange {
    std::size_t tick = 0;
    std::string setting;  // "name=value"
    friend bool operator==(const TapeChange&, const TapeChange&) = default;
};

struct Tape {
    std::string level_name;
    std::optional<std::uint64_t> level_fingerprint;
    std::optional<std::uint64_t> surfaces_fingerprint;
    double dt = 1.0 / 60.0;
    std::string dt_text = "1/60";       // as written
    bool from_basic = false;            // `settings` begin with basic_settings(), else with the level's
    std::vector<std::string> settings;  // "name=value", in order
    std::optional<Vec3> start;
    std::vector<TapeSegment> segments;
    std::vector<TapeChange> changes;  // ascending by tick, which is above 0
    std::optional<std::uint64_t> end_hash;

    std::size_t tick_count() const;
};

inline constexpr std::size_t max_tape_ticks = 10'000'000;

// Errors name the line. `place` names the file in them.
Result<Tape> parse_tape(std::string_view text, const std::string& location);
Result<Tape> load_tape(const std::filesystem::path& path);
std::string tape_to_text(const Tape& tape);  // parse_tape(tape_to_text(t)) == t

// Inputs tick by tick, gathered into segments.
void append_tick(Tape& tape, const PlayerInput& input);
// The first `ticks` ticks; what holds for the end of the whole tape is left out.
Tape cut_tape(const Tape& tape, std::size_t ticks);

// The assignments that turn `from` into `to`, in the order of settings_table().
std::vector<std::string> setting_changes(const MovementSettings& from, const MovementSettings& to);

}  // namespace slipface
