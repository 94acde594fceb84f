// Changing the inputs of a tape by hand: longer or later presses, another stick, more or fewer ticks.
//
// Each function returns another tape, without `end_hash`, because its end is not known yet. Ranges are
// [first, last) in ticks; what lies outside of the tape is left out.
//
//     const std::vector<TickRange> jumps = presses_of(tape, ButtonSet(Button::jump));
//     tape = move_press(tape, ButtonSet(Button::jump), jumps[0], {jumps[0].first - 3, jumps[0].last});
#pragma once

#include "slipface/sim/tape.h"

namespace slipface {

// Ticks from `first` up to, but not including, `last`: those of a press, say.
struct TickRange {
    std::size_t first = 0, last = 0;
    friend bool operator==(const TickRange&, const TickRange&) = default;
};

// Ticks [first, last) in which the stick stays where it is. Those of a tape are ascending and without gaps.
struct StickSpan {
    std::size_t first = 0, last = 0;
    Vec2 wish = Vec2::Zero();
};
std::vector<StickSpan> stick_spans(const Tape& tape);

// The presses of any of those buttons, ascending.
std::vector<TickRange> presses_of(const Tape& tape, ButtonSet buttons);
// All buttons that the tape holds anywhere.
ButtonSet buttons_of(const Tape& tape);

Tape with_stick(const Tape& tape, std::size_t first, std::size_t last, const Vec2& wish);
Tape with_buttons(const Tape& tape, std::size_t first, std::size_t last, ButtonSet buttons, bool held);
// Releases the buttons in `from` and holds them in `to`.
Tape move_press(const Tape& tape, ButtonSet buttons, const TickRange& from, const TickRange& to);

// Repeats the input before tick `at` (of the start: the first) `count` times more; later changes of settings
// move with their ticks. At most max_tape_ticks.
Tape insert_ticks(const Tape& tape, std::size_t at, std::size_t count);
// At least one tick stays. Changes of settings in what is removed happen where it was.
Tape remove_ticks(const Tape& tape, std::size_t first, std::size_t last);

}  // namespace slipface
