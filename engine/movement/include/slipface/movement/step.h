// One fixed time step of a player: a pure function that explains itself.
#pragma once

#include <optional>
#include <type_traits>

#include "slipface/movement/buttons.h"
#include "slipface/movement/scene.h"
#include "slipface/movement/settings.h"
#include "slipface/movement/trace.h"

namespace slipface {

struct StepContacts;

struct PlayerInput {
    // Wanted horizontal velocity (x, z) in world space, as a fraction of the walking speed; longer than 1
    // counts as 1.
    Vec2 wish = Vec2::Zero();
    ButtonSet buttons{};  // that are held
};

// What carries a player: what its velocity is relative to.
enum class Carrier : std::uint8_t {
    unknown,    // of a new state: whatever its first step finds, so that velocity 0 is at rest on a ferry
    level,      // nothing that moves: still ground, or the player is in the air
    platform,   // PlayerState::ground_platform, and what its surface moves by
    surface,    // a belt or turntable: PlayerState::ground_surface
    character,  // another player of a crowd
};

struct PlayerState {
    Vec3 position = Vec3::Zero();  // centre of the ellipsoid, relative to the origin of `sector`
    Vec3 velocity = Vec3::Zero();  // m/s, relative to the carrier; see velocity_in_level()
    std::array<std::int32_t, 3> sector{0, 0, 0};  // all 0 in a scene without sectors
    bool grounded = false;
    bool climbing = false;   // on a climbable surface
    bool stuck = false;      // held by a sticky surface
    bool jump_held = false;  // the button, last step: a jump starts when it is pressed
    bool hazard = false;     // touched a hazardous surface this step: the game respawns the player
    bool jumping = false;    // rising by a jump whose button is still held
    bool trapped = false;    // inside geometry and could not be moved out
    bool crushed = false;    // by a platform that left it no room, this step: the game respawns the player
    bool dash_held = false;  // the button, last step, while the settings have a dash
    bool hanging = false;    // by the hands from a ledge, or climbing onto it
    bool crouched = false;   // has the crouched body: body_radii()
    bool wants_to_stand = false;         // crouched without the button: there is no room
    Vec3 ground_normal = Vec3::UnitY();  // of the surface stood on, climbed or stuck to; unit
    FaceId ground_face = no_id;
    SurfaceId ground_surface = default_surface;
    bool dropping = false;                  // through one-sided faces, until the body is past them
    std::uint8_t air_jumps = 0;             // made since something gave them back
    std::uint8_t dashes = 0;                // begun in the air since something gave them back
    std::uint32_t ground_platform = no_id;  // index into MovementScene::platforms; no_id: it does not move
    Carrier carrier = Carrier::unknown;
    // Height of the point stood on, or of the ledge that the hands hold, above the ellipsoid's lowest point,
    // m, 0 or more: the next step's height is measured from that point.
    double ground_rise = 0.0;
    // In the air the velocity of the ground that was left, m/s, as far as MovementSettings::leave_mode keeps
    // it: the stick steers relative to it. 0 while something holds the player.
    Vec3 air_frame = Vec3::Zero();
    double coyote_s = 0.0;       // for how much longer a jump starts although the player left the ground
    double jump_buffer_s = 0.0;  // for how much longer a press of jump is remembered
    // The horizontal direction, unit, out of the wall last jumped off since something held the player; 0:
    // none.
    double wall_x = 0.0, wall_z = 0.0;
    double wall_lock_s = 0.0;  // for how much longer the stick does not steer after a wall jump
    double move_s = 0.0;       // for how much longer a dash lasts, or the climb onto a ledge

    // Every member but the sector, the ids and the carrier: hashes, files and checks of a state go through
    // these lists. What a hack adds comes last.
    static constexpr std::array numbers{&PlayerState::ground_rise,   &PlayerState::coyote_s,
                                        &PlayerState::jump_buffer_s, &PlayerState::wall_x,
                                        &PlayerState::wall_z,        &PlayerState::wall_lock_s,
                                        &PlayerState::move_s};
    static constexpr std::array counts{&PlayerState::air_jumps, &PlayerState::dashes};
    static constexpr std::array flags{
        &PlayerState::grounded,  &PlayerState::climbing, &PlayerState::stuck,    &PlayerState::jump_held,
        &PlayerState::hazard,    &PlayerState::jumping,  &PlayerState::trapped,  &PlayerState::crushed,
        &PlayerState::dash_held, &PlayerState::hanging,  &PlayerState::crouched, &PlayerState::wants_to_stand,
        &PlayerState::dropping};
    static constexpr std::array vectors{&PlayerState::position, &PlayerState::velocity,
                                        &PlayerState::ground_normal, &PlayerState::air_frame};

