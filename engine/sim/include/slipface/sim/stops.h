// Where a run lost the motion that was wished, to what, and by which rule: the headlines of the Why panel and
// of `slipface why`.
#pragma once

#include "slipface/sim/story.h"

namespace slipface {

enum class StopCause : std::uint8_t {
    wall,        // nothing to climb
    back,        // a wall touched from behind
    step,        // an edge or corner below the middle of the player
    slope,       // ground too steep to walk up
    overhead,    // something too low
    gap,         // two upright faces at once
    sticky,      // held by a sticky surface
    carried,     // a conveyor or turntable moved the player against the stick
    platform,    // a moving part of the level
    ladder_end,  // a wall above a ladder
    inside,      // the player is inside geometry
    terrain,     // steep terrain
    hazard,      // touched: back to the start
    fall,        // fell out of the level: back to the start
};
const char* stop_cause_name(StopCause cause);  // "ladder end"

// What took the motion of one tick, or of several.
struct Loss {
    StopCause cause = StopCause::wall;
    double lost_m = 0.0;                     // of the motion towards the stick
    std::optional<std::size_t> record = {};  // of the tick's trace: the response or decision that took most
    FaceId face = no_id;                     // no_id: terrain, geometry that the player is inside of
    FaceId other = no_id;                    // the face that took most after it, where both are upright
    double other_m = 0.0;                    // that it took
    bool in_air = false;                     // the player was neither standing nor held when the tick began
    SurfaceId surface = default_surface;
    Vec3 position = Vec3::Zero();  // in the level's coordinates
    Vec3 normal = Vec3::Zero();
    double height_m = 0.0;                       // of the touch above the feet
    std::optional<DecisionRecord> because = {};  // the rule that decided, where one did
};

// What took the motion of this tick; nothing where less than half of what the stick asked was lost to a
// contact.
std::optional<Loss> loss_of(const TickTrace& trace);

struct Stop {
    std::size_t first = 0, last = 0;  // ticks
    std::size_t worst = 0;            // the tick of `loss.record`
    double lost_m = 0.0;              // against the same walk without what stopped it, in all its ticks
    double lost_s = 0.0;              // the same as time at the speed that the stick asked for
    Loss loss = {};
    std::string headline = {};  // "The 0.2 m edge of `stairs` (face 12) stopped you: Step up is off"
    std::vector<StoryNumber> numbers = {};  // of the headline
};

// The ticks in which the run made less than half of the way that the stick asked for, because something took
// it: neighbouring ones together, in order. Losses of less than least_stop_s are no stops: walking along a
// wall, climbing a step.
inline constexpr double least_stop_s = 0.05;
std::vector<Stop> find_stops(const TickScene& scene, const TapeRun& run, const StoryNames& names);

// The stop to look at first: the last one; nothing if the walk went on freely.
const Stop* headline_stop(std::span<const Stop> stops);

// One line each: "at 1.25 s (tick 75, 0.4 s lost): The 0.2 m edge ...".
std::string stops_text(std::span<const Stop> stops, double dt);

}  // namespace slipface
