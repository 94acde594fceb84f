// What the parts of one step share. A Mover lives for one call of step() or slide_move().
#pragma once

#include <array>
#include <span>

#include "slipface/collision/neighbourhood.h"
#include "slipface/movement/step.h"

namespace slipface {

// What a part of a step changes; kept and put back by hacks that try a move and compare.
struct Motion {
    Vec3 position = Vec3::Zero();  // centre of the ellipsoid now, in the scene's coordinates
    Vec3 velocity = Vec3::Zero();  // at the end of the step, as far as contacts have turned it

    // Found out on the way.
    bool grounded = false;
    bool climbing = false;
    bool stuck = false;
    bool hazard = false;
    bool bounced = false;
    bool kept_energy = false;
    bool trapped = false;
    std::array<Vec3, 2> walls;  // that turned a horizontal pass: horizontal unit normals, the first two
    int wall_count = 0;
    Vec3 support_normal = Vec3::UnitY();  // of the surface stood on, climbed, stuck to or slid along
    FaceId support_face = no_id;
    SurfaceId support_surface = default_surface;
    std::uint32_t support_platform = no_id;
    double support_rise = 0.0;  // of the point stood on above the ellipsoid's lowest point, m
};

// How far from where it begins, along each axis, a step that covers `way` metres asks what is there. What it
// asks beyond that takes longer.
Vec3 reach_of_step(const MovementSettings& settings, double length);

// The platforms around where a step begins.
struct NearPlatforms {
    static constexpr std::size_t capacity = 16;
    Aabb room;                                 // whose centre stays in it can touch no others
    std::array<std::uint32_t, capacity> list;  // ascending
    std::size_t count = 0;                     // above the capacity: not listed
};
NearPlatforms platforms_near(const MovementScene& scene, const Vec3& radii, const Vec3& from,
                             const Vec3& reach);

struct Mover : Motion {
    // `reach`: as reach_of_step says; decides only what is kept at hand.
    Mover(const MovementScene& in_scene, const MovementSettings& by_settings, TraceSink* sink, double seconds,
          const Vec3& from, const Vec3& reach)
        : scene(in_scene),
          settings(by_settings),
          trace(sink),
          dt(seconds),
          near(in_scene.collision, by_settings.radii, from, reach),
          near_platforms(platforms_near(in_scene, by_settings.radii, from, reach)) {
        position = from;
    }
    Motion& motion() { return *this; }

    const MovementScene& scene;
    const MovementSettings& settings;
    TraceSink* trace = nullptr;
    double dt = 1.0;
    Neighbourhood near;  // of what stands still, around where the step begins
    NearPlatforms near_platforms;
    double walkable_cosine = 1.0;  // of settings.max_slope
    Vec2 wish = Vec2::Zero();      // at most 1 long
    bool jump_held = false;        // the button, this step
    bool jumping = false;          // rising by a jump whose button is still held

    Vec3 velocity_before =
        Vec3::Zero();  // at the start of the step: what a bounce gives back lies between the two
    bool was_grounded = false;
    bool jumped = false;
    bool began_free = false;                 // touches nothing where it began, not even from behind
    bool on_ladder = false;                  // the move climbs: ladders are slid along instead of grabbed
    std::uint32_t ignored_platform = no_id;  // the one that carries the player now, or pushes

