// A body of another size, with the feet where they were.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

// A mover that only asks: with this body, around this position.
Mover mover_with(const MovementScene& scene, const MovementSettings& settings, const PlayerState& state,
                 const Surroundings& around) {
    return Mover({.scene = scene, .settings = settings, .state = state}, around);
}

// Height of the centre above a plane of that normal that the ellipsoid touches, m, measured along Y.
double height_above(const Vec3& radii, const Vec3& normal) {
    return radii.cwiseProduct(normal).norm() / normal.y();
}

}  // namespace

std::optional<PlayerState> change_body(const MovementScene& scene, const MovementSettings& settings,
                                       const PlayerState& state, const Vec3& radii) {
    MovementSettings changed = settings;
    changed.radii = radii;
    const auto usable = [](const MovementSettings& s) {
        return is_finite(s) && s.radii.minCoeff() > 0.0 && s.skin > 0.0;
    };
    if (!usable(settings) || !usable(changed) || !state.position.allFinite() ||
        !state.ground_normal.allFinite())
        return std::nullopt;

    PlayerState start = state;
    start.position = position_in_scene(scene, state);
    // Terrain carries the lowest point of the player, and no other: it has no faces that a body could touch.
    const bool on_terrain = scene.heightfield != nullptr && state.ground_face == no_id;
    const bool on_ground = state.grounded && !on_terrain && state.ground_normal.y() > 0.1;
    const Vec3 normal = on_ground ? state.ground_normal : Vec3::UnitY();
    const double lift = height_above(radii, normal) - height_above(settings.radii, normal);
    const Vec3 move(0.0, lift, 0.0);
    const double reach = std::abs(lift) + settings.skin;

    // The centre's path is swept by the body that it is free for at its start: up by the old, down by the
    // new.
    const Surroundings around_before(scene, settings, start.position, reach);
    const Surroundings around_after(scene, changed, start.position, reach);
    Mover before = mover_with(scene, settings, start, around_before);
    Mover after = mover_with(scene, changed, start, around_after);
    Vec3 end = start.position + move;
    if (lift > 0.0) {
        if (sweep_scene(before, start.position, move)) return std::nullopt;
    } else if (lift < 0.0) {
        if (overlaps_scene(after, start.position)) return std::nullopt;
        end = sweep_with_skin(after, Pass::probe, 0, move).reached;
    }
    if (!end.allFinite() || overlaps_scene(after, end)) return std::nullopt;
    PlayerState result = state;
    put_in_scene(scene, end, result);
    return result;
}

}  // namespace slipface
