#include "fell_short.h"

#include <algorithm>
#include <cmath>

namespace slipface {

// Ground is looked for this far ahead, in such steps, and this far above the take-off.
constexpr double ahead_m = 4.0, apart_m = 0.02, above_m = 3.0;
// Who did not come up by this much did not jump.
constexpr double least_rise_m = 0.1;

std::optional<FellShort> fell_short(const TickScene& scene, const TapeRun& run, std::size_t left,
                                    std::size_t end) {
    if (left == 0 || left >= end || end > run.samples().size()) return std::nullopt;
    const MovementSettings settings = run.settings_at(left);
    const auto at = [&](std::size_t tick) { return run.samples()[tick].position; };
    const double ground = at(left - 1).y();
    double highest = ground;
    std::size_t tick = left;
    for (; tick < end && (at(tick).y() >= ground || highest == ground); ++tick)
        highest = std::max(highest, at(tick).y());
    if (tick >= end || highest < ground + least_rise_m) return std::nullopt;
    Vec3 way = at(tick) - at(left - 1);
    way.y() = 0.0;
    if (!(way.norm() > least_rise_m)) return std::nullopt;
    way.normalize();

    const MovementScene now = scene.at(tick, run.dt());
    const Vec3 offset = position_in_scene(now, run.state_before(scene, tick)) - at(tick - 1);
    const double feet = settings.radii.y();
    const double down = above_m + settings.step_height;
    for (double ahead = apart_m; ahead < ahead_m; ahead += apart_m) {
        Vec3 from = at(tick) + ahead * way;
        from.y() = ground - feet + above_m;
        const auto hit =
            cast_ray(now.collision, from + offset, Vec3(0.0, -1.0, 0.0), down, RayStops::as_movement);
        if (!hit || hit->t == 0.0) continue;
        return FellShort{hit->face, ahead, from.y() - hit->t - (highest - feet)};
    }
    return std::nullopt;
}

}  // namespace slipface
