/* Levels and files: what libslipface has besides slipface.h, and libslipface-mover has not. */
#ifndef SLIPFACE_LEVEL_H
#define SLIPFACE_LEVEL_H

#include <slipface.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Settings from a preset file. */
SLIPFACE_API slipface_status slipface_settings_from_file(const char* path, slipface_settings* settings,
                                                         slipface_error* error);
/* A level: *.slipface.json, or geometry in any format that the editor opens. It has the level's types,
 * platforms and terrain, and stands at time 0. Triangles and faces are numbered as in the file. A level with
 * sectors is given in the coordinates of its home sector. */
SLIPFACE_API slipface_status slipface_world_from_level(const char* path, slipface_world* world,
                                                       slipface_error* error);
/* Of a level: new settings as the level file has them. */
SLIPFACE_API slipface_status slipface_world_settings(slipface_world world, slipface_settings* settings,
                                                     slipface_error* error);
/* Of a level: where a player of these settings starts, its centre, and where it looks: 0 is -Z, and positive
 * turns to the left. `name` null: the main spawn. A spawn without room or floor is put right first. */
SLIPFACE_API slipface_status slipface_world_spawn(slipface_world world, slipface_settings settings,
                                                  const char* name, slipface_vec3* position, double* yaw,
                                                  slipface_error* error);

/* Of a level with moving platforms. Changes the world: it stands as in the step from time to time + dt. */
SLIPFACE_API slipface_status slipface_world_set_time(slipface_world world, double time, double dt,
                                                     slipface_error* error);

#ifdef __cplusplus
}
#endif
#endif
