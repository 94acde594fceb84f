#include "document/inside_out.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slipface {
namespace {

constexpr int rays_across = 20;  // per side, in both directions
constexpr int sides_of_rooms = 4;
constexpr int rays_around = 48;

struct Seen {
    int fronts = 0, backs = 0;
    void add(const std::optional<RayHit>& hit) {
        if (hit) ++(hit->back_face ? backs : fronts);
    }
    bool mostly_backs() const { return backs > fronts; }
    // A terrain seen from the side shows as many backs as fronts.
    bool nearly_all_backs() const { return backs > 3 * fronts; }
};

}  // namespace

bool is_made_of_rooms(const CollisionWorld& world) {
    const Aabb bounds = world.bounds();
    if (bounds.empty()) return false;
    const Vec3 min = bounds.min, size = bounds.size();
    int sides = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        // In front of the level and behind it, in units of its extent along the axis.
        for (const double from : {-0.5, 1.5}) {
            Vec3 direction = Vec3::Zero();
            direction[axis] = from < 0.0 ? 1.0 : -1.0;
            Seen seen;
            for (int i = 0; i < rays_across * rays_across; ++i) {
                Vec3 origin;
                origin[axis] = min[axis] + from * std::max(size[axis], 1.0);
                origin[u] = min[u] + size[u] * (i % rays_across + 0.5) / rays_across;
                origin[v] = min[v] + size[v] * (i / rays_across + 0.5) / rays_across;
                seen.add(cast_ray(world, origin, direction));
            }
            if (seen.nearly_all_backs()) ++sides;
        }
    }
    return sides >= sides_of_rooms;
}

bool is_outside_rooms(const CollisionWorld& world, const Vec3& eye) {
    const Aabb bounds = world.bounds();
    if ((eye.array() < bounds.min.array()).any() || (eye.array() > bounds.max.array()).any()) return true;
    // Evenly over a sphere: points of a spiral, each rotated by the golden angle.
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    Seen seen;
    for (int i = 0; i < rays_around; ++i) {
        const double y = 1.0 - 2.0 * (i + 0.5) / rays_around, across = std::sqrt(1.0 - y * y);
        const double turn = golden_angle * i;
        seen.add(cast_ray(world, eye, Vec3(across * std::cos(turn), y, across * std::sin(turn))));
    }
    return seen.mostly_backs();
}

}  // namespace slipface
