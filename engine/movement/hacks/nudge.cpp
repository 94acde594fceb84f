// Problem: a player that spawned inside geometry never moves again.
// Hack (lecture, "Case study: Quake 2"): tries small offsets along all three axes and takes the nearest free
// one. Among equally near ones the order is up, the sides, down, then two and three axes at once.
#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

constexpr int rings = 8;  // how many distances up to the farthest are tried

struct Direction {
    signed char x, y, z;
};
constexpr std::array<Direction, 26> directions{
    {{0, 1, 0},   {1, 0, 0},   {-1, 0, 0},  {0, 0, 1},   {0, 0, -1},  {0, -1, 0}, {1, 1, 0},
     {-1, 1, 0},  {0, 1, 1},   {0, 1, -1},  {1, 0, 1},   {1, 0, -1},  {-1, 0, 1}, {-1, 0, -1},
     {1, -1, 0},  {-1, -1, 0}, {0, -1, 1},  {0, -1, -1}, {1, 1, 1},   {1, 1, -1}, {-1, 1, 1},
     {-1, 1, -1}, {1, -1, 1},  {1, -1, -1}, {-1, -1, 1}, {-1, -1, -1}}};

}  // namespace

bool nudge(Mover& mover) {
    const double farthest = mover.settings.nudge_distance;
    if (!overlaps_scene(mover, mover.position)) {
        decide(mover, Decision::nudge_needless);
        return true;
    }
    for (int ring = 1; ring <= rings; ++ring) {
        const double distance = farthest * ring / rings;
        for (const Direction& d : directions) {
            const Vec3 offset = distance * direction_of(Vec3(d.x, d.y, d.z));
            const Vec3 to = mover.position + offset;
            if (overlaps_scene(mover, to) || ray_in_scene(mover, mover.position, offset)) continue;
            decide(mover, Decision::nudged, {.value = distance, .limit = farthest});
            mover.position = to;
            return true;
        }
    }
    decide(mover, Decision::nudge_failed, {.value = farthest});
    return false;
}

}  // namespace slipface
