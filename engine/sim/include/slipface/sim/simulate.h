// Simulates the inputs of a tape.
#pragma once

#include <functional>

#include "slipface/level/level.h"
#include "slipface/sim/tape.h"
#include "slipface/sim/tick_scene.h"

namespace slipface {

struct SimulationEvent {
    std::size_t tick = 0;
    std::string
        kind;  // "jump", "land", "leave ground", "surface", "climb", "stick", "hazard", "crushed", "fall"
    std::string detail;  // "ice", ""
};

struct SimulationReport {
    PlayerState final_state;
    std::size_t ticks = 0;
    double distance = 0.0;       // metres along the path of the centre
    std::uint64_t end_hash = 0;  // state_hash() after the last tick; `end` in a tape is this value
    std::vector<std::uint64_t> second_hashes;  // state_hash() after each whole second and at the end
    std::vector<SimulationEvent> events;
    std::uint64_t falls = 0;          // times the player fell out of the level and was sent back to the start
    std::uint64_t hazards = 0;        // times a hazard sent the player back to the start
    std::uint64_t crushed = 0;        // times a platform did
    std::vector<PlayerState> states;  // one per tick, if SimulationOptions::keep_states
};

struct SimulationOptions {
    bool keep_states = false;
    TraceSink* trace = nullptr;  // receives the records of all ticks; may be null
};

// The state in which a run starts, also after a hazard or a fall.
struct RunStart {
    PlayerState player;
    double lowest =
        0.0;  // a player below this height has fallen out of the level; metres, in the scene's coordinates
};
// `start` is in the level's coordinates. The level's fall limit is used if the start is above it. Else the
// limit is 60 m below the lower of the start and the lowest static point.
RunStart run_start(const TickScene& scene, const Vec3& start);

// One tick of tapes, playtest and lab: step(), or another mover's, and then back to the start if the player
// touched a hazard, was crushed by a platform or fell out of the level. The return is part of the run and not
// of step(): tapes repeat it unrecorded.
enum class Respawn : std::uint8_t { none, hazard, crushed, fall };
struct TickResult {
    PlayerState state;    // at `start` after a respawn
    PlayerState stepped;  // what step() returned
    Respawn respawn = Respawn::none;
    int contacts = 0;
    bool end_is_free = false;  // StepResult::end_is_free, of `stepped`
    bool crowded = false;      // StepResult::crowded
};
TickResult play_tick(const MovementScene& scene, const MovementSettings& settings, const PlayerState& before,
                     const PlayerInput& input, double dt, const RunStart& start, TraceSink* trace = nullptr,
                     StepFunction mover = step);

// Writes the changes between consecutive ticks as events.
class EventLog {
  public:
    // Appends to `events`, which must outlive the log. `surface` is the last surface of an earlier log that
    // this one continues.
    EventLog(SurfaceTable surfaces, std::vector<SimulationEvent>& events, SurfaceId surface = default_surface)
        : surfaces_(surfaces), events_(events), surface_(surface) {}
    SurfaceId surface() const { return surface_; }
    void add(std::size_t tick, const PlayerState& before, const PlayerInput& input, const TickResult& after);

  private:
    void log(std::size_t tick, const char* kind, const PlayerState& state);

    SurfaceTable surfaces_;
    std::vector<SimulationEvent>& events_;
    SurfaceId surface_;
};

// Simulates a tape from `start`, in the level's coordinates. `settings` already include the tape's own
// settings (apply_tape_settings()). The tape's changes are applied at their ticks; unknown settings among
// them are ignored.
SimulationReport simulate(const TickScene& scene, const MovementSettings& settings, const Vec3& start,
                          const Tape& tape, const SimulationOptions& options = {});

// Applies the tape's settings at its first tick to `settings`, or to basic_settings() if the tape starts with
// them. Errors name `location` and the setting.
Status apply_tape_settings(MovementSettings& settings, const Tape& tape, const std::string& location);

// A hash of every member of the state, chained with `previous`.
std::uint64_t state_hash(const PlayerState& state, std::uint64_t previous);

// A hash of what a tape's run depends on beside the geometry: the surface types, the type of every static
// face, and the end poses and velocities of the scene's platforms.
std::uint64_t scene_fingerprint(const MovementScene& scene);

}  // namespace slipface
