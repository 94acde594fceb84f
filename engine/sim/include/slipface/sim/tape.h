// A tape: the inputs of a run as text, sufficient to repeat it bit by bit.
//
//   slipface-tape 1
//   level easy.obj 1f2e3d4c5b6a7988      (name, mesh fingerprint; optional)
//   surfaces 8a7b6c5d4e3f2a1b            (scene_fingerprint(); optional)
//   dt 1/60
//   settings basic                       (optional: start from basic_settings(), not from the level's;
//                                         "settings defaults" is the same)
//   set max_slope=0.7                    (any number of these)
//   mover lecture                        (optional: a mover of lecture_mover.h in place of Slipface's)
//   start 0,1,0                          (optional; else the level's spawn)
//   60 wish 0,-1                         (for 60 ticks: walk along -Z)
//   set step_up=off                      (from the next tick on)
//   1 wish 0,-1 jump                     (buttons that are held: names of button_table(), or any others)
//   end 0123456789abcdef                 (state_hash() after the last tick; optional)
//
//   # comments and empty lines are ignored
//
// Buttons that the table does not name, a game's own or those of a newer program, are kept with their names
// and change nothing in a run.
//
// With `settings basic`, `start` and `end` a tape is a complete bug report.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "slipface/movement/step.h"
#include "slipface/sim/lecture_mover.h"

namespace slipface {

struct TapeSegment {
    int ticks = 1;
    PlayerInput input;
};

// A setting that changes during the tape, from tick `tick` on.
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
    bool from_basic = false;            // true: `settings` change basic_settings(), else the level's
    std::vector<std::string> settings;  // "name=value", in order
    const NamedMover* mover = nullptr;  // null: Slipface's own
    std::optional<Vec3> start;
    std::vector<TapeSegment> segments;
    std::vector<TapeChange> changes;  // ascending by tick, which is above 0
    std::optional<std::uint64_t> end_hash;
    // Names of the buttons from ButtonSet::first_own on: lowercase letters, digits and underscores.
    std::vector<std::string> own_buttons;

    std::size_t tick_count() const;
};

// What moves the tape's player.
inline StepFunction step_of(const Tape& tape) {
    return tape.mover == nullptr ? step : tape.mover->step;
}

inline constexpr std::size_t max_tape_ticks = 10'000'000;

// Errors name the line; `location` names the file in them.
Result<Tape> parse_tape(std::string_view text, const std::string& location);
Result<Tape> load_tape(const std::filesystem::path& path);
// The text of a tape. parse_tape() reads the same run back; a change inside a segment splits the segment.
std::string tape_to_text(const Tape& tape);

// The names of the buttons that are held, in the order of their bits; "own3" for one that the tape has no
// name for.
std::vector<std::string> button_names(const Tape& tape, ButtonSet buttons);

// Appends one tick. Equal inputs are joined into one segment.
void append_tick(Tape& tape, const PlayerInput& input);
// The first `ticks` ticks, without the end hash.
Tape cut_tape(const Tape& tape, std::size_t ticks);

// The assignments "name=value" that change `from` into `to`, in the order of settings_table().
std::vector<std::string> setting_changes(const MovementSettings& from, const MovementSettings& to);

}  // namespace slipface
