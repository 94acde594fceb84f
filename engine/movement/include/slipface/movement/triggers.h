// Triggers: places that report when a player enters, stays and leaves.
#pragma once

#include <array>

#include "slipface/movement/events.h"

namespace slipface {

// A trigger is what is not solid: the faces of a type with `solid` off, of the level or of a platform. The
// body is in it while it touches one of those faces or, where they are closed and wound outwards, while its
// centre is inside. All faces of a type in the level are one trigger, and those of a type in a platform, so a
// sheet of many triangles reports once; triggers differ by their types or platforms. A trigger
// moves as a platform does.
struct TriggerKey {
    std::uint32_t platform = no_id;
    SurfaceId surface = default_surface;
    friend bool operator==(const TriggerKey&, const TriggerKey&) = default;
};

// Which triggers a player is in. It belongs to the player as its PlayerState does: a rollback copies both.
struct TriggerMemory {
    static constexpr std::size_t capacity = 8;
    std::array<TriggerKey, capacity> inside{};
    std::uint32_t count = 0;
};

// What the way of the body `radii` from `from` to `to`, in the scene's coordinates, entered, stayed in and
// left: a trigger that it passes within one step is entered, and left in the next one. Triggers beyond
// the memory's capacity are not reported. Honours the scene's filter. Writes as many events as `out` holds
// and returns the total; allocates nothing. Costs one overlap, one sweep and, per type that is not solid, a
// few rays; nothing where every type is solid.
std::size_t track_triggers(const MovementScene& scene, const Vec3& radii, const Vec3& from, const Vec3& to,
                           TriggerMemory& memory, std::span<StepEvent> out);

}  // namespace slipface
