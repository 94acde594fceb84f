// The scene as one thing to collide with: what stands still, and the platforms where this tick ends.
#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

// Above the rounding of boxes and of sweeps, as a fraction of the lengths involved.
constexpr double box_slack = 1e-5;

// Calls visit(world, platform, triangles) for everything that a player can touch between `from` and `from` +
// `move`. What stands still is a Neighbourhood.
template <class Visit>
void each_world(const Mover& mover, const Vec3& from, const Vec3& move, Visit&& visit) {
    visit(mover.around.near, no_id, mover.scene.triangles);
    each_platform(mover, from, move, [&](std::uint32_t i) {
        const MovingPart& part = mover.scene.platforms[i];
        if (i != mover.ignored_platform) visit(seen_at(mover, i, pose_after(mover, part)), i, part.triangles);
    });
}

template <class World>
std::optional<Contact> sweep_body(const Mover& mover, const World& world, std::uint32_t platform,
                                  const Vec3& from, const Vec3& move) {
    return mover.dropping ? sweep_dropping(mover, platform, from, move)
                          : sweep_ellipsoid(world, mover.settings.radii, from, move);
}

TriangleId number_in_mesh(TriangleId triangle, std::span<const TriangleId> triangles) {
    return triangle < triangles.size() ? triangles[triangle] : triangle;
}

// The order of CollisionWorld: smallest t, then face before edge before corner, then the lowest triangle. At
// last what stands still, and the lowest platform.
bool earlier(const SceneContact& a, const SceneContact& b) {
    if (a.contact.t != b.contact.t) return a.contact.t < b.contact.t;
    if (a.contact.feature != b.contact.feature) return a.contact.feature < b.contact.feature;
    if (a.contact.triangle != b.contact.triangle) return a.contact.triangle < b.contact.triangle;
    return a.platform + 1 < b.platform + 1;
}

}  // namespace

Pose pose_at(const MovingPart& part, double time, double dt) {
    if (time >= 1.0 || part.begin == part.end) return part.end;
    if (time <= 0.0) return part.begin;
    const Vec3 pivot = part.end.undo(part.pivot);
    const Vec3 from = part.begin.apply(pivot), at = from + (part.end.apply(pivot) - from) * time;
    Pose pose = part.end;
    if (part.begin.columns != part.end.columns) {
        const double back = -part.angular_velocity.norm() * dt * (1.0 - time);
        const Pose turn = rotation_about(Vec3::Zero(), part.angular_velocity, back);
        for (Vec3& column : pose.columns)
            column = turn.rotate(column);
    }
    pose.offset = at - pose.rotate(pivot);
    return pose;
}

Aabb room_of(const MovingPart& part) {
    Aabb begin = PosedWorld(*part.rest, part.begin).bounds(), end = part.at_end().bounds();
    if (begin.empty()) return begin;
    Aabb room{begin.min.cwiseMin(end.min), begin.max.cwiseMax(end.max)};
    if (part.begin.columns != part.end.columns) {
        // Each point goes along an arc. It rises less above its chord than the chord is long.
        double longest = 0.0;
        const Aabb rest = part.rest->bounds();
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 at((corner & 1) != 0 ? rest.max.x() : rest.min.x(),
                          (corner & 2) != 0 ? rest.max.y() : rest.min.y(),
                          (corner & 4) != 0 ? rest.max.z() : rest.min.z());
            longest = std::max(longest, (part.end.apply(at) - part.begin.apply(at)).norm());
        }
        room.min.array() -= longest;
        room.max.array() += longest;
    }
    return room;
}

Vec3 slack_around(const Vec3& radii, const Vec3& from, const Vec3& reach) {
    return radii + box_slack * (radii + reach.cwiseAbs()) + 1e-12 * from.cwiseAbs();
}

NearPlatforms platforms_near(const MovementScene& scene, const Vec3& radii, const Vec3& from,
                             const Vec3& reach) {
    NearPlatforms near;
    near.room.min = from - reach;
    near.room.max = from + reach;
    if (scene.platforms.empty()) return near;
    const Vec3 slack = slack_around(radii, from, reach);
    const Aabb box{near.room.min - slack, near.room.max + slack};
    const auto add = [&](std::uint32_t platform) {
        if (near.count < NearPlatforms::capacity) near.list[near.count] = platform;
        ++near.count;
    };
    if (scene.tree != nullptr) {
        scene.tree->visit(box, add);
        return near;
    }
    for (std::uint32_t i = 0; i < scene.platforms.size(); ++i) {
        const Aabb bounds = room_of(scene.platforms[i]);
        const bool beside =
            (box.min.array() > bounds.max.array()).any() || (box.max.array() < bounds.min.array()).any();
        if (!beside) add(i);
    }
    return near;
}

QueryFilter filter_of(const MovementScene& scene, std::uint32_t platform) {
    QueryFilter seen;
    if (scene.filter == nullptr) return seen;
    seen.ignored = scene.filter->ignored;
    seen.mask = scene.filter->mask;
    seen.groups = platform < scene.platforms.size() ? scene.platforms[platform].groups : scene.groups;
    seen.ask = scene.filter->ask;
    seen.user = scene.filter->user;
    seen.part = platform;
    return seen;
}

SeenWorld seen_at(const Given& given, std::uint32_t platform, const Pose& pose) {
    const bool moves = platform < given.scene.platforms.size();
    return {PosedWorld(moves ? *given.scene.platforms[platform].rest : given.scene.collision, pose),
            filter_of(given.scene, platform)};
}

SeenWorld world_of(const Given& given, std::uint32_t platform) {
    const bool moves = platform < given.scene.platforms.size();
    return seen_at(given, platform, moves ? pose_after(given, given.scene.platforms[platform]) : Pose{});
}

std::optional<SceneContact> sweep_scene(Mover& mover, const Vec3& from, const Vec3& move) {
    ++mover.sweeps;
    std::optional<SceneContact> best;
    each_world(mover, from, move,
               [&](const auto& world, std::uint32_t platform, std::span<const TriangleId> triangles) {
                   std::optional<Contact> contact = sweep_body(mover, world, platform, from, move);
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
                   const SceneContact found{*contact, triangle, platform, depth, back};
                   if (!best || earlier(found, *best)) best = found;
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

std::size_t touched_in_scene(const Mover& mover, const Vec3& radii, const Vec3& centre,
                             std::span<SceneOverlap> out) {
    std::size_t count = 0;
    each_world(mover, centre, Vec3::Zero(),
               [&](const auto& world, std::uint32_t platform, std::span<const TriangleId>) {
                   std::array<Overlap, 16> found;
                   const std::size_t here = std::min(
                       {find_overlaps(world, radii, centre, found), found.size(), out.size() - count});
                   for (std::size_t i = 0; i < here; ++i)
                       out[count++] = {found[i], platform};
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

std::optional<SceneRay> ray_in_scene(const Mover& mover, const Vec3& from, const Vec3& motion) {
    std::optional<SceneRay> best;
    each_world(mover, from, motion,
               [&](const auto& world, std::uint32_t platform, std::span<const TriangleId> triangles) {
                   const std::optional<RayHit> hit = cast_ray(world, from, motion, best ? best->t : 1.0);
                   if (!hit || (best && !(hit->t < best->t))) return;
                   best = SceneRay{*hit, world_of(mover, platform).face_surface(hit->face), platform};
                   best->triangle = number_in_mesh(hit->triangle, triangles);
               });
    return best;
}

}  // namespace slipface
