// One fixed time step of a player: a pure function that explains itself.
#pragma once

#include "slipface/movement/scene.h"
#include "slipface/movement/settings.h"
#include "slipface/movement/trace.h"

namespace slipface {

struct PlayerInput {
    Vec2 wish =
        Vec2::Zero();   // wanted horizontal direction (x, z), world space, length 0..1 of the walking speed
    bool jump = false;  // held
};

struct PlayerState {
    Vec3 position = Vec3::Zero();  // centre of the ellipsoid, relative to the origin of `sector`
    Vec3 velocity = Vec3::Zero();  // m/s
    std::array<std::int32_t, 3> sector{0, 0, 0};  // all 0 in a scene without sectors
    bool grounded = false;
    bool climbing = false;   // on a climbable surface
    bool stuck = false;      // held by a sticky surface
    bool jump_held = false;  // last tick's input: a jump starts on the press
    bool hazard = false;     // touched a hazardous surface this step: the game respawns the player
    bool jumping = false;    // rising by a jump whose button is still held
    bool trapped = false;    // inside geometry, and no way out was found; or crushed by a platform
    Vec3 ground_normal = Vec3::UnitY();  // of the surface stood on, climbed or stuck to; unit
    FaceId ground_face = no_id;
    SurfaceId ground_surface = default_surface;
    std::uint32_t ground_platform = no_id;  // index into MovementScene::platforms; no_id: it does not move
    double ground_rise = 0.0;  // of the point stood on above the ellipsoid's lowest point, m, 0 or more: what
                               // the next step is measured from
    double coyote_s = 0.0;     // for how much longer a jump starts although the ground was left
    double jump_buffer_s = 0.0;  // for how much longer a press of jump is remembered

    friend bool operator==(const PlayerState&, const PlayerState&) = default;
};

// The state's centre in the coordinates in which the scene is given: what is drawn.
Vec3 position_in_scene(const MovementScene& scene, const PlayerState& state);
// The same position as a state holds it: sector and what is left.
void put_in_scene(const MovementScene& scene, const Vec3& position, PlayerState& state);

// Velocity of the player's own motion, m/s: what a game shows as speed or feeds to animation. In the air, on
// ladders and on sticky surfaces it is `velocity`. On the ground `velocity` also presses the player down;
// this is its horizontal part with the rise or fall of the ground stood on, and zero for a player who stands
// still.
Vec3 motion_velocity(const PlayerState& state);

struct StepResult {
    PlayerState state;
    int sweeps = 0;  // collision queries made
    int contacts = 0;
    // The step ended somewhere else than its platforms left the player, and its last check found nothing
    // two-sided there that the ellipsoid overlaps. False says nothing.
    bool end_is_free = false;
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
    Vec3 position;   // centre at the end
    Vec3 remainder;  // what of the displacement could not be used
    int contacts = 0;
};
SlideResult slide_move(const MovementScene& scene, const MovementSettings& settings, const Vec3& from,
                       const Vec3& move, TraceSink* trace = nullptr);

}  // namespace slipface
