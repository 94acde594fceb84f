// A tape: the inputs of a run as text, enough to repeat it bit by bit.
//
//   slipface-tape 1
//   level easy.obj 1f2e3d4c5b6a7988      (name, mesh fingerprint; optional)
//   dt 1/60
//   set max_slope=0.7                    (any number of settings)
//   start 0,1,0                          (optional; else the level's spawn)
//   60 wish 0,-1                         (for 60 ticks: walk along -Z)
//   1 wish 0,-1 jump
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

struct Tape {
    std::string level_name;
    std::optional<std::uint64_t> level_fingerprint;
    double dt = 1.0 / 60.0;
    std::string dt_text = "1/60";       // as written
    std::vector<std::string> settings;  // "name=value", in order
    std::optional<Vec3> start;
    std::vector<TapeSegment> segments;

    std::size_t tick_count() const;
};

inline constexpr std::size_t max_tape_ticks = 10'000'000;

// Errors name the line. `place` names the file in them.
Result<Tape> parse_tape(std::string_view text, const std::string& place);
Result<Tape> load_tape(const std::filesystem::path& path);
std::string tape_to_text(const Tape& tape);  // parse_tape(tape_to_text(t)) == t

// Inputs tick by tick, gathered into segments.
void append_tick(Tape& tape, const PlayerInput& input);

}  // namespace slipface
