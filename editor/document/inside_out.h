// Tests whether a level is made of rooms: its faces look inwards, so that only their backs are seen from
// outside.
#pragma once

#include "slipface/collision/collision_world.h"

namespace slipface {

// True if, seen from at least four of the six sides, three quarters of the visible area are backs of faces. A
// closed room is like that, also without a ceiling. A floor, a terrain and a solid body are not.
bool is_made_of_rooms(const CollisionWorld& world);

// For a level made of rooms: true if the eye is in none of them. Outside the bounds it always is; inside, it
// is if most of the faces around the eye show their backs.
bool is_outside_rooms(const CollisionWorld& world, const Vec3& eye);

}  // namespace slipface
