// Walking the level: fixed time steps, interpolation between them, and the camera that follows.
#pragma once

#include "slipface/movement/step.h"
#include "slipface/render/camera.h"
#include "slipface/sim/tape.h"

namespace slipface {

struct PlaytestInput {
    Vec2 stick = Vec2::Zero();  // right, forward; length 0..1, relative to the camera
    bool jump = false;          // held
    Vec2 look = Vec2::Zero();   // radians to turn: yaw to the right, pitch up
};

class Playtest {
  public:
    static constexpr double tick_s = 1.0 / 60.0;
    static constexpr int max_ticks_per_frame = 8;  // a long pause is not made up for

    bool first_person = false;
    double yaw = 0.0, pitch = -0.2;                // of the view; yaw 0 looks along -Z, positive turns left; pitch up
    double boom = 5.0;                             // third person: metres behind the player

    void start(const Vec3& spawn, double spawn_yaw);

    // Advances by `seconds` of real time in whole ticks. Returns how many were made. A hazard puts the player back to the spawn.
    int advance(const MovementScene& scene, const MovementSettings& settings, const PlaytestInput& input, double seconds);

    const PlayerState& state() const { return state_; }
    Vec3 shown_position() const;                   // interpolated between the last two ticks
    // Third person is pulled in front of walls so that the player is always seen.
    Camera camera(const MovementScene& scene, const MovementSettings& settings) const;
    const Tape& tape() const { return tape_; }     // everything since start()
    std::span<const TraceRecord> last_trace() const { return trace_; }  // of the last tick
    double speed() const { return state_.velocity.norm(); }

  private:
    PlayerState state_, previous_;
    Vec3 spawn_ = Vec3::Zero();
    double unspent_s_ = 0.0;
    Tape tape_;
    std::vector<TraceRecord> trace_;
};

}  // namespace slipface
