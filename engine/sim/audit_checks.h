// How an audit judges one tick of a walker.
#pragma once

#include <optional>

#include "slipface/movement/step.h"

namespace slipface {

struct CheckFailure {
    double amount = 0.0;
    FaceId face = no_id;
};

// The centre went through a solid, two-sided triangle on its way from `before` to `after`. A straight line
// between the two that meets one is not proof yet, because a step bends at contacts and lifts over edges:
// then the step is made again with its trace, and it passed through only if neither the traced way nor a way
// over the top is free. Metres done.
std::optional<CheckFailure> passed_through(const MovementScene& scene, const MovementSettings& settings,
                                           const PlayerState& before, const PlayerInput& input, double dt,
                                           const Vec3& after);

// The ellipsoid, smaller by the skin, overlaps a solid, two-sided triangle. Depth in shares of the radii.
std::optional<CheckFailure> overlaps_deeply(const MovementScene& scene, const MovementSettings& settings,
                                            const Vec3& position);

// Somewhere between straight on and `max_slope` upwards the ellipsoid could move 5 cm along `heading` (x, z).
bool way_is_free(const MovementScene& scene, const MovementSettings& settings, const Vec3& position,
                 const Vec2& heading);

// No ray from `from` leaves the level: checked in 1026 directions.
bool level_is_closed(const CollisionWorld& world, const Vec3& from);

}  // namespace slipface
