// What the phases of one step work on. A Mover lives for one part of step() or for one slide_move().
#pragma once

#include <array>
#include <span>
#include <variant>

#include "slipface/collision/neighbourhood.h"
#include "slipface/collision/posed.h"
#include "slipface/movement/step.h"
#include "slipface/movement/step_contacts.h"

namespace slipface {

// The surface that the player stands on, climbs, is stuck to or slides along.
struct Support {
    Vec3 normal = Vec3::UnitY();
    FaceId face = no_id;
    SurfaceId surface = default_surface;
    std::uint32_t platform = no_id;  // that the face belongs to, or no_id
};

// cos(angle) for angle in [0, pi/2] from additions and multiplications alone, so that every C library gives
// the same bits.
double slope_cosine(double angle);

// Given: what the caller passed. Nothing in it changes.
struct Given {
    const MovementScene& scene;
    const MovementSettings& settings;
    const PlayerState& state;  // of the player before, its position in the scene's coordinates
    TraceSink* trace = nullptr;
    double dt = 0.0;            // s, of the part of the step; 0: nobody moves, somebody asks
    Vec2 wish = Vec2::Zero();   // at most 1 long
    bool jump_held = false;     // the button, this step
    bool jump_pressed = false;  // the button was not held in the step before
    double walkable_cosine = slope_cosine(settings.max_slope);
    // The part of the step that this is: fractions of the step, which is `step_s` long.
    double since = 0.0, until = 1.0;
    double step_s = 0.0;
    ButtonSet buttons{};
    bool dash_pressed = false;
    StepContacts* report = nullptr;  // what touches, where a game asks for it
};

// Carried: what the phases change one after the other, and what becomes the new state. Hacks that try a move
// copy it and put it back.
struct Motion {
    Vec3 position = Vec3::Zero();  // centre of the ellipsoid, in the scene's coordinates
    Vec3 velocity = Vec3::Zero();  // m/s, at the end of the step, as far as contacts have changed it
    bool grounded = false;
    bool climbing = false;
    bool stuck = false;
    bool hanging = false;
    bool hazard = false;
    bool bounced = false;
    bool kept_energy = false;
    bool trapped = false;
    bool crushed = false;
    bool jumping = false;       // rising by a jump whose button is still held
    std::array<Vec3, 2> walls;  // horizontal unit normals of the first two walls that a horizontal pass hit
    int wall_count = 0;
    Support support;
    Vec3 air_frame =
        Vec3::Zero();  // of the ground that was left, in the frame of the step; then of the new state
    // Of the point stood on, or of the ledge held, above the ellipsoid's lowest point, m.
    double support_rise = 0.0;
    std::size_t noted = 0;  // contacts in `report`: a move that is taken back takes its own back
};

// Platforms that a step can touch.
struct NearPlatforms {
    static constexpr std::size_t capacity = 16;
    Aabb room;  // while the centre stays inside, no unlisted platform can be hit
    std::array<std::uint32_t, capacity> list;  // ascending
    std::size_t count = 0;                     // above the capacity: not listed
};
// How far from its centre a body, whose sweeps reach that far, can touch something.
Vec3 slack_around(const Vec3& radii, const Vec3& from, const Vec3& reach);
NearPlatforms platforms_near(const MovementScene& scene, const Vec3& radii, const Vec3& from,
                             const Vec3& reach);

// Half-extents of the region that is cached for a step of that length, m. Queries beyond it are slower.
Vec3 reach_of_step(const MovementSettings& settings, double length);

// Sweeps of one pass of collide and slide, at most, whatever the settings say.
inline constexpr int slide_capacity = 8;

// What can be touched around a position. It refers to the scene.
struct Surroundings {
    std::optional<QueryFilter> filter;  // the scene's
    Neighbourhood near;                 // of what stands still
    NearPlatforms platforms;

