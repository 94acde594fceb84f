/* Slipface for C and for everything that can call C: swept ellipsoids against triangles, and a player that is
 * moved by them. The same results as the C++ library, to the bit.
 *
 * Space: metres, +Y up, right-handed. Angles in radians, time in seconds.
 *
 * Every function returns a slipface_status; results come through pointers, which must not be null unless
 * said. What is wrong is said in *error, which may be null. Nothing is thrown, nothing is printed, and a call
 * that fails leaves its results and its world as they were.
 *
 * Threads: any number of threads may query a world and step players in it at once. A function that changes a
 * world or settings ("changes") needs them for itself: if another thread is in them, one of the two calls
 * returns SLIPFACE_IN_USE.
 *
 * A handle that was freed, or that never was one, gives SLIPFACE_WRONG_HANDLE. */
#ifndef SLIPFACE_H
#define SLIPFACE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifndef SLIPFACE_API /* the library itself is built with what exports a name */
#define SLIPFACE_API
#endif

/* The version of these declarations. A change that breaks a caller raises it, and the library's SONAME. */
#define SLIPFACE_INTERFACE 1
SLIPFACE_API uint32_t slipface_interface(void);  /* that of the library which is loaded */
SLIPFACE_API const char* slipface_version(void); /* "0.1.0" */

typedef enum slipface_status {
    SLIPFACE_OK = 0,
    SLIPFACE_WRONG_ARGUMENT = 1, /* null, not finite, out of range, sizes that do not fit */
    SLIPFACE_WRONG_HANDLE = 2,
    SLIPFACE_IN_USE = 3,      /* another thread is in it */
    SLIPFACE_CANNOT_READ = 4, /* a file */
    SLIPFACE_NO_MEMORY = 5,
    SLIPFACE_FAILED = 6
} slipface_status;

typedef struct slipface_error {
    slipface_status status;
    char text[500]; /* UTF-8, ends with 0 */
} slipface_error;

#define SLIPFACE_NONE UINT32_MAX /* no triangle, no face, no platform */

typedef struct slipface_vec3 {
    double x, y, z;
} slipface_vec3;

/* ---- Settings of the movement ------------------------------------------------------------------------ */

typedef struct slipface_settings {
    uint64_t id; /* 0 is never one */
} slipface_settings;

/* The defaults, or those of a preset: "platformer", "lecture", "precise-platformer", "momentum",
 * "simulation", or the path of a preset file. `preset` may be null. */
SLIPFACE_API slipface_status slipface_settings_new(const char* preset, slipface_settings* settings,
                                                   slipface_error* error);
SLIPFACE_API slipface_status slipface_settings_free(slipface_settings settings, slipface_error* error);
/* Changes one: "gravity=12", "step_up=off", "max_slope=50deg" (docs/settings.md). */
SLIPFACE_API slipface_status slipface_settings_set(slipface_settings settings, const char* assignment,
                                                   slipface_error* error);
/* A switch is 0 or 1, a choice its index. */
SLIPFACE_API slipface_status slipface_settings_get(slipface_settings settings, const char* name,
                                                   double* value, slipface_error* error);

/* ---- Worlds ------------------------------------------------------------------------------------------ */

typedef struct slipface_world {
    uint64_t id; /* 0 is never one */
} slipface_world;

typedef struct slipface_triangles {
    const float* positions; /* x, y, z of each */
    size_t position_count;
    const uint32_t* indices; /* three of each triangle, counter-clockwise seen from the front */
    size_t triangle_count;
    const uint8_t* types;   /* of each triangle; null: all are 0 */
    const uint32_t* groups; /* of each triangle, one bit per group; null: each is in all */
} slipface_triangles;

/* A world of triangles with the types default, ice, ladder, sticky, bouncy, conveyor, turntable and hazard,
 * in this order. Triangle i is face i. */
SLIPFACE_API slipface_status slipface_world_from_triangles(const slipface_triangles* triangles,
                                                           slipface_world* world, slipface_error* error);
/* A level: *.slipface.json, or geometry in any format that the editor opens. It has the level's types,
 * platforms and terrain, and stands at time 0. Triangles and faces are numbered as in the file. A level with
 * sectors is given in the coordinates of its home sector. */
SLIPFACE_API slipface_status slipface_world_from_level(const char* path, slipface_world* world,
                                                       slipface_error* error);
SLIPFACE_API slipface_status slipface_world_free(slipface_world world, slipface_error* error);

