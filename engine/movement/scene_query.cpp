// The scene as one thing to collide with: what stands still, and the platforms where this tick ends.
#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

// Above the rounding of boxes and of sweeps, as a fraction of the lengths involved.
constexpr double box_slack = 1e-5;

bool holds(const Aabb& box, const Vec3& point) {
    return (point.array() >= box.min.array()).all() && (point.array() <= box.max.array()).all();
}

// Calls visit(world, platform, triangles) for everything that a player can touch between `from` and `from` +
// `move`. What stands still is a Neighbourhood.
template <class Visit>
void each_world(const Mover& mover, const Vec3& from, const Vec3& move, Visit&& visit) {
    visit(mover.around.near, no_id, mover.scene.triangles);
    const auto platforms = static_cast<std::uint32_t>(mover.scene.platforms.size());
    if (platforms == 0) return;
    const NearPlatforms& near = mover.around.platforms;
    const bool listed =
        near.count <= NearPlatforms::capacity && holds(near.room, from) && holds(near.room, from + move);
    const auto count = listed ? static_cast<std::uint32_t>(near.count) : platforms;
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t i = listed ? near.list[k] : k;
        const MovingPart& part = mover.scene.platforms[i];
        if (i != mover.ignored_platform) visit(*part.collision, i, part.triangles);
    }
}

TriangleId number_in_mesh(TriangleId triangle, std::span<const TriangleId> triangles) {
    return triangle < triangles.size() ? triangles[triangle] : triangle;
}

// The order of CollisionWorld: smallest t, then face before edge before corner, then the lowest triangle.
bool earlier(const Contact& a, const Contact& b) {
    if (a.t != b.t) return a.t < b.t;
    if (a.feature != b.feature) return a.feature < b.feature;
    return a.triangle < b.triangle;
}

}  // namespace

NearPlatforms platforms_near(const MovementScene& scene, const Vec3& radii, const Vec3& from,
                             const Vec3& reach) {
    NearPlatforms near;
    near.room.min = from - reach;
    near.room.max = from + reach;
    if (scene.platforms.empty()) return near;
    const Vec3 slack = radii + box_slack * (radii + reach) + 1e-12 * from.cwiseAbs();
    for (std::uint32_t i = 0; i < scene.platforms.size(); ++i) {
        const Aabb bounds = scene.platforms[i].collision->bounds();
        const bool beside = ((near.room.min - slack).array() > bounds.max.array()).any() ||
                            ((near.room.max + slack).array() < bounds.min.array()).any();
        if (beside) continue;
        if (near.count < NearPlatforms::capacity) near.list[near.count] = i;
        ++near.count;
    }
    return near;
}

const CollisionWorld& world_of(const Given& given, std::uint32_t platform) {
    return platform < given.scene.platforms.size() ? *given.scene.platforms[platform].collision
                                                   : given.scene.collision;
}

std::optional<SceneContact> sweep_scene(Mover& mover, const Vec3& from, const Vec3& move) {
    ++mover.sweeps;
    std::optional<SceneContact> best;
    each_world(mover, from, move,
               [&](const auto& world, std::uint32_t platform, std::span<const TriangleId> triangles) {
                   std::optional<Contact> contact = sweep_ellipsoid(world, mover.settings.radii, from, move);
                   if (!contact) return;
                   // The numbers in the world are wanted by the seam filter, those of the mesh by everybody
                   // else.
                   const TriangleId triangle = contact->triangle;
                   double depth = 0.0;
                   if (!mover.began_free && contact->feature != Feature::interior)
                       depth = filter_seam(mover, from + contact->t * move, platform, *contact);
                   const bool back =
                       mover.trace != nullptr && contact->feature == Feature::interior &&
                       world_of(mover, platform).triangle_normal(contact->triangle).dot(contact->normal) <
                           0.0;
                   contact->triangle = number_in_mesh(contact->triangle, triangles);
                   if (!best || earlier(*contact, best->contact))
                       best = SceneContact{*contact, triangle, platform, depth, back};
               });
    return best;
}

std::size_t overlaps_in_scene(const Mover& mover, const Vec3& centre, std::span<Overlap> out) {
    std::size_t count = 0;
    each_world(mover, centre, Vec3::Zero(),
               [&](const auto& world, std::uint32_t, std::span<const TriangleId> triangles) {
                   const std::span<Overlap> room = out.subspan(count);
                   const std::size_t found =
                       std::min(find_overlaps(world, mover.settings.radii, centre, room), room.size());
                   for (Overlap& overlap : room.first(found))
                       overlap.triangle = number_in_mesh(overlap.triangle, triangles);
                   count += found;
               });
    return count;
}

bool is_free(const Mover& mover, const Vec3& centre) {
    bool free = true;
    each_world(mover, centre, Vec3::Zero(),
               [&](const auto& world, std::uint32_t, std::span<const TriangleId>) {
                   free = free && !overlaps_any(world, mover.settings.radii, centre);
               });
    return free;
}

// One-sided faces let the player through from behind, so being across one is legal.
bool overlaps_scene(const Mover& mover, const Vec3& centre) {
    bool found = false;
    each_world(mover, centre, Vec3::Zero(),
               [&](const auto& world, std::uint32_t platform, std::span<const TriangleId>) {
                   if (found || !overlaps_any(world, mover.settings.radii, centre)) return;
                   std::array<Overlap, 64> overlaps;
                   const std::size_t count = find_overlaps(world, mover.settings.radii, centre, overlaps);
                   found =
                       count > overlaps.size() ||
                       std::any_of(overlaps.begin(), overlaps.begin() + static_cast<std::ptrdiff_t>(count),
                                   [&](const Overlap& o) {
                                       return !world_of(mover, platform).surface_rule(o.surface).one_sided;
                                   });
               });
    return found;
}

std::optional<RayHit> ray_in_scene(const Mover& mover, const Vec3& from, const Vec3& motion) {
    std::optional<RayHit> best;
    each_world(mover, from, motion,
               [&](const auto& world, std::uint32_t, std::span<const TriangleId> triangles) {
                   std::optional<RayHit> hit = cast_ray(world, from, motion, best ? best->t : 1.0);
                   if (!hit || (best && !(hit->t < best->t))) return;
                   hit->triangle = number_in_mesh(hit->triangle, triangles);
                   best = hit;
               });
    return best;
}

}  // namespace slipface
