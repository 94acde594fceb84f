// Where a player begins in a level: at one of its spawns, made to fit, or on a floor that is looked for.
#pragma once

#include <string_view>

#include "slipface/level/level_scene.h"

namespace slipface {

// Whether there is a main spawn: Level::spawn_is_set, or one that was put somewhere.
inline bool has_spawn(const Level& level) {
    return level.spawn_is_set || !level.spawn.isZero(0.0) || level.spawn_yaw != 0.0;
}
// The main spawn, if it is set, then the others, as the level file lists them.
std::vector<Spawn> all_spawns(const Level& level);
// The first of `spawns` becomes the main one; none: the level has no spawn.
void set_spawns(Level& level, std::vector<Spawn> spawns);
// Why these cannot be a level's spawns: a name that is empty or comes twice, a position that is not finite or
// beyond 1e9 m, more than max_spawns. Empty: they can.
std::string spawns_problem(std::span<const Spawn> spawns);

// What came of looking for a place to begin.
struct Start {
    Vec3 position = Vec3::Zero();  // centre of the player, in the level's coordinates
    double yaw = 0.0;              // radians, as Level::spawn_yaw
    std::string spawn;             // the spawn's name; empty: the level has none
    bool stands = true;  // false: the player has no floor below, or no room; nothing better was found
    // A sentence for people: what was done and why. Empty: the player begins exactly at the spawn.
    std::string note;
};

// The start at the spawn `name`; an empty name means the main spawn. A spawn that the player fits into is
// taken to the bit, in mid-air too. One that overlaps the level by more than the skin is lifted onto the
// floor there, by at most the height of the player, or pushed out sideways, whichever is nearer. One that has
// nothing below it and nothing around it, or no room near it, is replaced by open floor (find_open_floor). A
// level without a spawn begins at its origin, if that can be made to fit and has floor below it on all sides,
// else on open floor. `scene` is the level's at time 0, `offset` the scene's coordinates less the level's
// (LevelScene::offset). Refuses a name that no spawn has.
Result<Start> find_start(const Level& level, const MovementScene& scene, const Vec3& offset,
                         const MovementSettings& settings, std::string_view name = {});
Result<Start> find_start(const Level& level, LevelScene& scene, const MovementSettings& settings,
                         std::string_view name = {});

// For what runs on a level alone, as audits do: what find_start() finds becomes the main spawn's place.
Result<Start> settle_start(Level& level, std::string_view name = {});

// The centre of a player who stands on the best open floor near the middle of what stands still, in the
// scene's coordinates; nothing where there is none. The floor is sampled on a grid of at most 64 x 64
// columns: faces that look up, no steeper than max_slope, no hazards, with room for the player above. Samples
// are connected where the player, raised by a step, can move straight from one to the next. Of the connected
// floors at least half as large as the largest, and not smaller than the player, it is the sample nearest to
// the middle; heights above the lowest count double, so that a room comes before its roof. The same level
// gives the same bits.
std::optional<Vec3> find_open_floor(const MovementScene& scene, const MovementSettings& settings);

// The centre of a player who touches the plane through `point` with the unit normal `normal`, a skin away.
Vec3 centre_on(const Vec3& point, const Vec3& normal, const MovementSettings& settings);

}  // namespace slipface
