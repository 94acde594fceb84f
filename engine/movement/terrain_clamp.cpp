// Problem: terrain given as heights has no triangles to collide with; the player falls through it.
// Hack (lecture, "Easy collision response against a heightfield"): y = max(y, terrain(x, z)) for the feet.
//
// The player stands on terrain as on any ground, and slides where it is steeper than max_slope. The lift is
// swept: under a bridge close above the terrain there may be no room, and then the step is refused.
#include "mover.h"

namespace slipface {

bool clamp_to_terrain(Mover& mover, const Vec3& from) {
    const Heightfield* const field = mover.scene.heightfield;
    if (field == nullptr) return true;
    const std::optional<TerrainPoint> ground = terrain_at(*field, mover.position.x(), mover.position.z());
    if (!ground) return true;
    const double least = ground->height + mover.settings.radii.y();
    const double missing = least - mover.position.y();
    if (!mover.settings.heightfield) {
        if (missing > 0.0) decide(mover, Decision::terrain_off, {.value = missing});
        return true;
    }
    const bool walkable = ground->normal.y() >= mover.walkable_cosine;
    const auto stand = [&](Decision outcome) {
        if (is_held(mover)) return;
        if (walkable) {
            mover.grounded = true;
            mover.velocity.y() = 0.0;
            mover.bounced = false;
        } else {
            mover.velocity = slide_along(mover.velocity, ground->normal);
        }
        mover.support = {.normal = ground->normal};
        mover.support_rise = 0.0;
        decide(mover, outcome, {.value = missing});
    };
    // Going down a slope the terrain falls away under the feet; snap to floor applies to it, too.
    const double near =
        mover.settings.snap_down && mover.was_grounded && !mover.jumped ? mover.settings.snap_distance : 0.0;
    if (missing < -near || (missing < 0.0 && (mover.grounded || !walkable))) {
        decide(mover, Decision::terrain_above, {.value = -missing});
        return true;
    }
    if (missing != 0.0) {
        // Steep terrain is a wall to a player that walks into it.
        const bool uphill =
            from.y() < least && !walkable && (mover.position - from).dot(ground->normal) < 0.0;
        if (uphill) {
            const std::optional<TerrainPoint> back = terrain_at(*field, from.x(), from.z());
            if (back && from.y() >= back->height + mover.settings.radii.y() &&
                mover.position.y() <= from.y()) {
                mover.position = from;
                mover.velocity = slide_along(mover.velocity, ground->normal);
                decide(mover, Decision::terrain_wall,
                       {.value = ground->normal.y(), .limit = mover.walkable_cosine});
                return true;
            }
        }
        const Vec3 lift(0.0, missing, 0.0);
        if (sweep_scene(mover, mover.position, lift)) {
            decide(mover, Decision::terrain_no_room, {.value = missing});
            return missing < 0.0;
        }
        mover.position += lift;
    }
    stand(walkable ? Decision::terrain_stood : Decision::terrain_slid);
    return true;
}

}  // namespace slipface
