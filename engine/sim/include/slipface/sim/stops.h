// Where a run lost the motion that the stick requested, to which cause, and by which rule: the headlines of
// the Why panel and of `slipface why`.
#pragma once

#include <functional>

#include "slipface/sim/story.h"

namespace slipface {

enum class StopCause : std::uint8_t {
    wall,        // an upright face
    back,        // a wall touched from behind
    step,        // an edge or corner below the middle of the player
    slope,       // ground too steep to walk up
    overhead,    // geometry too low to pass under
    gap,         // between two upright faces, each of which alone would let the player on
    corner,      // two upright faces that both stand in the stick's way
    sticky,      // held by a sticky surface
    carried,     // a conveyor or turntable moved the player against the stick
    slippery,    // ground whose friction does not hold against the slope
    platform,    // a moving part of the level
    ladder_end,  // a wall above a ladder
    inside,      // the player is inside geometry
    terrain,     // steep terrain
    // The player was sent back to the start:
    hazard,   // touched a hazard: back to the start
    crushed,  // by a platform that left no room: back to the start
    fall,     // fell out of the level: back to the start
};
const char* stop_cause_name(StopCause cause);  // "ladder end"

// The cause of the motion lost in one tick or several.
struct Loss {
    StopCause cause = StopCause::wall;
    double lost_m = 0.0;                     // motion towards the stick
    std::optional<std::size_t> record = {};  // in the tick's trace: the response or decision that cost most
    FaceId face = no_id;                     // no_id: terrain, or geometry that the player is inside of
    FaceId other = no_id;  // the second face of a gap, a corner, a press; where a fall would have ended
    bool hole = false;     // of a gap: there is no ground between the two faces
    bool in_air = false;   // the player was neither standing nor held when the tick began
    SurfaceId surface = default_surface;
    Vec3 position = Vec3::Zero();  // in the level's coordinates
    Vec3 normal = Vec3::Zero();
    double height_m = 0.0;                       // of the contact above the feet
    double top_m = 0.0;                          // of what stopped the player, above the feet; 0: not known
    double clearance_m = 0.0;                    // below what hangs too low; 0: not known
    std::optional<DecisionRecord> because = {};  // the rule that decided, if there is one
};

// The loss of this tick; nothing if the player still made at least as much motion towards the stick as was
// lost. A hazard, steep terrain, being inside geometry and being crushed are always reported.
std::optional<Loss> loss_of(const TickTrace& trace);

// Why nothing carried a player who fell out of the level, or deep.
enum class FallCause : std::uint8_t {
    unknown,    // walked or jumped off
    not_solid,  // the type of what lay below is not solid
    one_sided,  // what lay below holds from its other side
    cut_short,  // something was in the way of a jump
    by_type,    // on plain ground the player would have stayed: a belt, ice, a trampoline
    pushed,     // off the ground: by a moving part of the level, or by what stands in a platform's way
    too_short,  // the jump did not reach the ground ahead
};

struct Stop {
    std::size_t first = 0, last = 0;  // ticks
    std::size_t worst = 0;            // the tick of `loss.record`
    std::size_t left = 0;             // of a fall: the tick in which the ground was left; else `first`
    double lost_m = 0.0;              // over all its ticks, against the same walk without the obstacle
    double lost_s = 0.0;              // the same as time at the speed that the stick requested
    double wished_m = 0.0;            // what the stick requested in these ticks
    Loss loss = {};
    FallCause fall = FallCause::unknown;
    double short_m = 0.0, low_m = 0.0;  // what was missing of a jump, along and up
    double fell_m = 0.0;                // of a fall that ended on lower ground; 0: it was out of the level
    bool blind_after = false;  // the player was sent back, and the stick went on as if it had not been
    double feet_m = 0.0;       // the height of the feet at the tick `worst`, in the level's coordinates
    std::vector<FaceId> held_by = {};  // without these faces the player gets on; empty: not known
    std::string headline = {};         // "The 0.2 m edge of `stairs` (face 12) stopped you: Step up is off"
    std::vector<StoryNumber> numbers = {};  // of the headline
    const char* symptom = "";               // the title of its section in docs/symptoms.md
};

// The stops of a run, in order: neighbouring ticks in which the run made less than half of the motion that
// the stick requested. A loss below least_stop_s is no stop: walking along a wall, climbing a step. Each
// return to the start is a stop of its own, and each fall by more than the player's height onto lower ground
// that a type or a push caused: without it the player would have stayed up.
//
// What held the player is found by trying: the run is played again without what was met, until the player
// gets on, and what may stay is put back. Where several things hold it, each alone, the headline names the
// one that is out of the settings' bounds. Between two stops it asks `cancelled`, if given, and then ends
// early.
inline constexpr double least_stop_s = 0.05;
std::vector<Stop> find_stops(const TickScene& scene, const TapeRun& run, const Level& level,
                             const std::function<bool()>& cancelled = {});

// The same from the traces alone, without trying: for counting.
std::vector<Stop> count_stops(const TickScene& scene, const TapeRun& run, const StoryNames& names);

// The stop to look at first: the last one, or the first after which the tape goes on blindly; null if there
// is none.
const Stop* headline_stop(std::span<const Stop> stops);

// One line each: "at 1.25 s (tick 75, 0.4 s lost): The 0.2 m edge ...".
std::string stops_text(std::span<const Stop> stops, double dt);

}  // namespace slipface