/* Of everything that does not move; `lowest` is above `highest` if there is nothing. */
SLIPFACE_API slipface_status slipface_world_bounds(slipface_world world, slipface_vec3* lowest,
                                                   slipface_vec3* highest, size_t* triangle_count,
                                                   slipface_error* error);
/* Of a level: new settings as the level file has them. */
SLIPFACE_API slipface_status slipface_world_settings(slipface_world world, slipface_settings* settings,
                                                     slipface_error* error);
/* Of a level: where a player of these settings starts, its centre, and where it looks: 0 is -Z, and positive
 * turns to the left. `name` null: the main spawn. A spawn without room or floor is put right first. */
SLIPFACE_API slipface_status slipface_world_spawn(slipface_world world, slipface_settings settings,
                                                  const char* name, slipface_vec3* position, double* yaw,
                                                  slipface_error* error);

/* Surface types. SLIPFACE_NONE in *type: there is none of this name. */
SLIPFACE_API slipface_status slipface_world_find_type(slipface_world world, const char* name, uint32_t* type,
                                                      slipface_error* error);
/* Changes the world: a new type that behaves as `default`. At most 255. */
SLIPFACE_API slipface_status slipface_world_add_type(slipface_world world, const char* name, uint32_t* type,
                                                     slipface_error* error);
/* Changes the world: one parameter of a type, by its name in docs/settings.md ("friction", "solid",
 * "velocity"): one number, three of a vector; a switch is 0 or not. */
SLIPFACE_API slipface_status slipface_world_set_type(slipface_world world, uint32_t type,
                                                     const char* parameter, const double* values,
                                                     size_t value_count, slipface_error* error);
/* Changes the world: the type of a face of what does not move. */
SLIPFACE_API slipface_status slipface_world_set_face_type(slipface_world world, uint32_t face, uint32_t type,
                                                          slipface_error* error);

/* Moving platforms of a world of triangles. They stand as given until they are moved.
 * Changes the world. *platform counts from 0. */
SLIPFACE_API slipface_status slipface_world_add_platform(slipface_world world,
                                                         const slipface_triangles* triangles,
                                                         uint32_t* platform, slipface_error* error);
/* Changes the world: the platform goes from where it is to `position` and `rotation` (a quaternion x, y, z,
 * w; null: not turned) within the next step of `dt`. Once that step was made, call it again, also for a
 * platform that stays. */
SLIPFACE_API slipface_status slipface_world_move_platform(slipface_world world, uint32_t platform,
                                                          slipface_vec3 position, const double rotation[4],
                                                          double dt, slipface_error* error);
/* Of a level with moving platforms. Changes the world: it stands as in the step from time to time + dt. */
SLIPFACE_API slipface_status slipface_world_set_time(slipface_world world, double time, double dt,
                                                     slipface_error* error);

/* ---- Queries: static geometry and platforms ---------------------------------------------------------- */

typedef struct slipface_filter {
    const uint8_t* ignored_types; /* types that are not seen; may be null if the count is 0 */
    size_t ignored_type_count;
    uint32_t groups; /* a triangle is seen if one of its groups is here; UINT32_MAX: all */
} slipface_filter;   /* where a filter may be null, null sees everything */

typedef enum slipface_feature {
    SLIPFACE_INTERIOR = 0,
    SLIPFACE_EDGE = 1,
    SLIPFACE_VERTEX = 2
} slipface_feature;

typedef struct slipface_sweep {
    slipface_vec3 radii; /* of the ellipsoid along X, Y and Z, each above 0 */
    slipface_vec3 from;  /* its centre */
    slipface_vec3 move;
} slipface_sweep;

typedef struct slipface_contact {
    double t; /* fraction of the move, 0 to 1; 2: nothing was hit, and the rest is 0 or SLIPFACE_NONE */
    slipface_vec3 normal; /* unit, towards the ellipsoid */
    slipface_vec3 point;
    uint32_t triangle, face, type;
    uint32_t platform; /* SLIPFACE_NONE: of the world; else triangle and face count within the platform, in a
                          level within the whole level */
    uint32_t feature;  /* a slipface_feature */
} slipface_contact;

typedef struct slipface_ray_hit {
    double t;             /* in lengths of the direction; negative: nothing was hit */
    slipface_vec3 normal; /* unit, towards the ray's origin */
    slipface_vec3 point;
    uint32_t triangle, face, platform;
    uint32_t back; /* 1: from behind */
} slipface_ray_hit;

