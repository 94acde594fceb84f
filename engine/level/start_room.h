// Whether there is room for a player, and what is below, for all that looks for a place to begin.
#pragma once

#include "slipface/collision/collision_world.h"
#include "slipface/movement/settings.h"
#include "slipface/movement/step.h"

namespace slipface {

// The first that the ellipsoid touches on its way: what stands still, or a platform.
std::optional<Contact> first_contact(const MovementScene& scene, const Vec3& radii, const Vec3& from,
                                     const Vec3& move);
// The ellipsoid at `centre` overlaps no solid, two-sided triangle and reaches not below the terrain.
bool has_room(const MovementScene& scene, const MovementSettings& settings, const Vec3& radii,
              const Vec3& centre);
// Room but for the skin: what rests on a floor, or was put there by hand, has it.
bool fits(const MovementScene& scene, const MovementSettings& settings, const Vec3& centre);
// The centre after falling by at most `depth` metres onto what is below, a skin above it. Nothing: there is
// nothing.
std::optional<Vec3> drop(const MovementScene& scene, const MovementSettings& settings, const Vec3& centre,
                         double depth);

}  // namespace slipface
