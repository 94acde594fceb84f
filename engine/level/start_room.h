// Tests for room and floor at a possible start of a player.
#pragma once

#include <algorithm>

#include "slipface/collision/collision_world.h"
#include "slipface/movement/first_contact.h"
#include "slipface/movement/settings.h"
#include "slipface/movement/step.h"

namespace slipface {

// Whether the ellipsoid at `centre` overlaps no solid, two-sided triangle and is not below the terrain.
bool has_room(const MovementScene& scene, const MovementSettings& settings, const Vec3& radii,
              const Vec3& centre);
// has_room() for a player smaller by the skin: a player who rests on a floor fits.
bool fits(const MovementScene& scene, const MovementSettings& settings, const Vec3& centre);
// The centre after falling by at most `depth` metres, about a skin above the floor. Nothing: there is no
// floor so near.
std::optional<Vec3> drop(const MovementScene& scene, const MovementSettings& settings, const Vec3& centre,
                         double depth);

// What a search may look at. Where very many triangles lie in one place, which boxes do not tell apart, it
// would take minutes; what it then finds depends on the level alone.
class SearchEffort {
  public:
    // Before a few queries that look at so many triangles each. False: the search should end without them.
    bool spend(std::size_t crowd) {
        if (left_ == 0) return false;
        left_ -= std::min(left_, crowd);
        return true;
    }

  private:
    std::size_t left_ = 100'000'000;
};

}  // namespace slipface