typedef struct slipface_closest {
    double distance; /* negative: nothing within max_distance */
    slipface_vec3 point;
    uint32_t triangle, face, platform;
} slipface_closest;

typedef struct slipface_overlap {
    slipface_vec3
        point; /* of the triangle, nearest to the centre in the space where the ellipsoid is a sphere */
    slipface_vec3 normal; /* unit, towards the centre */
    double depth;         /* 1 - distance in that space, above 0 and up to 1 */
    uint32_t triangle, face, type, platform, feature;
} slipface_overlap;

/* Numbers that are not finite, radii that are not positive and moves of no length hit nothing. */
SLIPFACE_API slipface_status slipface_sweep_one(slipface_world world, const slipface_sweep* sweep,
                                                const slipface_filter* filter, slipface_contact* contact,
                                                slipface_error* error);
/* `count` sweeps on all processors, the same bits as one by one. With a filter or platforms, one after the
 * other on each processor; else many side by side, which is faster. */
SLIPFACE_API slipface_status slipface_sweep_many(slipface_world world, const slipface_sweep* sweeps,
                                                 size_t count, const slipface_filter* filter,
                                                 slipface_contact* contacts, slipface_error* error);
/* Each triangle's own contact, the earliest first. *found may be more than `room`, of which the first are
 * written. `contacts` may be null if `room` is 0. */
SLIPFACE_API slipface_status slipface_sweep_hits(slipface_world world, const slipface_sweep* sweep,
                                                 const slipface_filter* filter, slipface_contact* contacts,
                                                 size_t room, size_t* found, slipface_error* error);
/* The first triangle with t in [0, max_t]; pass INFINITY for no end. */
SLIPFACE_API slipface_status slipface_ray(slipface_world world, slipface_vec3 origin, slipface_vec3 direction,
                                          double max_t, const slipface_filter* filter, slipface_ray_hit* hit,
                                          slipface_error* error);
SLIPFACE_API slipface_status slipface_ray_hits(slipface_world world, slipface_vec3 origin,
                                               slipface_vec3 direction, double max_t,
                                               const slipface_filter* filter, slipface_ray_hit* hits,
                                               size_t room, size_t* found, slipface_error* error);
SLIPFACE_API slipface_status slipface_closest_point(slipface_world world, slipface_vec3 point,
                                                    double max_distance, const slipface_filter* filter,
                                                    slipface_closest* closest, slipface_error* error);
/* The triangles that an ellipsoid at rest overlaps: those of the world in ascending order, then those of each
 * platform. */
SLIPFACE_API slipface_status slipface_overlaps(slipface_world world, slipface_vec3 radii,
                                               slipface_vec3 centre, const slipface_filter* filter,
                                               slipface_overlap* overlaps, size_t room, size_t* found,
                                               slipface_error* error);

/* ---- Players ----------------------------------------------------------------------------------------- */

typedef enum slipface_button {
    SLIPFACE_JUMP = 1 << 0,
    SLIPFACE_CROUCH = 1 << 1,
    SLIPFACE_DASH = 1 << 2,
    SLIPFACE_GRAB = 1 << 3,
    SLIPFACE_DROP = 1 << 4
} slipface_button;

typedef struct slipface_input {
    double wish_x, wish_z; /* wanted velocity as a fraction of the walking speed; longer than 1 counts as 1 */
    uint8_t jump;          /* 1: the button is held, as SLIPFACE_JUMP in buttons */
    uint32_t buttons;      /* those that are held: slipface_button, and from bit 8 on a game's own */
} slipface_input;

typedef enum slipface_carrier {
    SLIPFACE_UNKNOWN = 0,  /* of a new player: what its first step finds, so that 0 m/s is at rest there */
    SLIPFACE_LEVEL = 1,    /* nothing that moves: still ground, or the player is in the air */
    SLIPFACE_PLATFORM = 2, /* ground_platform */
    SLIPFACE_SURFACE = 3,  /* a belt or turntable: ground_type */
    SLIPFACE_CHARACTER = 4 /* another player of a crowd */
} slipface_carrier;

