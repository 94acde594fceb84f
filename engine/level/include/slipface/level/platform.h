// Parts of a level that move by themselves: along a path, rotating, or both.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "slipface/base/pose.h"

namespace slipface {

struct PathPoint {
    Vec3 offset = Vec3::Zero();  // displacement from the modelled position, metres
    double speed = 2.0;          // m/s towards the next point, > 0
    double pause_s = 0.0;        // seconds of rest at this point
    friend bool operator==(const PathPoint&, const PathPoint&) = default;
};

enum class PathRepeat : std::uint8_t { loop, ping_pong, once };
inline constexpr std::array<const char*, 3> path_repeat_names{"loop", "ping-pong", "once"};

// The faces of one group or object of the mesh, moving as one rigid body. A path of one point is a constant
// offset. With a rate of 0 the platform does not rotate.
struct Platform {
    std::string name;
    std::string group;  // of Mesh::groups: the OBJ's `g` or `o`
    std::vector<PathPoint> path;
    PathRepeat repeat = PathRepeat::ping_pong;  // loop: from the last point straight to the first
    Vec3 spin_axis = Vec3::UnitY();             // any length but zero
    Vec3 spin_pivot = Vec3::Zero();             // a point on the axis as modelled; follows the path
    double spin_rate = 0.0;                     // rad/s, counter-clockwise seen from the axis's tip
    double phase_s = 0.0;                       // seconds of motion already done at time 0
    friend bool operator==(const Platform&, const Platform&) = default;
};

// The platform's pose at `time_s` seconds of the level's time: a pure function, the same bits everywhere.
// Times before 0 and negative phases count as 0, speeds below 1 mm/s as 1 mm/s, negative pauses as none.
Pose platform_pose(const Platform& platform, double time_s);

// A box that contains the platform at all times; `rest` is its box as modelled.
Aabb platform_reach(const Platform& platform, const Aabb& rest);

// Seconds after which the path repeats; 0 for a path that does not repeat or has fewer than two points.
double path_period(const Platform& platform);

}  // namespace slipface
