#include "slipface/sim/tape_edit.h"

#include <algorithm>
#include <limits>

namespace slipface {
namespace {

void append(Tape& tape, std::size_t ticks, const PlayerInput& input) {
    std::vector<TapeSegment>& segments = tape.segments;
    const bool same = !segments.empty() && segments.back().input.wish == input.wish &&
                      segments.back().input.buttons == input.buttons;
    if (same) {
        const auto room = static_cast<std::size_t>(std::numeric_limits<int>::max() - segments.back().ticks);
        const std::size_t joined = std::min(ticks, room);
        segments.back().ticks += static_cast<int>(joined);
        ticks -= joined;
    }
    if (ticks > 0) segments.push_back({static_cast<int>(ticks), input});
}

// The tape with other inputs in [first, last): `change` makes each from what was there, and is asked once per
// segment.
template <class Change>
Tape changed(const Tape& tape, std::size_t first, std::size_t last, const Change& change) {
    Tape result = tape;
    result.end_hash.reset();
    result.segments.clear();
    std::size_t begin = 0;
    for (const TapeSegment& segment : tape.segments) {
        const std::size_t end = begin + static_cast<std::size_t>(std::max(segment.ticks, 0));
        const std::size_t from = std::clamp(first, begin, end), to = std::clamp(last, from, end);
        if (from > begin) append(result, from - begin, segment.input);
        if (to > from) append(result, to - from, change(segment.input));
        if (end > to) append(result, end - to, segment.input);
        begin = end;
    }
    return result;
}

}  // namespace

std::vector<StickSpan> stick_spans(const Tape& tape) {
    std::vector<StickSpan> spans;
    std::size_t tick = 0;
    for (const TapeSegment& segment : tape.segments) {
        const std::size_t end = tick + static_cast<std::size_t>(std::max(segment.ticks, 0));
        if (!spans.empty() && spans.back().wish == segment.input.wish)
            spans.back().last = end;
        else if (end > tick)
            spans.push_back({tick, end, segment.input.wish});
        tick = end;
    }
    return spans;
}

std::vector<TickRange> presses_of(const Tape& tape, ButtonSet buttons) {
    std::vector<TickRange> presses;
    std::size_t tick = 0;
    for (const TapeSegment& segment : tape.segments) {
        const std::size_t end = tick + static_cast<std::size_t>(std::max(segment.ticks, 0));
        if ((segment.input.buttons.bits & buttons.bits) != 0) {
            if (!presses.empty() && presses.back().last == tick)
                presses.back().last = end;
            else
                presses.push_back({tick, end});
        }
        tick = end;
    }
    return presses;
}

ButtonSet buttons_of(const Tape& tape) {
    ButtonSet all;
    for (const TapeSegment& segment : tape.segments)
        all = all | segment.input.buttons;
    return all;
}

Tape with_stick(const Tape& tape, std::size_t first, std::size_t last, const Vec2& wish) {
    return changed(tape, first, last, [&](PlayerInput input) {
        input.wish = wish;
        return input;
    });
}

Tape with_buttons(const Tape& tape, std::size_t first, std::size_t last, ButtonSet buttons, bool held) {
    return changed(tape, first, last, [&](PlayerInput input) {
        input.buttons.bits = held ? input.buttons.bits | buttons.bits : input.buttons.bits & ~buttons.bits;
        return input;
    });
}

Tape move_press(const Tape& tape, ButtonSet buttons, const TickRange& from, const TickRange& to) {
    return with_buttons(with_buttons(tape, from.first, from.last, buttons, false), to.first, to.last, buttons,
                        true);
}

Tape insert_ticks(const Tape& tape, std::size_t at, std::size_t count) {
    const std::size_t length = tape.tick_count();
    at = std::min(at, length);
    count = std::min(count, max_tape_ticks - std::min(length, max_tape_ticks));
    Tape result = cut_tape(tape, at);
    const std::size_t model = at > 0 ? at - 1 : 0;
    std::size_t begin = 0;
    for (const TapeSegment& segment : tape.segments) {
        const std::size_t end = begin + static_cast<std::size_t>(std::max(segment.ticks, 0));
        if (model >= begin && model < end) append(result, count, segment.input);
        if (end > at) append(result, end - std::max(begin, at), segment.input);
        begin = end;
    }
    result.changes = tape.changes;
    for (TapeChange& change : result.changes)
        if (change.tick >= at) change.tick += count;
    return result;
}

Tape remove_ticks(const Tape& tape, std::size_t first, std::size_t last) {
    const std::size_t length = tape.tick_count();
    first = std::min(first, length);
    last = std::clamp(last, first, length);
    if (last - first == length && first < last) ++first;
    Tape result = cut_tape(tape, first);
    std::size_t begin = 0;
    for (const TapeSegment& segment : tape.segments) {
        const std::size_t end = begin + static_cast<std::size_t>(std::max(segment.ticks, 0));
        if (end > last) append(result, end - std::max(begin, last), segment.input);
        begin = end;
    }
    result.changes.clear();
    for (TapeChange change : tape.changes) {
        if (change.tick >= last)
            change.tick -= last - first;
        else
            change.tick = std::min(change.tick, first);
        if (change.tick == 0)
            result.settings.push_back(change.setting);
        else if (change.tick < length - (last - first))
            result.changes.push_back(change);
    }
    return result;
}

}  // namespace slipface
