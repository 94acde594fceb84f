/* Slipface for C and for everything that can call C: swept ellipsoids against triangles, and a player that is
 * moved by them. The same results as the C++ library, to the bit. Two libraries have these functions, of
 * which a program links one: libslipface-mover, which depends on the runtime of C and C++ alone, and
 * libslipface, which also has those of slipface_level.h.
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
 * Versions: a struct that the caller fills begins with its size, sizeof(slipface_filter), and what a later
 * version adds counts as 0; a struct of results and slipface_player have room for what is added. Arrays are
 * stepped through by the size of their first element.
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
SLIPFACE_API const char* slipface_version(void); /* "0.2.0" */

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

/* The program's own threads for what says that it uses them: `run` calls job(data, i) for each i below
 * `count`, on any threads, and returns when all have returned; a job waits for no other. `threads`: for how
 * many work is cut into jobs. `run` null: libslipface's own threads, in libslipface-mover the calling thread.
 * Call it before everything else. */
typedef void (*slipface_run_jobs)(void* user, size_t count, void (*job)(void* data, size_t i), void* data);
SLIPFACE_API slipface_status slipface_set_jobs(slipface_run_jobs run, void* user, uint32_t threads,
                                               slipface_error* error);

typedef struct slipface_vec3 {
    double x, y, z;
} slipface_vec3;

/* ---- Settings of the movement ------------------------------------------------------------------------ */

typedef struct slipface_settings {
    uint64_t id; /* 0 is never one */
} slipface_settings;

/* The defaults, or those of a preset: "platformer", "lecture", "precise-platformer", "momentum",
 * "simulation". `preset` may be null. */
SLIPFACE_API slipface_status slipface_settings_new(const char* preset, slipface_settings* settings,
                                                   slipface_error* error);
SLIPFACE_API slipface_status slipface_settings_free(slipface_settings settings, slipface_error* error);
/* Changes one: "gravity=12", "step_up=off", "max_slope=50deg" (docs/settings.md). */
SLIPFACE_API slipface_status slipface_settings_set(slipface_settings settings, const char* assignment,
                                                   slipface_error* error);
/* A switch is 0 or 1, a choice its index. */
SLIPFACE_API slipface_status slipface_settings_get(slipface_settings settings, const char* name,
                                                   double* value, slipface_error* error);

/* The settings by number, for property sheets and for games that change them often. A number holds for one
 * version of the library: ask for it by name. */
typedef enum slipface_setting_kind {
    SLIPFACE_SWITCH = 0, /* 0 or 1 */
    SLIPFACE_WHOLE = 1,
    SLIPFACE_NUMBER = 2, /* angles in radians */
    SLIPFACE_CHOICE = 3  /* 0 up to `maximum` */
} slipface_setting_kind;
typedef struct slipface_setting {
    const char *name, *label, *group, *unit, *meaning; /* never null; they live as long as the library */
    double minimum, maximum, initial;
    uint32_t kind; /* a slipface_setting_kind */
    uint32_t reserved[3];
} slipface_setting;
SLIPFACE_API uint32_t slipface_setting_count(void);
SLIPFACE_API slipface_status slipface_setting_at(uint32_t number, slipface_setting* setting,
                                                 slipface_error* error);
SLIPFACE_API slipface_status slipface_setting_find(const char* name, uint32_t* number, slipface_error* error);
/* Changes one. */
SLIPFACE_API slipface_status slipface_settings_set_number(slipface_settings settings, uint32_t number,
                                                          double value, slipface_error* error);
SLIPFACE_API slipface_status slipface_settings_get_number(slipface_settings settings, uint32_t number,
                                                          double* value, slipface_error* error);

/* ---- Worlds ------------------------------------------------------------------------------------------ */

typedef struct slipface_world {
    uint64_t id; /* 0 is never one */
} slipface_world;