    int sweeps = 0;
    int contacts = 0;
    bool end_is_free = false;  // by the last check
};

// One contact, ready to be responded to.
struct Hit {
    Pass pass;
    const Contact& contact;
    const SurfaceType& surface;
    std::uint32_t platform;  // that the face belongs to, or no_id
    bool walkable;           // flat enough to stand on
    Vec3 remainder;          // of the displacement
    double done;             // fraction of the pass's displacement that lies before the contact, 0..1
};

// What a contact makes of the displacement and the velocity.
struct Deflection {
    Rule rule = Rule::slide;
    Vec3 remainder = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Vec3 plane = Vec3::Zero();  // unit normal that later turns of this pass must respect
    bool constrains_velocity = true;
};

inline Vec3 horizontal(const Vec3& v) {
    return {v.x(), 0.0, v.z()};
}

// v / |v|, or zero where there is no direction. No division by zero and no overflow for any finite v.
Vec3 direction_of(const Vec3& v);

// The lecture's slide, V - N (V.N). What already leads away from the plane stays as it is.
Vec3 slide_along(const Vec3& v, const Vec3& normal);

// cos(angle) for angle in [0, pi/2] from additions and multiplications alone, so that every C library gives
// the same bits.
double slope_cosine(double angle);

const SurfaceType& surface_of(const Mover& mover,
                              SurfaceId surface);  // `default` for unknown ids and when switched off
const SurfaceType& support_of(const Mover& mover,
                              const PlayerState& state);                // what the state stands on or holds
double walkable_limit(const Mover& mover, const SurfaceType& surface);  // least N.y that can be stood on
inline bool is_walkable(const Mover& mover, const Vec3& normal, const SurfaceType& surface) {
    return normal.y() >= walkable_limit(mover, surface);
}

// What a surface type does, as far as it is not switched off.
inline bool sticks(const Mover& mover, const SurfaceType& surface) {
    return surface.sticky && mover.settings.stick;
}
inline double restitution_of(const Mover& mover, const SurfaceType& surface) {
    return mover.settings.bounce ? surface.restitution : 0.0;
}

// What the sentence of a decision says in numbers, in the unit of decision_info().
struct Quantity {
    double value = 0.0;
    double limit = 0.0;
};
void decide(const Mover& mover, Decision kind, FaceId face = no_id);
void decide(const Mover& mover, Decision kind, const Quantity& quantity, FaceId face = no_id);

// Queries of the whole scene: what stands still, and every platform but the ignored one.
struct SceneContact {
    Contact contact;
    std::uint32_t platform = no_id;
    double depth = 0.0;  // metres behind the contact plane already, where the seam filter turned it
    bool back = false;   // the middle of a triangle was touched from behind; known only while tracing
};
std::optional<SceneContact> sweep_scene(Mover& mover, const Vec3& from, const Vec3& move);
// At most out.size() are kept; returns how many are in `out`.
std::size_t overlaps_in_scene(const Mover& mover, const Vec3& centre, std::span<Overlap> out);
bool overlaps_scene(const Mover& mover, const Vec3& centre);
bool is_free(const Mover& mover, const Vec3& centre);  // of one-sided faces, too
std::optional<RayHit> ray_in_scene(const Mover& mover, const Vec3& from, const Vec3& length);
const CollisionWorld& world_of(const Mover& mover, std::uint32_t platform);

// A sweep whose end keeps the skin.
struct Swept {
    Vec3 reached = Vec3::Zero();
    double used = 1.0;                              // fraction of the move that was made
    std::optional<Contact> contact = std::nullopt;  // t is a fraction of the move
    std::uint32_t platform = no_id;                 // that the contact's face belongs to
};
Swept sweep_with_skin(Mover& mover, Pass pass, int iteration, const Vec3& move);

// Collide and slide: moves the mover by `move`, at most settings.max_slides sweeps. Returns what could not be
// used.
Vec3 collide_and_slide(Mover& mover, Pass pass, const Vec3& move);

// Notes what a contact means for the state: ground, ladder, hazard.
void touch(Mover& mover, const Hit& hit);
// Turns displacement and velocity at a contact: the first response that applies.
Deflection respond(Mover& mover, const Hit& hit);

// Responses; each says nothing where it does not apply.
std::optional<Deflection> stick(Mover& mover, const Hit& hit);
std::optional<Deflection> grab_ladder(Mover& mover, const Hit& hit);
std::optional<Deflection> hold_by_static_friction(Mover& mover, const Hit& hit);
std::optional<Deflection> bounce(Mover& mover, const Hit& hit);
std::optional<Deflection> keep_energy(Mover& mover, const Hit& hit);
std::optional<Deflection> slide_at_wall(Mover& mover, const Hit& hit);
std::optional<Deflection> go_straight_ahead(Mover& mover, const Hit& hit);

// Holds the earlier planes of a pass against the latest turn.
struct Corner {
    static constexpr int capacity = 8;
    std::array<Vec3, capacity> planes;
    std::array<bool, capacity> constrains_velocity;
    int count = 0;
};
void respect_corner(const Corner& corner, const Vec3& remainder, const Vec3& velocity,
                    Deflection& deflection);

// Parts of a step, in the order in which it asks for them.
void push_out(Mover& mover);
bool nudge(Mover& mover);  // true if the player is free afterwards
void move_with_platforms(Mover& mover, const PlayerState& state);
Vec3 velocity_of(const MovingPart& part, const Vec3& point);  // m/s, of the platform at that point
void carry(Mover& mover, const SurfaceType& support, FaceId support_face);
void hold(Mover& mover, const PlayerState& state);
void climb(Mover& mover, const PlayerState& state);
void walk(Mover& mover, const PlayerState& state, bool wants_to_jump);
bool clamp_to_terrain(Mover& mover, const Vec3& from);  // false if there is no room above the terrain
bool ends_inside(Mover& mover, const Vec3& from);

// Parts of a walk.
void accelerate(Mover& mover, bool slippery);
double steering_in_air(const Mover& mover);  // m/s2; the stick is not let go
void coast(Mover& mover, const Vec3& from, const Vec3& driven_velocity);
// How far `along`, a displacement or a velocity, leads down on ground of that normal; 0 going up.
double descent(const Vec3& ground_normal, const Vec3& along);
double press_down(const Mover& mover, const Vec3& ground_normal, const Vec3& move);  // metres this step, >= 0
void set_ground_velocity(Mover& mover);
// What the plain move made of `level` is in the mover; `before` is where it began. True if a step was climbed
// instead, which includes the way down onto it.
bool step_up(Mover& mover, const Motion& before, const Vec3& level);
// The lecture's form: the whole move, lifted before and dropped after. False if it leads to no ground.
bool step_every_move(Mover& mover, const Motion& before, const Vec3& level);
void snap_down(Mover& mover, const Motion& before);

// Steps: which steep contacts can be stood on, and what is no higher than a step (footing.cpp).
// The contact is on the front of a step, and walkable ground leads there from below the centre.
bool on_rim(Mover& mover, const Contact& contact);
// The contact is at most `highest` metres above the point stood on when the player was at `begin`, or steps
// no higher than that lead up to it.
bool no_higher_than_steps(const Mover& mover, const Motion& begin, const Contact& contact, double highest);
// The same downwards: from the ground below `begin` to the contact no step is deeper.
bool no_deeper_than_steps(const Mover& mover, const Vec3& begin, const Contact& contact, double deepest);
// Notes what the player stands on.
void stand_on(Mover& mover, const Contact& contact, std::uint32_t platform);
void cap_energy(Mover& mover, const Vec3& from, const Vec3& driven_velocity);
Vec3 carry_velocity(const Mover& mover, const PlayerState& state);  // m/s at the mover's position

// Jumping. Windows are counted down in the state, so they are exact to the tick at every rate: one of w
// seconds holds for the w / dt steps after it opened. Repeated subtraction may leave a little of one that has
// run out.
inline bool is_open(double window_s, double dt) {
    return window_s > 1e-6 * dt;
}
bool wants_jump(const Mover& mover, const PlayerState& state, bool pressed);  // pressed now, or remembered
bool may_jump(const Mover& mover, const PlayerState& state);  // held by something, or just left it
void cut_jump(Mover& mover);
// What the timers are after the step.
double coyote_after(const Mover& mover, const PlayerState& state);
double jump_buffer_after(const Mover& mover, const PlayerState& state, bool pressed);

// Replaces the normal of a touch of an edge that is inside a flat or hollow surface by the face's. Returns
// how deep the ellipsoid at `centre` is behind that face's plane, metres; 0 where nothing was replaced.
double filter_seam(const Mover& mover, const Vec3& centre, std::uint32_t platform, Contact& contact);

}  // namespace slipface
