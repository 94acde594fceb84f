// What is beside a player in the air: the nearest face that is upright enough to slide down and to jump off.
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

// Within 30 degrees of upright, as ladders have it.
constexpr double upright = 0.5;

}  // namespace

std::optional<Wall> wall_beside(const Mover& mover, double reach) {
    const Vec3 grown = mover.settings.radii + Vec3(reach, 0.0, reach);
    std::array<SceneOverlap, 32> found;
    const std::size_t count = touched_in_scene(mover, grown, mover.position, found);
    const SceneOverlap* nearest = nullptr;
    for (std::size_t i = 0; i < count; ++i) {
        const SceneOverlap& one = found[i];
        if (std::abs(one.normal.y()) > upright) continue;
        const SeenWorld world = world_of(mover, one.platform);
        // From behind a one-sided face is air.
        if (world.surface_rule(one.surface).one_sided &&
            world.triangle_normal(one.triangle).dot(one.normal) < 0.0)
            continue;
        if (nearest == nullptr || one.depth_sphere_space > nearest->depth_sphere_space) nearest = &one;
    }
    if (nearest == nullptr) return std::nullopt;
    return Wall{.out = direction_of(horizontal(nearest->normal)),
                .support = {nearest->normal, nearest->face, nearest->surface, nearest->platform}};
}

bool touches_wall(const PlayerState& state) {
    return !is_held(state) && state.ground_face != no_id && std::abs(state.ground_normal.y()) <= upright;
}

double push_into(const Mover& mover, const Wall& wall) {
    return -direction_of(Vec3(mover.wish.x(), 0.0, mover.wish.y())).dot(wall.out);
}

}  // namespace slipface
