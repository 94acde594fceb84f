// Queries of a whole movement scene, without the rules of a step.
#pragma once

#include <optional>

#include "slipface/collision/contact.h"
#include "slipface/movement/scene.h"

namespace slipface {

// The first contact of the ellipsoid `radii` moving from `from` by `move`, m, with static geometry and the
// platforms; nothing if there is none.
std::optional<Contact> first_contact(const MovementScene& scene, const Vec3& radii, const Vec3& from,
                                     const Vec3& move);

// CollisionWorld::crowd_in() of all of them together.
std::size_t crowd_in(const MovementScene& scene, const Aabb& box);

}  // namespace slipface
