// Whether a player gets past a place: the level's own movement walks there and says so.
#pragma once

#include "checks.h"

namespace slipface::doctor {

enum class Passage : std::uint8_t {
    unknown,  // no walker can begin, end or be expected there: nothing to stand on, or something in the way
    passes,
    catches,  // comes to a stop, or loses more time than the way takes twice
    falls,    // through the floor
};

// Walks from `place` - `before` * `heading` to `place` + `after` * `heading` (horizontal, unit; metres), with
// the level's settings at its walking speed, where the same way a little higher than both ends is free: what
// stops the walker then is what lies at his feet. Platforms rest and sectors are off.
Passage cross(const Patient& patient, const Vec3& position, const Vec2& heading, double before, double after);

// The same between two places on the ground; the way is the straight one, seen from above.
Passage cross_between(const Patient& patient, const Vec3& from, const Vec3& to);

// The worst of the passages in 72 headings.
Passage cross_all_directions(const Patient& patient, const Vec3& position);

// A body at `centre` that is pushed in some heading for a second stays there for the next two, whichever way
// the stick points, and a jump does not help.
bool wedges(const Patient& patient, const Vec3& centre);

}  // namespace slipface::doctor
