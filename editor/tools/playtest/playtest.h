// Walking in the level: fixed time steps, interpolation between them, and the following camera.
#pragma once

#include "slipface/movement/step.h"
#include "slipface/sim/simulate.h"
#include "slipface/view/camera.h"

namespace slipface {

struct PlaytestInput {
    Vec2 stick = Vec2::Zero();  // right, forward; length 0..1, relative to the camera
    ButtonSet buttons{};        // held
    Vec2 look = Vec2::Zero();   // rotation in radians: yaw to the right, pitch up
};

class Playtest {
  public:
    static constexpr double tick_s = 1.0 / 60.0;
    static constexpr int max_ticks_per_frame = 8;  // after a longer pause the rest is dropped

    bool first_person = false;
    double yaw = 0.0, pitch = -0.2;  // of the view; yaw 0 looks along -Z, positive turns left; pitch up
    double boom = 5.0;               // third person: metres behind the player

    void start(const Vec3& spawn, double spawn_yaw);
    // Sets the level's name and fingerprints on the tape.
    void name_level(std::string name, std::uint64_t mesh_fingerprint, std::uint64_t surfaces_fingerprint);

    // Continues from the end of `tape`, with the state and position of its run there.
    void resume(const Tape& tape, const MovementSettings& settings, const PlayerState& state,
                const Vec3& position, std::uint64_t hash, double state_yaw);

    // Advances by `seconds` of real time in whole ticks and returns their number. A hazard, or a fall far
    // below the level, moves the player back to the spawn.
    int advance(const TickScene& scene, const MovementSettings& settings, const PlaytestInput& input,
                double seconds);

    const PlayerState& state() const { return state_; }
    Vec3 shown_position() const;  // interpolated between the last two ticks
    // The third-person camera moves in front of walls, so that the player is always visible.
    Camera camera(const MovementScene& scene, const MovementSettings& settings) const;
    // Everything since start(), including changes of settings; running it repeats the playtest bit by bit.
    const Tape& tape() const { return tape_; }
    // state_hash() of the last tick: the `end` of a tape.
    std::uint64_t hash() const { return hash_; }
    std::span<const TraceRecord> last_trace() const { return trace_; }  // of the last tick
    const Vec3& spawn() const {
        return spawn_;
    }  // the start of the playtest; spawn_yaw() is the view's yaw there
    double spawn_yaw() const { return spawn_yaw_; }
    int falls() const { return falls_; }  // how often the player fell out of the level
    // The player's displacement in the last tick divided by its duration, m/s. The velocity differs: on the
    // ground and at walls it includes the push against the surface.
    double speed() const { return (shown_to_ - shown_from_).norm() / tick_s; }

  private:
    PlayerState state_;
    // Positions after the last two ticks, in the level's coordinates.
    Vec3 shown_from_ = Vec3::Zero(), shown_to_ = Vec3::Zero();
    Vec3 spawn_ = Vec3::Zero();
    double spawn_yaw_ = 0.0;
    int falls_ = 0;
    double unspent_s_ = 0.0;
    ButtonSet pressed_;  // since the last tick, even if released again
    Tape tape_;
    std::size_t tape_ticks_ = 0;
    std::uint64_t hash_ = 0;
    MovementSettings tape_settings_;  // of the last tick on the tape
    std::vector<TraceRecord> trace_;
};

}  // namespace slipface