    friend bool operator==(const PlayerState&, const PlayerState&) = default;
};
// Searches and rollbacks store many of them. It owns nothing, so that it can be copied as bytes.
static_assert(sizeof(PlayerState) <= 200 && std::is_trivially_destructible_v<PlayerState>);

// By ground, a ladder, a sticky surface or the hands; else the player is in the air.
inline bool is_held(const PlayerState& state) {
    return state.grounded || state.climbing || state.stuck || state.hanging;
}
// Half-axes of the body that the player has, m: MovementSettings::radii, or lower while it is crouched.
Vec3 body_radii(const MovementSettings& settings, const PlayerState& state);
// The settings with that body and its walking speed: for what asks about a player as it is now.
MovementSettings settings_of_body(const MovementSettings& settings, const PlayerState& state);

// The player's centre in the scene's coordinates, for drawing.
Vec3 position_in_scene(const MovementScene& scene, const PlayerState& state);
// The opposite: sets the state's sector and its position in that sector.
void put_in_scene(const MovementScene& scene, const Vec3& position, PlayerState& state);

// Velocity of the player's own motion, m/s: for a speed display or for animation. In the air, on ladders and
// on sticky surfaces it is `velocity`. On the ground `velocity` also presses the player down; then this is
// the horizontal part with the rise or fall of the ground, and zero for a player that stands still.
Vec3 motion_velocity(const PlayerState& state);

// The same in the level, with the velocity of the platform, belt or turntable that carries the player. That
// of another player (Carrier::character) is not known here. `scene` is that of the step that made the state.
Vec3 velocity_in_level(const MovementScene& scene, const MovementSettings& settings,
                       const PlayerState& state);

struct StepResult {
    PlayerState state;
    int sweeps = 0;  // collision queries made
    int contacts = 0;
    // True: the end was checked, and the ellipsoid overlaps no two-sided face there. False: unknown.
    bool end_is_free = false;
    // True: there were too many triangles around to collect them once, so that each query looked for its own.
    bool crowded = false;
};

// The state after `dt` seconds, 1e-4 or more. A dt above 0.25 s, when the game itself was held up, is moved
// in equal parts of at most that, under the same input; above 60 s it counts as 60 s. The same arguments give
// the same bits. `trace` and `contacts` (step_contacts.h) may be null and then cost nothing. No memory is
// allocated. Guarantee: a player that
// began outside all two-sided triangles ends outside all of them, and the centre passes through none. Numbers
// that are not finite, radii or a skin that are not positive, and a smaller dt return `state` unchanged.
StepResult step(const MovementScene& scene, const MovementSettings& settings, const PlayerState& state,
                const PlayerInput& input, double dt, TraceSink* trace = nullptr,
                StepContacts* contacts = nullptr);

// Only collide and slide: moves the ellipsoid `settings.radii` from `from` by `move`, m, with the response
// rules of `settings`, without gravity, input or state. The editor's sweep probe shows it.
struct SlideResult {
    Vec3 position;   // centre at the end
    Vec3 remainder;  // the part of the displacement that was not used, m
    int contacts = 0;
};
SlideResult slide_move(const MovementScene& scene, const MovementSettings& settings, const Vec3& from,
                       const Vec3& move, TraceSink* trace = nullptr);

// A new state for a player that a game puts somewhere, a teleport or a respawn: at state.position, or at the
// nearest place at most `farthest` metres away where the body is outside of all geometry, a solid that it
// does not touch included (26 directions, up to 200 distances). Nothing if there is no such place, or if a
// number is not finite. Of `state` only the position and the held button count. Up to some thousand queries;
// allocates nothing.
std::optional<PlayerState> put_player(const MovementScene& scene, const MovementSettings& settings,
                                      const PlayerState& state, double farthest);

// The player with the body `radii` (m, each above 0) in place of `settings.radii`: to crouch, to stand up, to
// stretch for a run. The feet stay where they are, on a slope too. Nothing if there is no room for it, or if
// a number is not finite: the player then keeps its body, and a game asks again at the next tick. Later steps
// are given settings with the new radii. Guarantee: as that of step(). Several sweeps long; allocates
// nothing.
std::optional<PlayerState> change_body(const MovementScene& scene, const MovementSettings& settings,
                                       const PlayerState& state, const Vec3& radii);

}  // namespace slipface
