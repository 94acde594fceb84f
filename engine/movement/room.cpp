// Where a body has room: outside of everything, and not inside a solid that it does not touch.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

struct Direction {
    signed char x, y, z;
    Vec3 unit() const { return direction_of(Vec3(x, y, z)); }
};
// Among equally near places the order is up, the sides, down, then two and three axes at once.
constexpr std::array<Direction, 26> directions{
    {{0, 1, 0},   {1, 0, 0},   {-1, 0, 0},  {0, 0, 1},   {0, 0, -1},  {0, -1, 0}, {1, 1, 0},
     {-1, 1, 0},  {0, 1, 1},   {0, 1, -1},  {1, 0, 1},   {1, 0, -1},  {-1, 0, 1}, {-1, 0, -1},
     {1, -1, 0},  {-1, -1, 0}, {0, -1, 1},  {0, -1, -1}, {1, 1, 1},   {1, 1, -1}, {-1, 1, 1},
     {-1, 1, -1}, {1, -1, 1},  {1, -1, -1}, {-1, -1, 1}, {-1, -1, -1}}};

// Longer than any solid that a player is put into.
constexpr double far_away = 1e4;

}  // namespace

bool in_solid(const Mover& mover, const Vec3& centre) {
    std::size_t backs = 0;
    for (const Direction& d : directions) {
        const auto hit = ray_in_scene(mover, centre, far_away * d.unit());
        if (!hit) return false;
        backs += hit->back_face ? 1 : 0;
    }
    // Not all: a solid mostly stands on something whose front is where its own back is.
    return 2 * backs > directions.size();
}

namespace {

// Whether what is at `to` is outside of the solid around `from`, and above ground: below the floor that a
// solid stands on is no place for a player.
bool leads_out(const Mover& mover, const Vec3& from, const Vec3& to) {
    const auto back = ray_in_scene(mover, to, from - to);
    const auto ground = ray_in_scene(mover, to, -far_away * Vec3::UnitY());
    return back && !back->back_face && ground && !ground->back_face && !in_solid(mover, to);
}

}  // namespace

std::optional<Vec3> nearest_room(const Mover& mover, double farthest, int rings) {
    const Vec3& from = mover.position;
    const bool enclosed = in_solid(mover, from);
    for (int ring = 1; ring <= rings; ++ring) {
        for (const Direction& d : directions) {
            const Vec3 offset = farthest * ring / rings * d.unit(), to = from + offset;
            if (overlaps_scene(mover, to)) continue;
            const auto crossed = ray_in_scene(mover, from, offset);
            if (crossed && !enclosed) continue;
            if (enclosed && !leads_out(mover, from, to)) continue;
            return to;
        }
    }
    return std::nullopt;
}

std::optional<PlayerState> put_player(const MovementScene& scene, const MovementSettings& settings,
                                      const PlayerState& state, double farthest) {
    if (!is_finite(settings) || !(settings.radii.minCoeff() > 0.0) || !(settings.skin > 0.0) ||
        !state.position.allFinite() || !std::isfinite(farthest))
        return std::nullopt;
    PlayerState put = state;
    put.position = position_in_scene(scene, state);
    const Surroundings around(scene, settings, put.position, settings.radii.maxCoeff());
    const Mover mover({.scene = scene, .settings = settings, .state = put}, around);
    Vec3 at = put.position;
    if (overlaps_scene(mover, at) || in_solid(mover, at)) {
        constexpr double most = 200.0;
        const double rings = std::ceil(8.0 * farthest / settings.radii.minCoeff());
        const auto room =
            nearest_room(mover, std::max(0.0, farthest), static_cast<int>(std::clamp(rings, 1.0, most)));
        if (!room) return std::nullopt;
        at = *room;
    }
    PlayerState free{.jump_held = state.jump_held};
    put_in_scene(scene, at, free);
    return free;
}

}  // namespace slipface
