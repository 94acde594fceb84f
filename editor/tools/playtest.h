// Walking the level: fixed time steps, interpolation between them, and the camera that follows.
#pragma once

#include "slipface/movement/step.h"
#include "slipface/render/camera.h"
#include "slipface/sim/simulate.h"

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
    // The level's name and fingerprints are written onto the tape.
    void name_level(std::string name, std::uint64_t mesh_fingerprint, std::uint64_t surfaces_fingerprint);

    // Goes on from the end of `tape`, in the state and at the place that its run has there.
    void resume(const Tape& tape, const MovementSettings& settings, const PlayerState& state,
                const Vec3& position, std::uint64_t hash, double state_yaw);

    // Advances by `seconds` of real time in whole ticks. Returns how many were made. A hazard, or a fall far
    // below the level, puts the player back to the spawn.
    int advance(const TickScene& scene, const MovementSettings& settings, const PlaytestInput& input,
                double seconds);

    const PlayerState& state() const { return state_; }
    Vec3 shown_position() const;  // interpolated between the last two ticks
    // Third person is pulled in front of walls so that the player is always seen.
    Camera camera(const MovementScene& scene, const MovementSettings& settings) const;
    // Everything since start(), with all settings, those changed on the way too: it repeats the run bit by
    // bit.
    const Tape& tape() const { return tape_; }
    std::uint64_t hash() const {
        return hash_;
    }  // state_hash() of the last tick, as `end` of a tape names it
    std::span<const TraceRecord> last_trace() const { return trace_; }  // of the last tick
    const Vec3& spawn() const { return spawn_; }  // where it began; the yaw of the view then
    double spawn_yaw() const { return spawn_yaw_; }
    int falls() const { return falls_; }  // times the player fell out of the level and began again
    // How fast the player moved in the last tick, m/s. The velocity is not it: on the ground it holds the
    // push against the floor, at a wall the push against the wall.
    double speed() const { return (shown_to_ - shown_from_).norm() / tick_s; }

  private:
    PlayerState state_;
    Vec3 shown_from_ = Vec3::Zero(),
         shown_to_ = Vec3::Zero();  // the last two ticks, in the level's coordinates
    Vec3 spawn_ = Vec3::Zero();
    double spawn_yaw_ = 0.0;
    int falls_ = 0;
    double unspent_s_ = 0.0;
    bool jump_pressed_ = false;  // since the last tick, even if released again
    Tape tape_;
    std::size_t tape_ticks_ = 0;
    std::uint64_t hash_ = 0;
    MovementSettings tape_settings_;  // of the last tick on the tape
    std::vector<TraceRecord> trace_;
};

}  // namespace slipface