    // For a player who moves by at most `length` from `at`, m.
    Surroundings(const MovementScene& scene, const MovementSettings& settings, const Vec3& at, double length)
        : filter(scene.filter == nullptr ? std::nullopt : std::optional(filter_of(scene, no_id))),
          near(scene.collision, settings.radii, at, reach_of_step(settings, length),
               filter ? &*filter : nullptr),
          platforms(platforms_near(scene, settings.radii, at, reach_of_step(settings, length))) {}
    Surroundings(const Surroundings&) = delete;
    Surroundings& operator=(const Surroundings&) = delete;
    // True if they are enough for a player who moves by `length` from `at`, too.
    bool cover(const MovementSettings& settings, const Vec3& at, double length) const {
        const Vec3 reach = reach_of_step(settings, length);
        return ((at - reach).array() >= platforms.room.min.array()).all() &&
               ((at + reach).array() <= platforms.room.max.array()).all();
    }
};

// Scratch: what the phases leave for one another. It is gone when the part ends.
struct Scratch {
    const Surroundings& around;
    const SurfaceType& stood_on;          // before
    Vec3 velocity_before = Vec3::Zero();  // at the start of the part: what a bounce gives back lies between
    // Of a player that walks: the horizontal velocity that the stick asks for, by how much the ground can
    // change that of the player during the part, and by what it did; m/s.
    struct {
        Vec3 velocity = Vec3::Zero();
        double change = 0.0;
        Vec3 changed = Vec3::Zero();
    } asked = {};
    // Of the step, in the level, m/s; 0 for a player that is carried: its velocity is relative to its
    // carrier.
    Vec3 frame = Vec3::Zero();
    bool was_grounded = false;  // before, and does not jump now
    bool jumped = false;
    bool air_jumped = false;
    bool on_wall = false;            // slides down one or jumps off one
    Vec3 jumped_off = Vec3::Zero();  // the horizontal direction out of the wall that a jump starts from
    double move_s = 0.0;             // left of a dash or a climb onto a ledge after the part
    double dashed = 0.0;             // fraction of the part for which it moves the player; 0: no dash
    bool dash_began = false;
    bool dropping = false;    // one-sided faces are not seen
    bool began_free = false;  // touched nothing where it began, not even from behind
    bool pressed = false;     // a platform that moves overlaps the player, who could not give way
    FaceId presser = no_id;   // of the platform that does so
    bool swallowed = false;   // one has run past it
    bool on_ladder = false;   // the move climbs: ladders are slid along instead of grabbed
    std::uint32_t ignored_platform = no_id;  // the one that carries or pushes the player now
    int sweeps = 0;
    int contacts = 0;
    bool ends_free = false;    // as began_free; false: unknown
    bool end_is_free = false;  // by the last check: but for one-sided faces
    Aabb* looked = nullptr;    // grows by all places where a platform is looked for; may be null
};

// What a pass of collide and slide met.
struct Met {
    Vec3 point;              // touched, world space
    Vec3 normal;             // of the contact
    TriangleId triangle;     // touched, in its world
    std::uint32_t platform;  // that the triangle belongs to, or no_id
    bool walkable;           // flat enough to stand on
};
struct LatestPass {
    std::array<Met, 2 * slide_capacity> met;  // in order
    int met_count = 0;

