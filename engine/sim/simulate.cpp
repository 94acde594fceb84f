#include "slipface/sim/simulate.h"

#include <cmath>

#include "slipface/base/hash.h"

namespace slipface {
namespace {

bool holds(const PlayerState& state) {
    return state.grounded || state.climbing || state.stuck;
}

// Tells what changed between two ticks.
class EventLog {
  public:
    EventLog(SurfaceTable surfaces, std::vector<SimulationEvent>& events)
        : surfaces_(surfaces), events_(events) {}

    void add(std::size_t tick, const PlayerState& before, const PlayerInput& input,
             const PlayerState& after) {
        if (after.hazard) log(tick, "hazard", after);
        if (holds(before) && !holds(after) && input.jump && !before.jump_held) {
            log(tick, "jump", before);
        } else if (before.grounded && !after.grounded) {
            log(tick, "leave ground", before);
        }
        if (after.grounded && !before.grounded) log(tick, "land", after);
        if (after.climbing && !before.climbing) log(tick, "climb", after);
        if (after.stuck && !before.stuck) log(tick, "stick", after);
        if (holds(after) && after.ground_surface != surface_) {
            surface_ = after.ground_surface;
            log(tick, "surface", after);
        }
    }

  private:
    void log(std::size_t tick, const char* kind, const PlayerState& state) {
        const bool known = state.ground_surface < surfaces_.size();
        events_.push_back({tick, kind, known ? surfaces_[state.ground_surface].name : std::string()});
    }

    SurfaceTable surfaces_;
    std::vector<SimulationEvent>& events_;
    SurfaceId surface_ = default_surface;
};

// Whole seconds in `ticks` steps of `dt`; the share of a tick added keeps 60 steps of 1/60 one second.
std::size_t whole_seconds(std::size_t ticks, double dt) {
    return static_cast<std::size_t>((static_cast<double>(ticks) + 1e-6) * dt);
}

}  // namespace

std::uint64_t state_hash(const PlayerState& state, std::uint64_t previous) {
    Hasher hasher;
    hasher.u64(previous);
    for (const Vec3* vector : {&state.position, &state.velocity}) {
        for (int axis = 0; axis < 3; ++axis)
            hasher.f64((*vector)[axis]);
    }
    std::uint64_t flags = 0;
    for (const bool flag : {state.grounded, state.climbing, state.stuck, state.jump_held, state.hazard}) {
        flags = flags * 2 + (flag ? 1 : 0);
    }
    hasher.u64(flags);
    return hasher.value();
}

Status apply_tape_settings(MovementSettings& settings, const Tape& tape, const std::string& place) {
    MovementSettings changed = settings;
    for (const std::string& assignment : tape.settings) {
        const Status status = set_setting(changed, assignment);
        if (!status.ok()) return Error{place, "set " + assignment + ": " + status.error().text()};
    }
    settings = changed;
    return {};
}

SimulationReport simulate(const MovementScene& scene, const MovementSettings& settings, const Vec3& start,
                          const Tape& tape, const SimulationOptions& options) {
    SimulationReport report;
    EventLog log(scene.surfaces, report.events);
    PlayerState state;
    state.position = start;
    std::uint64_t hash = 0;
    for (const TapeSegment& segment : tape.segments) {
        for (int i = 0; i < segment.ticks; ++i) {
            const PlayerState before = state;
            state = step(scene, settings, before, segment.input, tape.dt, options.trace).state;
            report.distance += (state.position - before.position).norm();
            log.add(report.ticks, before, segment.input, state);
            if (state.hazard) {
                state = PlayerState{};
                state.position = start;
                state.jump_held = segment.input.jump;
            }
            hash = state_hash(state, hash);
            ++report.ticks;
            if (options.keep_states) report.states.push_back(state);
            if (whole_seconds(report.ticks, tape.dt) > whole_seconds(report.ticks - 1, tape.dt)) {
                report.second_hashes.push_back(hash);
            }
        }
    }
    const bool hashed = whole_seconds(report.ticks, tape.dt) >
                        whole_seconds(std::max<std::size_t>(report.ticks, 1) - 1, tape.dt);
    if (report.ticks > 0 && !hashed) report.second_hashes.push_back(hash);
    report.final_state = state;
    return report;
}

}  // namespace slipface
