// Parts of a level that move by themselves: along a path, turning, or both.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "slipface/base/pose.h"

namespace slipface {

struct PathPoint {
    Vec3 offset = Vec3::Zero();  // metres from where the faces were modelled
    double speed = 2.0;          // m/s on the way to the next point, > 0
    double pause_s = 0.0;        // rests here, before it leaves
    friend bool operator==(const PathPoint&, const PathPoint&) = default;
};

enum class PathRepeat : std::uint8_t { loop, ping_pong, once };
inline constexpr std::array<const char*, 3> path_repeat_names{"loop", "ping-pong", "once"};

// The faces of one group or object of the mesh, moving as one rigid body. Without a path, or with one point,
// it stays at that offset; without a rate it does not turn.
struct Platform {
    std::string name;
    std::string group;  // of Mesh::groups: the OBJ's `g` or `o`
    std::vector<PathPoint> path;
    PathRepeat repeat = PathRepeat::ping_pong;  // loop: from the last point straight to the first
    Vec3 spin_axis = Vec3::UnitY();             // any length but zero
    Vec3 spin_pivot = Vec3::Zero();             // a point of the axis, metres, moves along with the path
    double spin_rate = 0.0;                     // rad/s, counter-clockwise seen from the axis's tip
    double phase_s = 0.0;                       // how far into its motion it is at time 0
    friend bool operator==(const Platform&, const Platform&) = default;
};

// Where the platform is `time_s` seconds after the level began: a pure function, the same bits everywhere.
// Times before 0 count as 0. Speeds that are not positive count as 1 mm/s, negative pauses as none.
Pose platform_pose(const Platform& platform, double time_s);

// A box that holds the platform at all times, if it lies in `rest` as modelled.
Aabb platform_reach(const Platform& platform, const Aabb& rest);

// Seconds after which the path begins anew; 0 for one that does not repeat or does not move.
double path_period(const Platform& platform);

}  // namespace slipface
