// The position at which a player starts: a spawn, corrected if necessary, or a floor found by search.
#pragma once

#include <string_view>

#include "slipface/level/level_scene.h"

namespace slipface {

// Whether there is a main spawn: Level::spawn_is_set, or a position or yaw other than 0.
inline bool has_spawn(const Level& level) {
    return level.spawn_is_set || !level.spawn.isZero(0.0) || level.spawn_yaw != 0.0;
}
// The main spawn, if it is set, then the others, as the level file lists them.
std::vector<Spawn> all_spawns(const Level& level);
// The first of `spawns` becomes the main one. Empty: the level has no spawn.
void set_spawns(Level& level, std::vector<Spawn> spawns);
// Why `spawns` cannot be a level's spawns: a name that is empty or used twice, a position or yaw that is not
// finite, a coordinate beyond 1e9 m, more than max_spawns. Empty: they are valid.
std::string spawns_problem(std::span<const Spawn> spawns);

// The result of find_start().
struct Start {
    Vec3 position = Vec3::Zero();  // centre of the player, in the level's coordinates
    double yaw = 0.0;              // radians, as Level::spawn_yaw
    std::string spawn;             // the spawn's name; empty: the level has none
    bool stands = true;            // false: no floor below, or no room, and no open floor was found
    // A sentence for the user: what was done and why. Empty: the player starts exactly at the spawn.
    std::string note;
};

// The start at the spawn `name`; an empty name means the main spawn.
// - A spawn with room for the player is used exactly, also in mid-air.
// - A spawn that overlaps the level by more than the skin is lifted onto the floor there, by at most about
//   the player's height, or pushed out sideways, whichever is the shorter displacement.
// - A spawn with nothing below it and no ladder or sticky surface around it, or with no room near it, is
//   replaced by open floor (find_open_floor()). In a level with platforms it may have nothing below it.
// - A level without spawns starts at its origin, if that can be made to fit, has floor below it, at most as
//   deep as the player is high, on all four
//   sides, is in no closed solid, and reaches nearly as much as any start; else on open floor.
// `scene` is the level's scene at time 0; `offset` is LevelScene::offset(). Error: no spawn has this name.
Result<Start> find_start(const Level& level, const MovementScene& scene, const Vec3& offset,
                         const MovementSettings& settings, std::string_view name = {});
Result<Start> find_start(const Level& level, LevelScene& scene, const MovementSettings& settings,
                         std::string_view name = {});

// Moves the level's main spawn to the start that find_start() finds. For callers that read only the level's
// main spawn, such as audits.
Result<Start> settle_start(Level& level, std::string_view name = {});

// The centre of a player who stands on open floor of the static geometry and the terrain, in the scene's
// coordinates; nothing if there is no such floor. The level is cut into columns, at most 2^18. Floors are
// faces that look up, no steeper than max_slope, no hazards, with room for the player above, and not inside
// of closed shells (winding number); if that gives less than half as much, faces that look down. Columns are
// connected where the player walks from one to the next, floors by jumps and drops. Of the floors from which
// 0.7 of the most area is reached, and half as large as the largest of these, the result is the place nearest
// to the middle; places with four connections come first. Heights above the lowest place count double, so
// that a room is preferred to its roof. The same level gives the same bits. Where so many triangles lie in
// one place that trying places takes too long, the search ends, and `all_tried`, if given, becomes false.
std::optional<Vec3> find_open_floor(const MovementScene& scene, const MovementSettings& settings,
                                    bool* all_tried = nullptr);

// The centre of a player who rests a skin away from the plane through `point` with the unit normal `normal`.
Vec3 centre_on(const Vec3& point, const Vec3& normal, const MovementSettings& settings);

}  // namespace slipface
