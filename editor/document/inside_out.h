// Whether a level is made of rooms: its faces look inwards, so that from outside one sees their backs alone.
#pragma once

#include "slipface/collision/collision_world.h"

namespace slipface {

// From at least four of the six sides three quarters of what can be seen of the level are backs of faces. A
// closed room is like that, and one without a ceiling; a floor, a terrain and a solid body are not.
bool is_made_of_rooms(const CollisionWorld& world);

// Of a level made of rooms: the eye is in none of them. Outside the bounds it is so; inside them it is where
// most of the faces around the eye show their backs.
bool is_outside_rooms(const CollisionWorld& world, const Vec3& eye);

}  // namespace slipface