typedef struct slipface_player {
    slipface_vec3 position; /* centre of the ellipsoid */
    slipface_vec3 velocity; /* m/s, relative to the carrier; on the ground it also presses down: see
                               slipface_motion_velocity */
    slipface_vec3 ground_normal;
    slipface_vec3
        air_frame; /* m/s, in the air: of the ground that was left; the stick steers relative to it */
    double ground_rise, coyote_s, jump_buffer_s;
    double wall_x, wall_z, wall_lock_s; /* of the last wall jump, 0: none since something held the player */
    double move_s;                      /* left of a dash, or of a climb onto a ledge */
    int32_t sector[3];                  /* all 0 in a world without sectors */
    uint32_t ground_face, ground_platform;
    uint8_t ground_type;
    uint8_t carrier;                                                                 /* a slipface_carrier */
    uint8_t grounded, climbing, stuck, jump_held, hazard, jumping, trapped, crushed; /* 0 or 1 */
    uint8_t air_jumps, dashes;                                                       /* made in the air */
    uint8_t dash_held, hanging, crouched, wants_to_stand, dropping;                  /* 0 or 1 */
} slipface_player;

typedef enum slipface_record_kind {
    SLIPFACE_SWEEP = 0,    /* name: the pass; from, move, to; contact.t is 2 if nothing was hit */
    SLIPFACE_RESPONSE = 1, /* name: the rule; from and to: the rest of the move before and after, m; move: 0;
                              contact: normal, face and type */
    SLIPFACE_DECISION =
        2, /* name: the setting; text: a sentence in which {value} and {limit} stand for those */
    SLIPFACE_PUSH_OUT = 3 /* from, to; value: planes; limit: 1 if free at `to` */
} slipface_record_kind;

typedef struct slipface_record {
    slipface_record_kind kind;
    const char *name, *text; /* never null; they live as long as the library */
    slipface_vec3 from, move, to;
    slipface_contact contact;
    double value, limit;
    uint32_t face;
} slipface_record;

/* What happened within a step, in order. `record` lives only during the call; the callback must not throw or
 * jump out. It may query the world; changes give SLIPFACE_IN_USE there. */
typedef void (*slipface_trace)(void* user, const slipface_record* record);

/* A player at rest with its centre there. */
SLIPFACE_API slipface_status slipface_player_at(slipface_world world, slipface_vec3 position,
                                                slipface_player* player, slipface_error* error);
/* The player `dt` seconds later (1e-4 and more; above 0.25 s it moves in parts). A player that began outside
 * all triangles ends outside all of them. `trace` may be null. `next` may be `player`. */
SLIPFACE_API slipface_status slipface_step(slipface_world world, slipface_settings settings,
                                           const slipface_player* player, const slipface_input* input,
                                           double dt, slipface_trace trace, void* user, slipface_player* next,
                                           slipface_error* error);
/* `count` players, each with its input, on all processors; they pass through each other. Changes `players`.
 */
SLIPFACE_API slipface_status slipface_step_many(slipface_world world, slipface_settings settings,
                                                slipface_player* players, const slipface_input* inputs,
                                                size_t count, double dt, slipface_error* error);
/* `count` players that push each other and stand on each other. `settings` has the settings of each player.
 * The order of the players changes no bit. Changes `players`. */
SLIPFACE_API slipface_status slipface_step_crowd(slipface_world world, const slipface_settings* settings,
                                                 slipface_player* players, const slipface_input* inputs,
                                                 size_t count, double dt, slipface_error* error);
/* The player with another body, its feet where they are: to crouch, to stand up. *done 0: there is no room,
 * and *next is the player as it was. Later steps need settings with the new radii. */
SLIPFACE_API slipface_status slipface_change_body(slipface_world world, slipface_settings settings,
                                                  const slipface_player* player, slipface_vec3 radii,
                                                  slipface_player* next, uint8_t* done,
                                                  slipface_error* error);
/* A new player where `player` is, or at the nearest place at most `farthest` metres away that is outside of
 * all geometry, solids that it does not touch included: for teleports and respawns. *done 0: there is none,
 * and *next is the player as it was. */
SLIPFACE_API slipface_status slipface_put_player(slipface_world world, slipface_settings settings,
                                                 const slipface_player* player, double farthest,
                                                 slipface_player* next, uint8_t* done, slipface_error* error);
/* Velocity of the player's own motion, without what presses it to the ground: for animation and displays. */
SLIPFACE_API slipface_status slipface_motion_velocity(const slipface_player* player, slipface_vec3* velocity,
                                                      slipface_error* error);

#ifdef __cplusplus
}
#endif
#endif
