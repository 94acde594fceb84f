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
    double yaw = 0.0, pitch = -0.2;  // of the view; yaw 0 looks along -Z, positive turns left; pitch up
    double boom = 5.0;               // third person: metres behind the player

    void start(const Vec3& spawn, double spawn_yaw);
    // The same for a level that is known: its name and fingerprint are written onto the tape.
    void name_level(std::string name, std::uint64_t fingerprint);

    // Advances by `seconds` of real time in whole ticks. Returns how many were made. A hazard puts the player
    // back to the spawn. Who falls far below the level starts anew, tape included.
    int advance(const MovementScene& scene, const MovementSettings& settings, const PlaytestInput& input,
                double seconds);

    const PlayerState& state() const { return state_; }
    Vec3 shown_position() const;  // interpolated between the last two ticks
    // Third person is pulled in front of walls so that the player is always seen.
    Camera camera(const MovementScene& scene, const MovementSettings& settings) const;
    const Tape& tape() const {
        return tape_;
    }  // everything since start(), with the settings that differ from the defaults
    // False once the settings were changed on the way: then no tape repeats this run.
    bool tape_repeats() const { return tape_repeats_; }
    std::span<const TraceRecord> last_trace() const { return trace_; }  // of the last tick
    double speed() const { return state_.velocity.norm(); }

  private:
    PlayerState state_, previous_;
    Vec3 spawn_ = Vec3::Zero();
    double unspent_s_ = 0.0;
    bool jump_pressed_ = false;  // since the last tick, even if released again
    Tape tape_;
    MovementSettings tape_settings_;
    bool tape_repeats_ = true;
    std::vector<TraceRecord> trace_;
};

}  // namespace slipface
