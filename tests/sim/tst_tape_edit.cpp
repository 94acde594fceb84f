// Tapes that are changed by hand: each function against the same change made tick by tick.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "slipface/sim/tape_edit.h"

namespace slipface::test {
namespace {

using Inputs = std::vector<PlayerInput>;

Inputs inputs_of(const Tape& tape) {
    Inputs inputs;
    for (const TapeSegment& segment : tape.segments)
        inputs.insert(inputs.end(), static_cast<std::size_t>(segment.ticks), segment.input);
    return inputs;
}

// Equal inputs stand in one segment, and nothing is empty.
void expect_inputs(const Tape& tape, const Inputs& expected) {
    const Inputs found = inputs_of(tape);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_EQ(found[i].wish, expected[i].wish) << i;
        ASSERT_EQ(found[i].buttons, expected[i].buttons) << i;
    }
    EXPECT_FALSE(tape.end_hash);
    for (std::size_t i = 0; i < tape.segments.size(); ++i)
        EXPECT_GT(tape.segments[i].ticks, 0);
    const Result<Tape> again = parse_tape(tape_to_text(tape), "again");
    ASSERT_TRUE(again) << again.error().text();
    EXPECT_EQ(again->changes, tape.changes);
}

class Dice {
  public:
    explicit Dice(unsigned seed) : random_(seed) {}
    std::size_t below(std::size_t limit) { return random_() % limit; }
    PlayerInput input() {
        static constexpr double steps[] = {-0.5, 0.0, 0.5};
        PlayerInput input;
        input.wish.x() = steps[below(3)];
        input.wish.y() = steps[below(3)];
        input.buttons.bits = static_cast<std::uint32_t>(below(4));
        return input;
    }
    Tape tape() {
        Tape tape;
        tape.end_hash = 7;
        const std::size_t ticks = 1 + below(60);
        while (tape.tick_count() < ticks)
            for (std::size_t i = 1 + below(9), same = below(2); i-- > 0;)
                append_tick(tape, same ? PlayerInput{} : input());
        for (std::size_t at = 1 + below(20); at < tape.tick_count(); at += 1 + below(20))
            tape.changes.push_back({at, "gravity=" + std::to_string(10 + below(9))});
        return tape;
    }

  private:
    std::mt19937 random_;
};

constexpr ButtonSet jump = Button::jump;

TEST(TapeEdit, ChangesWhatIsAskedAndNothingElse) {
    for (unsigned seed = 1; seed <= 500; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        const Tape tape = dice.tape();
        const std::size_t first = dice.below(70), last = dice.below(70);
        Inputs stick = inputs_of(tape), held = stick, inserted = stick, removed = stick;
        for (std::size_t i = first; i < std::min(last, stick.size()); ++i) {
            stick[i].wish = {0.25, -0.75};
            held[i].buttons.set(Button::jump, seed % 2 == 0);
        }
        expect_inputs(with_stick(tape, first, last, {0.25, -0.75}), stick);
        expect_inputs(with_buttons(tape, first, last, jump, seed % 2 == 0), held);

        const std::size_t at = std::min(first, inserted.size());
        inserted.insert(inserted.begin() + static_cast<std::ptrdiff_t>(at), 5, inserted[at > 0 ? at - 1 : 0]);
        expect_inputs(insert_ticks(tape, first, 5), inserted);

        std::size_t from = at;
        const std::size_t to = std::clamp(last, from, removed.size());
        if (from == 0 && to == removed.size()) ++from;
        removed.erase(removed.begin() + static_cast<std::ptrdiff_t>(from),
                      removed.begin() + static_cast<std::ptrdiff_t>(to));
        expect_inputs(remove_ticks(tape, first, last), removed);
    }
}

TEST(TapeEdit, RemovingWhatWasInsertedRestoresTheRun) {
    for (unsigned seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        const Tape tape = dice.tape();
        const std::size_t at = 1 + dice.below(tape.tick_count());
        const Tape back = remove_ticks(insert_ticks(tape, at, 7), at, at + 7);
        Tape expected = tape;
        expected.end_hash.reset();
        expect_inputs(back, inputs_of(expected));
        EXPECT_EQ(back.changes, expected.changes);
    }
}

TEST(TapeEdit, SpansAndPressesCoverTheTape) {
    for (unsigned seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        const Tape tape = dice.tape();
        const Inputs inputs = inputs_of(tape);
        std::size_t tick = 0;
        for (const StickSpan& span : stick_spans(tape)) {
            ASSERT_EQ(span.first, tick);
            for (; tick < span.last; ++tick)
                ASSERT_EQ(inputs[tick].wish, span.wish);
            if (tick < inputs.size()) {
                EXPECT_NE(inputs[tick].wish, span.wish);
            }
        }
        EXPECT_EQ(tick, inputs.size());
        std::vector<bool> held(inputs.size());
        for (const TickRange& press : presses_of(tape, jump)) {
            ASSERT_LT(press.first, press.last);
            std::fill(held.begin() + static_cast<std::ptrdiff_t>(press.first),
                      held.begin() + static_cast<std::ptrdiff_t>(press.last), true);
            EXPECT_TRUE(press.first == 0 || !inputs[press.first - 1].buttons.has(Button::jump));
        }
        for (std::size_t i = 0; i < inputs.size(); ++i)
            EXPECT_EQ(held[i], inputs[i].buttons.has(Button::jump)) << i;
    }
}

TEST(TapeEdit, AMovedPressKeepsOthers) {
    Tape tape;
    for (int i = 0; i < 20; ++i)
        append_tick(tape,
                    {.wish = {0, -1},
                     .buttons = ButtonSet(Button::jump, i >= 5 && i < 9) | ButtonSet(Button::dash, i >= 7)});
    const Tape moved = move_press(tape, jump, {5, 9}, {12, 14});
    EXPECT_EQ(presses_of(moved, jump), (std::vector<TickRange>{{12, 14}}));
    EXPECT_EQ(presses_of(moved, Button::dash), (std::vector<TickRange>{{7, 20}}));
    EXPECT_EQ(buttons_of(moved), ButtonSet(Button::jump) | ButtonSet(Button::dash));
}

}  // namespace
}  // namespace slipface::test
