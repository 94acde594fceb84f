// Running a tape.
#pragma once

#include <functional>

#include "slipface/level/level.h"
#include "slipface/sim/tape.h"

namespace slipface {

struct SimulationEvent {
    std::size_t tick = 0;
    std::string kind;    // "jump", "land", "leave ground", "surface", "climb", "stick", "hazard"
    std::string detail;  // "ice", ""
};

struct SimulationReport {
    PlayerState final_state;
    std::size_t ticks = 0;
    double distance = 0.0;                     // metres along the path of the centre
    std::vector<std::uint64_t> second_hashes;  // state hash after each whole second, and after the last tick
    std::vector<SimulationEvent> events;
    std::vector<PlayerState> states;  // one a tick, if asked for
};

struct SimulationOptions {
    bool keep_states = false;
    TraceSink* trace = nullptr;
};

// `settings` already contains the tape's own settings (apply_tape_settings). Hazards put the player back to
// the start.
SimulationReport simulate(const MovementScene& scene, const MovementSettings& settings, const Vec3& start,
                          const Tape& tape, const SimulationOptions& options = {});

Status apply_tape_settings(MovementSettings& settings, const Tape& tape, const std::string& place);

// Of position, velocity and flags, chained on `previous`.
std::uint64_t state_hash(const PlayerState& state, std::uint64_t previous);

}  // namespace slipface