    void meet(const Met& what) {
        if (met_count < static_cast<int>(met.size())) met[static_cast<std::size_t>(met_count++)] = what;
    }
};

const SurfaceType& type_stood_on(const Given& given);  // before

struct Mover : Given, Motion, Scratch, LatestPass {
    Mover(const Given& given, const Surroundings& surroundings)
        : Given(given), Scratch{.around = surroundings, .stood_on = type_stood_on(given)} {
        position = given.state.position;
        jumping = given.state.jumping;
        trapped = given.state.trapped;
        support_rise = given.state.grounded || given.state.hanging ? given.state.ground_rise : 0.0;
        if (report != nullptr) noted = report->count;
    }
    Motion& motion() { return *this; }
};

// One contact, ready to be responded to.
struct Hit {
    Pass pass;
    const Contact& contact;
    const SurfaceType& surface;
    std::uint32_t platform;  // that the face belongs to, or no_id
    bool walkable;           // flat enough to stand on
    Vec3 remainder;          // of the displacement, m
    double done;             // fraction of the pass's displacement that lies before the contact, 0..1
};

// What a contact makes of the displacement and the velocity.
struct Deflection {
    Rule rule = Rule::slide;
    Vec3 remainder = Vec3::Zero();  // m
    Vec3 velocity = Vec3::Zero();   // m/s
    Vec3 plane = Vec3::Zero();      // unit normal that later deflections of this pass must respect
    bool constrains_velocity = true;
    bool slides = false;  // both are what led there, projected on the plane
};

inline Vec3 horizontal(const Vec3& v) {
    return {v.x(), 0.0, v.z()};
}

// v / |v|, or zero where there is no direction. No division by zero and no overflow for any finite v.
Vec3 direction_of(const Vec3& v);

// The lecture's slide, V - N (V.N). What already leads away from the plane stays as it is.
Vec3 slide_along(const Vec3& v, const Vec3& normal);

// Surfaces. `default` for unknown ids and when surface types are switched off.
const SurfaceType& surface_of(const Given& given, SurfaceId surface);
inline const SurfaceType& support_of(const Mover& mover) {  // what the player stood on before
    return mover.stood_on;
}
Support support_before(const Mover& mover);                             // the same as faces and normals
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
// How well a surface holds, 0..max_friction whatever its type says.
double friction_of(const SurfaceType& surface);

// What the sentence of a decision says in numbers, in the unit of decision_info().
struct Quantity {
    double value = 0.0;
    double limit = 0.0;
};
void decide(const Mover& mover, Decision kind, FaceId face = no_id);
void decide(const Mover& mover, Decision kind, const Quantity& quantity, FaceId face = no_id);
// Why a hack that was tried does not apply.
struct Refusal {
    Decision why;
    Quantity quantity = {};
};

// Queries of the whole scene: what stands still, and every platform but the ignored one.
struct SceneContact {
    Contact contact;
    TriangleId triangle = no_id;  // touched, in its world
    std::uint32_t platform = no_id;
    double depth = 0.0;  // metres behind the contact plane already, where the seam filter replaced it
    bool back = false;   // the middle of a triangle was touched from behind; known only while tracing
};
std::optional<SceneContact> sweep_scene(Mover& mover, const Vec3& from, const Vec3& move);
// At most out.size() overlaps are stored; returns how many are in `out`.
std::size_t overlaps_in_scene(const Mover& mover, const Vec3& centre, std::span<Overlap> out);
// The same with the triangle's number in its world, and the platform that it belongs to or no_id.
struct SceneOverlap : Overlap {
    std::uint32_t platform = no_id;
};
std::size_t touched_in_scene(const Mover& mover, const Vec3& radii, const Vec3& centre,
                             std::span<SceneOverlap> out);
bool overlaps_scene(const Mover& mover, const Vec3& centre);
bool is_free(const Mover& mover, const Vec3& centre);  // of one-sided faces, too
struct SceneRay : RayHit {
    SurfaceId surface = default_surface;
    std::uint32_t platform = no_id;
};
std::optional<SceneRay> ray_in_scene(const Mover& mover, const Vec3& from, const Vec3& move);
// A world of the scene as its filter lets the player see it.
struct SeenWorld : PosedWorld {
    QueryFilter filter;
};
inline std::optional<Contact> sweep_ellipsoid(const SeenWorld& world, const Vec3& radii, const Vec3& from,
                                              const Vec3& move) {
    return sweep_ellipsoid(world, radii, from, move, world.filter);
}
inline std::optional<RayHit> cast_ray(const SeenWorld& world, const Vec3& origin, const Vec3& direction,
                                      double max_t, RayStops stops = RayStops::solid) {
    return cast_ray(world, origin, direction, max_t, stops, world.filter);
}
inline std::size_t find_overlaps(const SeenWorld& world, const Vec3& radii, const Vec3& centre,
                                 std::span<Overlap> out) {
    return find_overlaps(world, radii, centre, out, world.filter);
}
inline bool overlaps_any(const SeenWorld& world, const Vec3& radii, const Vec3& centre) {
    return overlaps_any(world, radii, centre, world.filter);
}
SeenWorld seen_at(const Given& given, std::uint32_t platform, const Pose& pose);
// The world that a triangle belongs to, where the part of the step ends.
SeenWorld world_of(const Given& given, std::uint32_t platform);
inline Pose pose_before(const Given& given, const MovingPart& part) {
    return pose_at(part, given.since, given.step_s);
}
inline Pose pose_after(const Given& given, const MovingPart& part) {
    return pose_at(part, given.until, given.step_s);
}
// Calls visit(platform) for every platform that a player can touch between `from` and `from` + `move`.
template <class Visit>
void each_platform(const Mover& mover, const Vec3& from, const Vec3& move, Visit&& visit) {
    const MovementScene& scene = mover.scene;
    if (scene.platforms.empty()) return;
    if (mover.looked != nullptr) {
        mover.looked->add(from);
        mover.looked->add(from + move);
    }
    const NearPlatforms& near = mover.around.platforms;
    const auto holds = [&](const Vec3& point) {
        return (point.array() >= near.room.min.array()).all() &&
               (point.array() <= near.room.max.array()).all();
    };
    if (near.count <= NearPlatforms::capacity && holds(from) && holds(from + move)) {
        for (std::size_t k = 0; k < near.count; ++k)
            visit(near.list[k]);
    } else if (scene.tree != nullptr) {
        const Vec3 to = from + move, slack = slack_around(mover.settings.radii, from, to - from);
        scene.tree->visit({from.cwiseMin(to) - slack, from.cwiseMax(to) + slack}, visit);
    } else {
        for (std::uint32_t i = 0; i < scene.platforms.size(); ++i)
            visit(i);
    }
}
// Replaces the normal of a touch of an edge that is inside a flat or concave surface by the face's. Returns
// how deep the ellipsoid at `centre` is behind that face's plane, metres; 0 where nothing was replaced.
double filter_seam(const Mover& mover, const Vec3& centre, std::uint32_t platform, Contact& contact);

// How much longer than the move a sweep is, in skins, so that a move does not end inside the skin of the next
// surface. Covers vertical moves onto slopes up to 75 degrees.
inline constexpr double look_ahead = 4.0;
// A sweep whose end keeps the skin.
struct Swept {
    Vec3 reached = Vec3::Zero();
    double used = 1.0;                              // fraction of the move that was made
    std::optional<Contact> contact = std::nullopt;  // t is a fraction of the move
    TriangleId triangle = no_id;                    // touched, in its world
    std::uint32_t platform = no_id;                 // that the contact's face belongs to
};
Swept sweep_with_skin(Mover& mover, Pass pass, int iteration, const Vec3& move);

// Collide and slide: moves the mover by `move`, at most settings.max_slides sweeps. Returns what could not be
// used.
Vec3 collide_and_slide(Mover& mover, Pass pass, const Vec3& move);
// Moves a player that flies by `move`, but for the `last` part of it, as far as the first contact on its way
// and lets that respond, if it is ground or throws the player back: what a landing is must not depend on the
// order of a split move. Nothing if what blocks the way is for the split move.
struct TouchDown {
    bool flies = false;             // all the way; else it lands
    double left = 0.0;              // fraction of the move
    Vec3 remainder = Vec3::Zero();  // of the displacement, after the response, m
    bool stands = false;            // it walks on; else it is thrown back or glides
};
std::optional<TouchDown> touch_down(Mover& mover, const Vec3& move, const Vec3& last);
// Contacts for the caller of step(): the contact is noted, with the speed of the body before it responds.
void begin_contacts(StepContacts* contacts);
void note_contact(Mover& mover, Pass pass, const Contact& contact, std::uint32_t platform);
void keep_contacts(const Mover& mover);
// Notes what a contact means for the state: ground, ladder, hazard.
void touch(Mover& mover, const Hit& hit);
// Deflects displacement and velocity at a contact: by the first response that applies.
Deflection respond(Mover& mover, const Hit& hit);

// Responses, one file each; nothing where one does not apply. The list of them is in response.cpp.
std::optional<Deflection> stick(Mover& mover, const Hit& hit);
std::optional<Deflection> grab_ladder(Mover& mover, const Hit& hit);
std::optional<Deflection> hold_by_static_friction(Mover& mover, const Hit& hit);
std::optional<Deflection> bounce(Mover& mover, const Hit& hit);
std::optional<Deflection> keep_energy(Mover& mover, const Hit& hit);
std::optional<Deflection> slide_at_steep_wall(Mover& mover, const Hit& hit);
std::optional<Deflection> go_straight_ahead(Mover& mover, const Hit& hit);

// What a pass has met, and what led there: displacements of the whole pass, m, and velocities, m/s.
struct Corner {
    Pass pass;
    Vec3 wish, wished_velocity;  // of the pass, or what a response that does not slide turned it to
    Vec3 led, led_velocity;      // to the first of the contacts at this place
    static constexpr int capacity = 2 * slide_capacity;
    std::array<Vec3, capacity> planes;
    std::array<bool, capacity> constrains_velocity;
    int count = 0;

