// Players at rest cost next to nothing.
#pragma once

#include <cstdint>
#include <memory>

#include "slipface/movement/step.h"

namespace slipface {

// What a game keeps for a player from one step to the next. A player at rest is an exact fixed point of
// step(): what comes out is what went in, bit for bit. So while what went in is the same, nothing that stands
// still changed and no platform comes near, what comes out is known. It holds no state: a new one, or that of
// another player, costs time but changes no bit.
//
// A game that writes into the heights of a terrain or into a table of surface types without
// apply_surface_rules() starts with a new Rest{}; changes of the collision world are noticed.
class Rest {
  public:
    // The result of the step, if it is known.
    const StepResult* find(const MovementScene& scene, const MovementSettings& settings,
                           const PlayerState& state, const PlayerInput& input, double dt) const;
    // Notes the result of such a step. `looked`: what of the scene it depends on.
    void note(const MovementScene& scene, const MovementSettings& settings, const PlayerState& state,
              const PlayerInput& input, double dt, const Aabb& looked, const StepResult& result);

  private:
    bool known_ = false;
    StepResult result_;
    PlayerInput input_;
    double dt_ = 0.0;
    std::shared_ptr<const MovementSettings> settings_;  // many players share them
    std::uint64_t world_ = 0;                           // revision() of the collision world
    SurfaceTable surfaces_;
    const Heightfield* heightfield_ = nullptr;
    Sectors sectors_;
    bool platforms_ = false;  // there are some
    Aabb looked_;
};

// step() with the same bits: at once for a player at rest, and it notes whether the player is. `rest` is the
// player's own; it has some 400 bytes. Allocates when a player comes to rest whose settings are not those of
// the last.
StepResult step(const MovementScene& scene, const MovementSettings& settings, const PlayerState& state,
                const PlayerInput& input, double dt, Rest& rest);

}  // namespace slipface
