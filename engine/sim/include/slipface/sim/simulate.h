// Running a tape.
#pragma once

#include <functional>

#include "slipface/level/level.h"
#include "slipface/sim/tape.h"
#include "slipface/sim/tick_scene.h"

namespace slipface {

struct SimulationEvent {
    std::size_t tick = 0;
    std::string kind;    // "jump", "land", "leave ground", "surface", "climb", "stick", "hazard", "fall"
    std::string detail;  // "ice", ""
};

struct SimulationReport {
    PlayerState final_state;
    std::size_t ticks = 0;
    double distance = 0.0;                     // metres along the path of the centre
    std::uint64_t end_hash = 0;                // state hash after the last tick, what `end` of a tape names
    std::vector<std::uint64_t> second_hashes;  // state hash after each whole second, and after the last tick
    std::vector<SimulationEvent> events;
    std::uint64_t falls = 0;          // times the player fell out of the level and began again
    std::uint64_t hazards = 0;        // times a hazard sent the player back to the start
    std::vector<PlayerState> states;  // one a tick, if asked for
};

struct SimulationOptions {
    bool keep_states = false;
    TraceSink* trace = nullptr;
};

// Where a run begins, and begins again after a hazard or a fall.
struct RunStart {
    PlayerState player;
    double lowest =
        0.0;  // a player below this height has fallen out of the level; in the scene's coordinates
};
// `start` in the level's coordinates. The level's fall limit holds if the start is above it; else the player
// may fall 60 m below the level and the start.
RunStart run_start(const TickScene& scene, const Vec3& start);

// One tick as tapes, playtest and lab make it: step(), and back to the start for a player who touched a
// hazard or fell out of the level. Part of the run and not of step(), so a tape repeats it bit by bit without
// naming it.
enum class Respawn : std::uint8_t { none, hazard, fall };
struct TickResult {
    PlayerState state;    // at `start` after a respawn
    PlayerState stepped;  // what step() returned
    Respawn respawn = Respawn::none;
    int contacts = 0;
    bool end_is_free = false;  // as StepResult's, of `stepped`
};
TickResult play_tick(const MovementScene& scene, const MovementSettings& settings, const PlayerState& before,
                     const PlayerInput& input, double dt, const RunStart& start, TraceSink* trace = nullptr);

// Tells what changed between two ticks, as events.
class EventLog {
  public:
    // `surface` is the one held last, for going on with a log.
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

// Runs a tape from `start`, a place of the level. `settings` already contains the tape's own settings
// (apply_tape_settings); its changes on the way are applied, those that are no settings are left out.
SimulationReport simulate(const TickScene& scene, const MovementSettings& settings, const Vec3& start,
                          const Tape& tape, const SimulationOptions& options = {});

// The tape's settings at its first tick, put over `settings`, or over the defaults if the tape says so.
Status apply_tape_settings(MovementSettings& settings, const Tape& tape, const std::string& location);

// Of every member of the state, chained on `previous`.
std::uint64_t state_hash(const PlayerState& state, std::uint64_t previous);

// Of what a tape's run depends on beside the geometry: the surface types, the type of every face, and
// where platforms stand and how they move at that time.
std::uint64_t scene_fingerprint(const MovementScene& scene);

}  // namespace slipface