    Corner(Pass its_pass, const Vec3& move, const Vec3& velocity)
        : pass(its_pass), wish(move), wished_velocity(velocity), led(move), led_velocity(velocity) {}
    void add(const Vec3& plane, bool of_velocity) {
        if (count == capacity) return;
        planes[static_cast<std::size_t>(count)] = plane;
        constrains_velocity[static_cast<std::size_t>(count++)] = of_velocity;
    }
};
// Adds the plane of the latest deflection and holds it against those met before. `left`: the fraction of the
// pass that lies behind the contact.
void respect_corner(Corner& corner, double left, Deflection& deflection);
// Adds the planes of the other faces that the body touches where it slides along one against its wish: a
// sweep names only the first of the walls of a corner, and in one this must not be.
void meet_others(Mover& mover, const Hit& hit, Corner& corner);
// What a wall is to a horizontal move: its horizontal part, or the plane itself if it hangs over. Zero for
// what is straight overhead or underfoot.
Vec3 plane_of_wall(const Vec3& normal);
void note_wall(Mover& mover, const Vec3& plane);
// The vector nearest to a velocity that leads into no plane that the pass has met.
Vec3 nearest_in_corner(const Corner& corner, const Vec3& velocity);

// The phases of a step, in order.
//
// 1. Platforms carry players that stand on them and push players out of their path. `state` is the player
// before, as Given has it; its directions turn with the platform, and its velocity becomes relative to the
// frame of the step.
void move_with_platforms(Mover& mover, PlayerState& state);
// 2. A player inside geometry is put outside, if the settings allow.
void leave_geometry(Mover& mover);
void push_out(Mover& mover);
bool nudge(Mover& mover);  // true if the player is free afterwards
// The centre is inside a solid: rays in all of 26 directions meet something, and most first the back of a
// face.
bool in_solid(const Mover& mover, const Vec3& centre);
// The nearest place for the mover's body at `rings` distances up to `farthest` that is free of geometry,
// inside no solid, and to which the centre gets through no face unless it is in a solid.
std::optional<Vec3> nearest_room(const Mover& mover, double farthest, int rings);
// 3. Conveyors and turntables carry players that stand on them.
void move_with_surface(Mover& mover, PlayerState& state);
// 4. What moves the player: nothing, a ladder, or its own velocity.
struct Drive {
    enum class Kind { held, climb, hang, walk } kind = Kind::held;
    Vec3 move = Vec3::Zero();    // displacement, m
    Vec3 driven = Vec3::Zero();  // velocity without this step's gravity, m/s
    double friction = 1.0;       // of the ground stood on
    bool split = false;          // the horizontal and the vertical part are moved by themselves
    bool glides = false;         // was in touch with a surface and does not jump off it
};
Drive choose_drive(Mover& mover);
void hold(Mover& mover);
// 5. The move; at its end the velocity becomes relative to what then carries the player.
void move_player(Mover& mover, const Drive& drive);
void climb(Mover& mover);
void change_frame(Mover& mover);
Vec3 velocity_of(const MovingPart& part, const Vec3& point);  // m/s, of the platform at that point
// m/s, of ground of that type and platform at the point `at`.
Vec3 ground_velocity(const Given& given, const Vec3& at, const SurfaceType& surface, std::uint32_t platform);
// m/s, of the frame that the step moves the player in, in the level at the player's position.
Vec3 frame_velocity(const Mover& mover);
// What a player that leaves ground of that velocity keeps of it, m/s.
Vec3 kept_on_leave(LeaveMode mode, const Vec3& ground);
Carrier carrier_of(const Mover& mover, const Support& on);
// 6. The feet are lifted to the terrain. False if there is no room above it.
bool clamp_to_terrain(Mover& mover, const Vec3& from);
// 7. A position inside geometry is not accepted: the player stays at `safe` and stops.
PlayerState accept(Mover& mover, const Vec3& safe, bool room_above_terrain);

// Parts of a walk.
// Returns how much more the ground could have changed the velocity, m/s; 0 where all of it was used, and in
// the air.
double accelerate(Mover& mover, double friction, bool slippery);
double steering_in_air(const Mover& mover);  // m/s2; the stick is not let go
// The velocity, m/s, that the stick asks for in the air and on ice, of a player that has the velocity `has`;
// both horizontal and relative to the ground that was left.
Vec3 speed_asked_for(const Mover& mover, const Vec3& stick, const Vec3& has);
// Gravity along the ground stood on, as far as its friction does not hold: `spare` is what accelerate() left.
void pull_down_slope(Mover& mover, double friction, double spare);
void coast(Mover& mover, const Vec3& from, const Drive& drive);
// The fraction of the speed `along` the surface that a bounce with the speed `rebound` keeps, m/s both.
double kept_by_friction(const Mover& mover, const Hit& hit, double along, double rebound);
// How far `along`, a displacement or a velocity, leads down on ground of that normal; 0 going up.
double descent(const Vec3& ground_normal, const Vec3& along);
double press_down(const Mover& mover, const Vec3& ground_normal, const Vec3& move);  // metres this step, >= 0
void set_ground_velocity(Mover& mover);
void cap_energy(Mover& mover, const Vec3& from, const Vec3& driven_velocity);
// Static friction besides the response: two steep faces that wedge the player hold it, and an idle player
// keeps its position bit for bit. `height`: before the vertical pass by `rise`.
void hold_where_wedged(Mover& mover, double rise, double height);
void rest(Mover& mover, const Vec3& from);

// Steps. `before` is where the horizontal move `flat` began.
// The mover holds the result of the plain move. True if a step was climbed instead, including the drop onto
// it.
bool step_up(Mover& mover, const Motion& before, const Vec3& flat);
// The lecture's form: the whole move, lifted before and dropped after. False if it leads to no ground.
bool step_every_move(Mover& mover, const Motion& before, const Vec3& flat);
void snap_down(Mover& mover, const Motion& before);

// Landing, which a step up and a snap to the floor end with: the player stands on what a sweep down touched,
// unless the surface has a response of its own or is too steep; then nothing is changed.
struct LandingRules {
    Decision own_response, too_steep;  // what a refusal is called
    bool on_ice;                       // surfaces that keep energy may be landed on
};
std::optional<Refusal> land(Mover& mover, const Swept& swept, const LandingRules& rules);
// Notes what the player stands on.
void stand_on(Mover& mover, const Contact& contact, std::uint32_t platform);

// Footing: which steep contacts can be stood on, and what is no higher than a step.
// The contact is on the front of a step, and walkable ground leads there from below the centre.
bool on_rim(Mover& mover, const Contact& contact);
// The contact is at most `highest` metres above the point stood on when the player was at `begin`, or steps
// no higher than that lead up to it.
bool no_higher_than_steps(const Mover& mover, const Motion& begin, const Contact& contact, double highest);
// The same downwards: from the ground below `begin` to the contact no step is deeper.
bool no_deeper_than_steps(const Mover& mover, const Vec3& begin, const Contact& contact, double deepest);

// Jumping. Windows are counted down in the state, so they are exact to the tick at every rate: one of w
// seconds holds for the w / dt steps after it opened. Repeated subtraction may leave a little of one that has
// run out.
inline bool is_held(const Motion& motion) {
    return motion.grounded || motion.climbing || motion.stuck || motion.hanging;
}
inline bool is_open(double window_s, double dt) {
    return window_s > 1e-6 * dt;
}
bool wants_jump(const Mover& mover);  // pressed now, or remembered
// True: the press starts a jump, and the mover has its velocity.
bool start_jump(Mover& mover);
// Jumps, one file each: the velocity, m/s, that the jump starts with, or why there is none. The list of them
// is in jump.cpp.
using JumpStart = std::variant<std::monostate, Vec3, Refusal>;  // monostate: nothing is to be said of it
// Nothing: the player is held by something or left it just now.
std::optional<Refusal> too_late_to_jump(const Mover& mover);
JumpStart jump_from_hold(Mover& mover);  // held by something, or just left it
JumpStart jump_off_wall(Mover& mover);
JumpStart jump_in_air(Mover& mover);
void cut_jump(Mover& mover);

// Walls: within 30 degrees of upright, seen from the side that is solid.
struct Wall {
    Vec3 out;  // horizontal, unit
    Support support;
};
// The nearest wall at most `reach` metres beside the body.
std::optional<Wall> wall_beside(const Mover& mover, double reach);
// A wall that the player touched in the step before. No query.
bool touches_wall(const PlayerState& state);
// How directly the stick points into it: a cosine, 0 with the stick at rest.
double push_into(const Mover& mover, const Wall& wall);
void slide_down_wall(Mover& mover);
bool stick_is_locked(const Mover& mover);

// Moves. Begins a dash or goes on with it: the mover has its velocity. `jumps`: a jump ends it.
void dash(Mover& mover, bool jumps);
void end_dash(Mover& mover);  // at the end of a part that it moves: the speed that remains
void glide(Mover& mover);
void drop_through(Mover& mover);
// A sweep of the mover's body that sees no one-sided faces.
std::optional<Contact> sweep_dropping(const Mover& mover, std::uint32_t platform, const Vec3& from,
                                      const Vec3& move);
bool drops_on(const Mover& mover);
// The player falls by `move` and holds on to an edge on its way; nothing: it falls on.
std::optional<Drive> grab_ledge(Mover& mover, const Vec3& move);
// Of a player that hangs: it hangs on, climbs, or lets go (nothing). False in `jump`: the press is used.
std::optional<Drive> hang_on(Mover& mover, bool& jump);
void hang(Mover& mover, const Vec3& move);
// Crouching changes the body before a step, which then runs under the settings of that body.
void choose_body(const MovementScene& scene, const MovementSettings& settings, PlayerState& state,
                 const PlayerInput& input, TraceSink* trace);

// Clocks and counts of hacks: members of the state, and what each is after the step.
struct Clock {
    double PlayerState::*member;
    double (*after)(const Mover&);
};
struct Count {
    std::uint8_t PlayerState::*member;
    std::uint8_t (*after)(const Mover&);
};
double coyote_after(const Mover& mover);
double jump_buffer_after(const Mover& mover);
double wall_x_after(const Mover& mover);
double wall_z_after(const Mover& mover);
double wall_lock_after(const Mover& mover);
double move_after(const Mover& mover);
std::uint8_t dashes_after(const Mover& mover);
std::uint8_t air_jumps_after(const Mover& mover);
inline constexpr auto clocks = std::to_array<Clock>({
    {&PlayerState::coyote_s, coyote_after},
    {&PlayerState::jump_buffer_s, jump_buffer_after},
    {&PlayerState::wall_x, wall_x_after},
    {&PlayerState::wall_z, wall_z_after},
    {&PlayerState::wall_lock_s, wall_lock_after},
    {&PlayerState::move_s, move_after},
});
inline constexpr auto counts = std::to_array<Count>({
    {&PlayerState::air_jumps, air_jumps_after},
    {&PlayerState::dashes, dashes_after},
});

}  // namespace slipface
