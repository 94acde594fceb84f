// How an audit judges one tick of a walker.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "slipface/movement/step.h"

namespace slipface {

struct CheckFailure {
    double amount = 0.0;
    FaceId face = no_id;
};

// What a check looks at.
enum class Against : std::uint8_t { everything, what_stands_still };

// Where each platform of a tick takes who rides it. The same for all walkers, so it is asked once a tick.
std::vector<Pose> rides_of(std::span<const MovingPart> platforms);

// The centre went through a solid triangle on its way from `before` to `after` (scene
// coordinates), of what stands still or of a platform. A platform is asked in its own frame: there the centre
// sets out from where a rider would have been carried to. A straight line that meets a triangle is not proof
// yet, because a step bends at contacts and lifts over edges: then the step is made again with its trace, and
// it passed through only if neither the traced way nor a way over the top is free. A one-sided triangle stops
// nobody from behind. `rides`: rides_of the scene's platforms. Metres done.
std::optional<CheckFailure> passed_through(const MovementScene& scene, std::span<const Pose> rides,
                                           const MovementSettings& settings, const PlayerState& before,
                                           const PlayerInput& input, double dt, const Vec3& after,
                                           Against against = Against::everything);

// The ellipsoid, smaller by the skin, overlaps a solid, two-sided triangle. Depth in fractions of the radii.
std::optional<CheckFailure> overlaps_deeply(const MovementScene& scene, const MovementSettings& settings,
                                            const Vec3& position, Against against = Against::everything);

// Somewhere between straight on and `max_slope` upwards the ellipsoid could move 5 cm along `heading` (x, z).
bool path_is_free(const MovementScene& scene, const MovementSettings& settings, const Vec3& position,
                  const Vec2& heading);

// The first that the ellipsoid touches on its way, standing still or a platform.
std::optional<Contact> first_touch(const MovementScene& scene, const Vec3& radii, const Vec3& from,
                                   const Vec3& move);

// No ray from `from` leaves the level: checked in 1026 directions.
bool level_is_closed(const CollisionWorld& world, const Vec3& from);

}  // namespace slipface
