// What happened in a run beside its stops, and why: jumps, landings, bounces, slides, presses of the button
// that did nothing. The list under the stops in the Why panel, and `slipface why --events`.
#pragma once

#include <functional>

#include "slipface/sim/story.h"

namespace slipface {

struct RunEvent {
    std::string word;                 // "bounced", "no jump"; events of one word are of one kind
    std::size_t first = 0, last = 0;  // ticks
    std::string text;                 // "Jumped 0.62 m high instead of 1.6 m: `beam` (face 3) was in the way"
    std::vector<StoryNumber> numbers;  // of the text
    FaceId face = no_id;               // that took part
    Vec3 position = Vec3::Zero();      // of the player, in the level's coordinates
};

// In the order of their first ticks. Simulates the run once more, with traces.
std::vector<RunEvent> find_events(const TickScene& scene, const TapeRun& run, const StoryNames& names,
                                  const std::function<bool()>& cancelled = {});

// One line each: "at 1.25 s  bounced  Bounced off at 9.4 m/s".
std::string events_text(std::span<const RunEvent> events, double dt);

// Where the velocity of a tick came from: what each rule added to it, in order. The sum is the difference of
// the velocities after and before.
struct VelocityChange {
    std::string text;                        // "Stick", "Gravity", "Jump", "slide along face 12 of `wall`"
    Vec3 change = Vec3::Zero();              // m/s
    std::optional<std::size_t> record = {};  // in the trace
};
std::vector<VelocityChange> velocity_changes(const TickTrace& trace, const StoryNames& names);
// "Velocity from 6 m/s to 2.1 m/s" and a line for each change.
std::string velocity_text(const TickTrace& trace, const StoryNames& names);

}  // namespace slipface
