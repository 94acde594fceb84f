// The world as movement sees it during one tick: what to collide with, and what the surfaces do. A LevelScene
// (slipface/level/level_scene.h) makes one from a level; a game may fill it by hand.
#pragma once

#include <span>

#include "slipface/collision/posed.h"
#include "slipface/movement/heightfield.h"
#include "slipface/movement/platform_tree.h"
#include "slipface/movement/scene_filter.h"
#include "slipface/movement/surface_type.h"

namespace slipface {

// A platform during one tick: its faces as they were built, and where a pose puts them at any time. Poses
// that turn want a world of CollisionWorld::build_movable().
struct MovingPart {
    const CollisionWorld* rest = nullptr;        // never null in a scene; its faces where no pose moved them
    Pose begin, end;                             // world = pose.apply(rest)
    Vec3 velocity = Vec3::Zero();                // at `end`, m/s, of the point `pivot`
    Vec3 angular_velocity = Vec3::Zero();        // rad/s, along the axis
    Vec3 pivot = Vec3::Zero();                   // of the turning, at `end`
    std::span<const TriangleId> triangles = {};  // [triangle of `rest`] its number in the mesh
    std::span<const std::uint32_t> groups = {};  // [triangle of `rest`] bits; empty: all are in every group

    PosedWorld at_end() const { return PosedWorld(*rest, end); }
};
// Where it is after the fraction `time` of a tick of `dt` seconds, 0..1: the pivot goes straight, and the
// rest turns about it by the angular velocity.
Pose pose_at(const MovingPart& part, double time, double dt);
// A box that contains it during the whole tick.
Aabb room_of(const MovingPart& part);

// The world in sectors, each with its own origin, so that positions stay small however far out a level lies.
struct Sectors {
    double size = 0.0;                          // edge of a sector, metres; 0: one world, no sectors
    std::array<std::int32_t, 3> home{0, 0, 0};  // the sector in whose coordinates the scene is given
    friend bool operator==(const Sectors&, const Sectors&) = default;
};

struct MovementScene {
    const CollisionWorld& collision;  // everything that does not move
    SurfaceTable surfaces;
    std::span<const MovingPart> platforms = {};
    // Of the room_of() of `platforms`; null: every query looks at every platform.
    const PlatformTree* tree = nullptr;
    const Heightfield* heightfield = nullptr;
    Sectors sectors = {};
    // [triangle of `collision`] its number in the mesh; empty: the same number.
    std::span<const TriangleId> triangles = {};
    std::span<const std::uint32_t> groups = {};  // [triangle of `collision`] as in MovingPart
    const SceneFilter* filter = nullptr;         // what the character meets; null: everything
};

// The scene's filter for what does not move (no_id) or for a platform.
QueryFilter filter_of(const MovementScene& scene, std::uint32_t platform);

}  // namespace slipface
