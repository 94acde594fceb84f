// The checks that an audit applies to one tick of a walker.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "slipface/movement/step.h"

namespace slipface {

struct CheckFailure {
    double amount = 0.0;  // see the check
    FaceId face = no_id;
};

// The geometry that a check considers.
enum class Against : std::uint8_t { everything, what_stands_still };

// [platform] the motion of a rider of each platform in a tick. The same for all walkers, so it is computed
// once per tick.
std::vector<Pose> rides_of(std::span<const MovingPart> platforms);

// Fails if the centre went through a solid triangle, static or of a platform, on its path from `before` to
// `after` (scene coordinates). For a platform the path starts where a rider would have been carried to. A
// straight line that hits a triangle is no proof, because a step bends at contacts and lifts over edges. Then
// the step is simulated again with its trace; the check fails only if neither the traced path nor a path over
// the top is free. One-sided triangles are passable from behind. `rides`: rides_of() the scene's platforms.
// CheckFailure::amount: metres moved.
std::optional<CheckFailure> passed_through(const MovementScene& scene, std::span<const Pose> rides,
                                           const MovementSettings& settings, const PlayerState& before,
                                           const PlayerInput& input, double dt, const Vec3& after,
                                           Against against = Against::everything);

// Fails if the ellipsoid, smaller by the skin, overlaps a solid, two-sided triangle. CheckFailure::amount:
// the largest depth, as a fraction of the radii.
std::optional<CheckFailure> overlaps_deeply(const MovementScene& scene, const MovementSettings& settings,
                                            const Vec3& position, Against against = Against::everything);

// Whether the ellipsoid could move 5 cm along `heading` (x, z), either horizontally, or up the full or half
// the rise of `max_slope`.
bool path_is_free(const MovementScene& scene, const MovementSettings& settings, const Vec3& position,
                  const Vec2& heading);

// Whether no ray from `from` leaves the level: checked in 866 directions.
bool level_is_closed(const CollisionWorld& world, const Vec3& from);

}  // namespace slipface