typedef struct slipface_triangles {
    uint32_t size;          /* sizeof(slipface_triangles) */
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
SLIPFACE_API slipface_status slipface_world_free(slipface_world world, slipface_error* error);

/* Of everything that does not move; `lowest` is above `highest` if there is nothing. */
SLIPFACE_API slipface_status slipface_world_bounds(slipface_world world, slipface_vec3* lowest,
                                                   slipface_vec3* highest, size_t* triangle_count,
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

/* Changes a world of triangles: the groups of a face, one bit each; of what does not move if `platform` is
 * SLIPFACE_NONE. A door that opens for one team, a floor that a player drops through. */
SLIPFACE_API slipface_status slipface_world_set_face_groups(slipface_world world, uint32_t platform,
                                                            uint32_t face, uint32_t groups,
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
/* ---- Queries: static geometry and platforms ---------------------------------------------------------- */

/* What a query sees and a player meets. Where a filter may be null, null sees everything. */
typedef struct slipface_filter {
    uint32_t size;   /* sizeof(slipface_filter) */
    uint32_t mask;   /* what has one of these groups is seen; UINT32_MAX: all */
    uint32_t groups; /* of a player itself, for the masks of other players; not for queries */
    uint32_t ignored_type_count;
    const uint8_t* ignored_types; /* types that are not seen; may be null if the count is 0 */
    /* Asked last, 0: not seen; null: all are. It is called from several threads at once if the call uses
     * several, must answer the same every time within the call, and must not throw or jump out. */
    int (*sees)(void* user, uint32_t platform, uint32_t triangle);
    void* user;
} slipface_filter;
/* slipface_filter filter = SLIPFACE_FILTER; filter.mask = ... */
#define SLIPFACE_FILTER \
    { sizeof(slipface_filter), UINT32_MAX, UINT32_MAX, 0, NULL, NULL, NULL }

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
    uint32_t pass;     /* of a step's contact: a slipface_pass */
    double speed;      /* of a step's contact, whose t is 0: m/s, at which body and face approached each other
                          along the      normal */
    uint32_t reserved[4];
} slipface_contact;

typedef struct slipface_ray_hit {
    double t;             /* in lengths of the direction; negative: nothing was hit */
    slipface_vec3 normal; /* unit, towards the ray's origin */
    slipface_vec3 point;
    uint32_t triangle, face, platform;
    uint32_t back; /* 1: from behind */
    uint32_t reserved[4];
} slipface_ray_hit;

typedef struct slipface_closest {
    double distance; /* negative: nothing within max_distance */
    slipface_vec3 point;
    uint32_t triangle, face, platform;
    uint32_t reserved[5];
} slipface_closest;

typedef struct slipface_overlap {
    slipface_vec3
        point; /* of the triangle, nearest to the centre in the space where the ellipsoid is a sphere */
    slipface_vec3 normal; /* unit, towards the centre */
    double depth;         /* 1 - distance in that space, above 0 and up to 1 */
    uint32_t triangle, face, type, platform, feature;
    uint32_t reserved[5];
} slipface_overlap;

/* Numbers that are not finite, radii that are not positive and a ray without a direction are errors. A move
 * of no length hits nothing. */
SLIPFACE_API slipface_status slipface_sweep_one(slipface_world world, const slipface_sweep* sweep,
                                                const slipface_filter* filter, slipface_contact* contact,
                                                slipface_error* error);
/* `count` sweeps on all threads, the same bits as one by one. With a filter or platforms, one after the
 * other on each thread; else many side by side, which is faster. */
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
    uint32_t size;         /* sizeof(slipface_input) */
    uint32_t buttons;      /* those that are held: slipface_button, and from bit 8 on a game's own */
    double wish_x, wish_z; /* wanted velocity as a fraction of the walking speed; longer than 1 counts as 1 */
} slipface_input;

typedef enum slipface_carrier {
    SLIPFACE_UNKNOWN = 0,  /* of a new player: what its first step finds, so that 0 m/s is at rest there */
    SLIPFACE_LEVEL = 1,    /* nothing that moves: still ground, or the player is in the air */
    SLIPFACE_PLATFORM = 2, /* ground_platform */
    SLIPFACE_SURFACE = 3,  /* a belt or turntable: ground_type */
    SLIPFACE_CHARACTER = 4 /* another player of a crowd */
} slipface_carrier;

typedef enum slipface_flag {
    SLIPFACE_GROUNDED = 1 << 0,
    SLIPFACE_CLIMBING = 1 << 1, /* on a ladder */
    SLIPFACE_STUCK = 1 << 2,    /* held by a sticky surface */
    SLIPFACE_JUMP_HELD = 1 << 3,
    SLIPFACE_HAZARD = 1 << 4,  /* touched a hazardous surface in this step: the game respawns the player */
    SLIPFACE_JUMPING = 1 << 5, /* rises by a jump whose button is still held */
    SLIPFACE_TRAPPED = 1 << 6, /* inside geometry and could not be moved out */
    SLIPFACE_CRUSHED = 1 << 7, /* by a platform that left no room, in this step */
    SLIPFACE_DASH_HELD = 1 << 8,
    SLIPFACE_HANGING = 1 << 9, /* on a ledge */
    SLIPFACE_CROUCHED = 1 << 10,
    SLIPFACE_WANTS_TO_STAND = 1 << 11, /* crouched without the button, because there is no room */
    SLIPFACE_DROPPING = 1 << 12        /* through one-sided ground */
} slipface_flag;

/* All that a step knows of a player: copy it to save it, and step the copy to replay (rollback). Its bytes
 * are equal where its meaning is. */
typedef struct slipface_player {
    uint32_t size;          /* slipface_player_at writes it; a struct of another size is refused */
    uint32_t flags;         /* slipface_flag */
    slipface_vec3 position; /* centre of the ellipsoid */
    slipface_vec3 velocity; /* m/s, relative to the carrier; on the ground it also presses down: see
                               slipface_motion_velocity */
    slipface_vec3 ground_normal;
    slipface_vec3
        air_frame;     /* m/s, in the air: of the ground that was left; the stick steers relative to it */
    int32_t sector[3]; /* all 0 in a world without sectors */
    uint32_t ground_face, ground_platform;
    uint8_t ground_type;
    uint8_t carrier;       /* a slipface_carrier */
    uint8_t trigger_count; /* the triggers that the player is in: their platforms and types */
    uint8_t trigger_type[8];
    uint8_t reserved; /* 0: equal players have equal bytes */
    uint32_t trigger_platform[8];
    /* What abilities remember, and room for what later versions add: in the order of PlayerState's lists. */
    double numbers[20];
    slipface_vec3 vectors[4];
    uint8_t counts[8];
} slipface_player;

/* Why a step's contact was met. */
typedef enum slipface_pass {
    SLIPFACE_SLIDE = 0,
    SLIPFACE_HORIZONTAL = 1, /* of a split move */
    SLIPFACE_VERTICAL = 2,
    SLIPFACE_PROBE = 3,   /* a platform that pushes the player */
    SLIPFACE_STEP_UP = 4, /* where a step up ended */
    SLIPFACE_SNAP = 5     /* where a snap to the floor ended */
} slipface_pass;

typedef enum slipface_event_kind {
    SLIPFACE_LANDED = 0,     /* value: the speed, m/s, at which the player met the ground */
    SLIPFACE_LEFT = 1,       /* the ground; value: the speed upwards, m/s */
    SLIPFACE_TOUCHED = 2,    /* a face of a type other than 0, once per step; value: the speed into it, m/s */
    SLIPFACE_MET_HAZARD = 3, /* and none in the step before */
    SLIPFACE_STEPPED = 4,    /* up; value: how high, m */
    SLIPFACE_WAS_CRUSHED = 5, /* and was not in the step before */
    SLIPFACE_ENTERED = 6,     /* a trigger: what is not solid, all faces of its type in the world or in a
                                 platform.     Where they are closed, their inside, too. */
    SLIPFACE_STAYED = 7,      /* in it */
    SLIPFACE_DEPARTED = 8     /* from it */
} slipface_event_kind;
typedef struct slipface_event {
    uint32_t kind; /* a slipface_event_kind */
    uint32_t type, platform,
        face; /* of what was touched, left or entered; SLIPFACE_NONE: no platform, no face */
    double value;
    uint32_t reserved[2];
} slipface_event;

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

/* What a step reports besides the player, into the caller's room, without allocating memory. */
typedef struct slipface_report {
    uint32_t size;         /* sizeof(slipface_report) */
    uint32_t contact_room; /* of `contacts` */
    slipface_contact*
        contacts;           /* in order, once per face, normal and pass; may be null if there is no room */
    uint32_t contact_count; /* set */
    uint32_t contacts_left_out; /* set: 1 if there were more than there is room for */
    slipface_event* events; /* in the order of slipface_event_kind; may be null if there is no room, and then
                               triggers are not looked for */
    uint32_t event_room;
    uint32_t event_count; /* set: may be more than `event_room`, of which the first are written */
    slipface_trace trace; /* may be null; not in a crowd */
    void* user;           /* of `trace` */
} slipface_report;

/* A player at rest with its centre there. */
SLIPFACE_API slipface_status slipface_player_at(slipface_world world, slipface_vec3 position,
                                                slipface_player* player, slipface_error* error);
/* The player `dt` seconds later (1e-4 and more; above 0.25 s it moves in parts). A player that began outside
 * all triangles ends outside all of them. `filter`: what it meets; null: everything. `report` may be null.
 * `next` may be `player`. */
SLIPFACE_API slipface_status slipface_step(slipface_world world, slipface_settings settings,
                                           const slipface_player* player, const slipface_input* input,
                                           double dt, const slipface_filter* filter, slipface_report* report,
                                           slipface_player* next, slipface_error* error);
/* `count` players, each with its input, on all threads; they pass through each other. Changes `players`.
 * `filters` and `reports` have one for each player, or are null. */
SLIPFACE_API slipface_status slipface_step_many(slipface_world world, slipface_settings settings,
                                                slipface_player* players, const slipface_input* inputs,
                                                size_t count, double dt, const slipface_filter* filters,
                                                slipface_report* reports, slipface_error* error);
/* `count` players that push each other and stand on each other, as far as their filters let them meet.
 * `settings` has the settings of each player. The order of the players changes no bit. Changes `players`. */
SLIPFACE_API slipface_status slipface_step_crowd(slipface_world world, const slipface_settings* settings,
                                                 slipface_player* players, const slipface_input* inputs,
                                                 size_t count, double dt, const slipface_filter* filters,
                                                 slipface_report* reports, slipface_error* error);
/* The player with another body, its feet where they are: to crouch, to stand up. *done 0: there is no room,
 * and *next is the player as it was. Later steps need settings with the new radii. `filter` as in
 * slipface_step. */
SLIPFACE_API slipface_status slipface_change_body(slipface_world world, slipface_settings settings,
                                                  const slipface_player* player, slipface_vec3 radii,
                                                  const slipface_filter* filter, slipface_player* next,
                                                  uint8_t* done, slipface_error* error);
/* A new player where `player` is, or at the nearest place at most `farthest` metres away that is outside of
 * all geometry, solids that it does not touch included: for teleports and respawns. *done 0: there is none,
 * and *next is the player as it was. */
SLIPFACE_API slipface_status slipface_put_player(slipface_world world, slipface_settings settings,
                                                 const slipface_player* player, double farthest,
                                                 const slipface_filter* filter, slipface_player* next,
                                                 uint8_t* done, slipface_error* error);
/* Velocity of the player's own motion, without what presses it to the ground: for animation and displays. */
SLIPFACE_API slipface_status slipface_motion_velocity(const slipface_player* player, slipface_vec3* velocity,
                                                      slipface_error* error);

#ifdef __cplusplus
}
#endif
#endif
