#include "slipface/level/platform.h"

#include <algorithm>
#include <cmath>

namespace slipface {

namespace {

constexpr double slowest = 1e-3;  // m/s

double pause_at(const PathPoint& point) {
    return std::max(point.pause_s, 0.0);
}

double path_time(const PathPoint& from, const PathPoint& to, double speed) {
    return (to.offset - from.offset).norm() / std::max(speed, slowest);
}

// The legs of a path in the order of motion, from point 0 on. Ping-pong appends the reverse legs.
struct Legs {
    const std::vector<PathPoint>& path;
    PathRepeat repeat;

    std::size_t count() const {
        const std::size_t n = path.size();
        if (n < 2) return 0;
        return repeat == PathRepeat::loop ? n : repeat == PathRepeat::once ? n - 1 : 2 * (n - 1);
    }
    const PathPoint& from(std::size_t leg) const { return path[index(leg)]; }
    const PathPoint& to(std::size_t leg) const { return path[index(leg + 1)]; }
    // A reverse leg is as fast as the forward one.
    double speed(std::size_t leg) const {
        return leg < path.size() - 1 || repeat != PathRepeat::ping_pong ? from(leg).speed : to(leg).speed;
    }
    double time(std::size_t leg) const {
        return pause_at(from(leg)) + path_time(from(leg), to(leg), speed(leg));
    }

  private:
    std::size_t index(std::size_t step) const {
        const std::size_t n = path.size();
        if (repeat != PathRepeat::ping_pong) return step % n;
        const std::size_t at = step % (2 * (n - 1));
        return at < n ? at : 2 * (n - 1) - at;
    }
};

Vec3 path_offset(const Platform& platform, double time_s) {
    if (platform.path.empty()) return Vec3::Zero();
    const Legs legs{platform.path, platform.repeat};
    const double period = path_period(platform);
    double left = period > 0.0 ? std::fmod(time_s, period) : time_s;
    for (std::size_t leg = 0; leg < legs.count(); ++leg) {
        const double whole = legs.time(leg);
        if (left < whole) {
            const PathPoint& from = legs.from(leg);
            const PathPoint& to = legs.to(leg);
            const double moving = left - pause_at(from);
            if (moving <= 0.0) return from.offset;
            return from.offset + (to.offset - from.offset) * (moving / (whole - pause_at(from)));
        }
        left -= whole;
    }
    return legs.count() == 0 ? platform.path.front().offset : legs.to(legs.count() - 1).offset;
}

}  // namespace

double path_period(const Platform& platform) {
    if (platform.repeat == PathRepeat::once) return 0.0;
    const Legs legs{platform.path, platform.repeat};
    double period = 0.0;
    for (std::size_t leg = 0; leg < legs.count(); ++leg)
        period += legs.time(leg);
    return period;
}

Aabb platform_reach(const Platform& platform, const Aabb& rest) {
    if (rest.empty()) return rest;
    Aabb still = rest;
    if (platform.spin_rate != 0.0) {  // a ball around the pivot contains every rotation
        const Vec3 far =
            (rest.min - platform.spin_pivot).cwiseAbs().cwiseMax((rest.max - platform.spin_pivot).cwiseAbs());
        const Vec3 radius = Vec3::Constant(far.norm());
        still = {platform.spin_pivot - radius, platform.spin_pivot + radius};
    }
    if (platform.path.empty()) return still;
    Aabb reach;
    for (const PathPoint& point : platform.path) {
        reach.add(still.min + point.offset);
        reach.add(still.max + point.offset);
    }
    return reach;
}

Pose platform_pose(const Platform& platform, double time_s) {
    const double time = std::max(time_s, 0.0) + std::max(platform.phase_s, 0.0);
    return rotation_about(platform.spin_pivot, platform.spin_axis, platform.spin_rate * time,
                          path_offset(platform, time));
}

}  // namespace slipface
