// One fixed time step of a player: a pure function that explains itself.
#pragma once

#include "slipface/movement/settings.h"
#include "slipface/movement/surface_type.h"
#include "slipface/movement/trace.h"

namespace slipface {

// The world as movement sees it: what to collide with, and what the surfaces do.
struct MovementScene {
    const CollisionWorld& collision;
    SurfaceTable surfaces;
};

struct PlayerInput {
    Vec2 wish =
        Vec2::Zero();   // wanted horizontal direction (x, z), world space, length 0..1 of the walking speed
    bool jump = false;  // held
};

struct PlayerState {
    Vec3 position = Vec3::Zero();  // centre of the ellipsoid
    Vec3 velocity = Vec3::Zero();  // m/s
    bool grounded = false;
    bool climbing = false;   // on a climbable surface
    bool stuck = false;      // held by a sticky surface
    bool jump_held = false;  // last tick's input: a jump starts on the press
    bool hazard = false;     // touched a hazardous surface this step: the game respawns the player
    Vec3 ground_normal = Vec3::UnitY();  // of the surface stood on, climbed or stuck to; unit
    FaceId ground_face = no_id;
    SurfaceId ground_surface = default_surface;

    friend bool operator==(const PlayerState&, const PlayerState&) = default;
};

struct StepResult {
    PlayerState state;
    int sweeps = 0;  // collision queries made
    int contacts = 0;
};

// The state after `dt` seconds (1e-4..0.25 s). The same arguments give the same bits. `trace` may be null,
// and then costs nothing; no memory is allocated. Guarantee: a player who began outside all triangles ends
// outside all of them, and the centre passes through none. Non-finite input, or dt out of range, returns
// `state` unchanged.
StepResult step(const MovementScene& scene, const MovementSettings& settings, const PlayerState& state,
                const PlayerInput& input, double dt, TraceSink* trace = nullptr);

// Only collide and slide: the ellipsoid `settings.radii` moved from `from` by `move` with the response rules
// of `settings`, without gravity, input or state. What the editor's sweep probe shows.
struct SlideResult {
    Vec3 position;  // centre at the end
    Vec3 leftover;  // what of the displacement could not be used
    int contacts = 0;
};
SlideResult slide_move(const MovementScene& scene, const MovementSettings& settings, const Vec3& from,
                       const Vec3& move, TraceSink* trace = nullptr);

}  // namespace slipface
