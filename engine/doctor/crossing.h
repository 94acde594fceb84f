// Whether a player can walk past a position, tested with the level's own movement.
#pragma once

#include <functional>

#include "checks.h"

namespace slipface::doctor {

enum class Passage : std::uint8_t {
    unknown,  // no walker can start, end or be expected there: no floor, or an obstacle
    passes,
    catches,  // the walker stops, or needs more than about twice the usual time
    falls,    // through the floor
};

// Walks from `position` - `before` * `heading` to `position` + `after` * `heading` (`heading`: x and z, unit;
// metres) with the level's settings at its walking speed. Unknown unless the same path, a little higher than
// both ends, is free: then only geometry at the feet can stop the walker. Platforms rest and sectors are off.
Passage cross(const Patient& patient, const Vec3& position, const Vec2& heading, double before, double after);

// The same between two positions on the ground, straight as seen from above.
Passage cross_between(const Patient& patient, const Vec3& from, const Vec3& to);

// The same upwards: unknown, too, where the walker would not begin lower than it is to end.
Passage climb_between(const Patient& patient, const Vec3& low, const Vec3& high);

// The worst of the passages in 72 headings.
Passage cross_all_directions(const Patient& patient, const Vec3& position);

// The body fits through a hole at `position`, which has floor all round.
bool drops_through(const Patient& patient, const Vec3& position);

// True if there is a heading in which a player at `centre`, pushed for a second, gets stuck: in the next two
// seconds neither the stick in any direction nor a jump frees the player.
bool wedges(const Patient& patient, const Vec3& centre);

// Calls try_one(patient, i) for i from 0, in parallel, until all of `count` are tried or they have cost some
// seconds of processor time, which Patient::effort counts, for each on its own. try_one returns false if one
// took too much to find out. Returns how many are left untried, on any number of threads the same.
std::size_t try_in_turn(const Patient& patient, std::size_t count,
                        const std::function<bool(const Patient&, std::size_t)>& try_one);

}  // namespace slipface::doctor
