#include "start_room.h"

#include <algorithm>

#include "slipface/collision/filter.h"

namespace slipface {

namespace {

// The lowest height of the centre at which the feet are not in the terrain.
std::optional<double> lowest_centre(const MovementScene& scene, const MovementSettings& settings,
                                    const Vec3& centre) {
    if (scene.heightfield == nullptr || !settings.heightfield) return std::nullopt;
    const auto point = terrain_at(*scene.heightfield, centre.x(), centre.z());
    if (!point) return std::nullopt;
    return point->height + settings.radii.y();
}

template <class World>
bool overlaps_solid(const World& world, const Vec3& radii, const Vec3& centre) {
    if (!overlaps_any(world, radii, centre)) return false;
    QueryFilter two_sided;
    for (std::size_t i = 0; i < two_sided.ignored.size(); ++i)
        two_sided.ignored[i] = world.surface_rule(static_cast<SurfaceId>(i)).one_sided;
    return two_sided.ignored.none() || overlaps_any(world, radii, centre, two_sided);
}

}  // namespace

bool has_room(const MovementScene& scene, const MovementSettings& settings, const Vec3& radii,
              const Vec3& centre) {
    const auto lowest = lowest_centre(scene, settings, centre);
    if (lowest && centre.y() < *lowest - (settings.radii.y() - radii.y())) return false;
    if (overlaps_solid(scene.collision, radii, centre)) return false;
    return std::none_of(scene.platforms.begin(), scene.platforms.end(),
                        [&](const MovingPart& part) { return overlaps_solid(part.at_end(), radii, centre); });
}

bool fits(const MovementScene& scene, const MovementSettings& settings, const Vec3& centre) {
    const Vec3 radii = (settings.radii.array() - settings.skin).max(0.5 * settings.radii.array());
    return has_room(scene, settings, radii, centre);
}

std::optional<Vec3> drop(const MovementScene& scene, const MovementSettings& settings, const Vec3& centre,
                         double depth) {
    std::optional<Vec3> landed;
    const Vec3 move(0.0, -depth, 0.0);
    if (const auto contact = first_contact(scene, settings.radii, centre, move)) {
        // A skin away along the normal. On steep faces that would be far up, so the rise is limited.
        const double up = std::max(contact->normal.y(), 0.1);
        landed = centre + contact->t * move + Vec3(0.0, settings.skin / up, 0.0);
        landed->y() = std::min(landed->y(), centre.y());
    }
    const auto terrain = lowest_centre(scene, settings, centre);
    if (terrain && *terrain >= centre.y() - depth && *terrain <= centre.y() &&
        (!landed || *terrain > landed->y()))
        landed = Vec3(centre.x(), *terrain, centre.z());
    return landed;
}

}  // namespace slipface
