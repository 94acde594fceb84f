// The triangles of a level, ready to be asked what a moving ellipsoid, a ray or a point meets.
//
// A world is built once from a mesh; the surface type of each face may change at any time without a rebuild.
// Queries are const, free of allocation, and may run on any number of threads while nobody changes the world.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "slipface/base/result.h"
#include "slipface/collision/contact.h"

namespace slipface {

// What collision needs to know of a surface type.
struct SurfaceRule {
    bool solid = true;  // false: nothing collides with it
    // true: only motion against the triangle's winding normal touches it, and only while the centre is not
    // behind its plane. Rays and closest points see both sides.
    bool one_sided = false;
};

struct TriangleSoup {
    std::span<const Vec3f> positions;                         // world space, metres
    std::span<const std::array<std::uint32_t, 3>> triangles;  // indices into positions
    std::span<const FaceId> faces;                            // [triangle] the face it belongs to
    // [triangle] number of the body that it moves with; empty: all belong to one. Bodies share no leaf of the
    // tree, so that moving one costs what it is large, and leaves the others' boxes tight.
    std::span<const std::uint32_t> bodies = {};
};

struct BvhStatistics {
    std::size_t triangles = 0;
    std::size_t nodes = 0;
    std::size_t bytes = 0;  // BVH and collision triangles together
    int depth = 0;
};

struct RayHit {
    double t = 0.0;  // distance in units of the direction's length
    Vec3 point = Vec3::Zero();
    Vec3 normal = Vec3::Zero();  // unit, the triangle's winding normal turned towards the ray's origin
    TriangleId triangle = no_id;
    FaceId face = no_id;
    bool back_face = false;  // the ray came from behind the winding normal
};

struct ClosestPoint {
    double distance = 0.0;  // metres
    Vec3 point = Vec3::Zero();
    TriangleId triangle = no_id;
    FaceId face = no_id;
};

// A triangle that an ellipsoid at rest overlaps.
struct Overlap {
    TriangleId triangle = no_id;
    FaceId face = no_id;
    SurfaceId surface = default_surface;
    Feature feature = Feature::interior;  // where the closest point (in sphere space) lies
    Vec3 point = Vec3::Zero();            // that closest point, world space
    Vec3 normal = Vec3::Zero();       // contact normal there, unit, towards the centre; winding normal if the
                                      // centre is on it
    double depth_sphere_space = 0.0;  // 1 - distance in sphere space, (0, 1]
};

class CollisionWorld {
  public:
    CollisionWorld();  // empty: every query misses
    ~CollisionWorld();
    CollisionWorld(CollisionWorld&&) noexcept;
    CollisionWorld& operator=(CollisionWorld&&) noexcept;

    // Refuses more than 2^25 triangles, indices out of range, `faces` that are not one a triangle, `bodies`
    // that are neither none nor one a triangle, and coordinates that are not finite; an error, too, if memory
    // runs out. No triangles are an empty world. Degenerate triangles are kept: they collide as the edges and
    // points that they are.
    static Result<CollisionWorld> build(const TriangleSoup& soup);

    // Gives triangles[i] the corners corners[i] and fits the tree around them (moving platforms). Every
    // answer afterwards is that of a world built anew with those corners; only the speed may suffer when
    // triangles of one body drift apart. bounds() still covers the old places. Refuses spans of unequal
    // length, triangles that do not exist and coordinates that are not finite, and then moves nothing. Not
    // while others query.
    Status move_triangles(std::span<const TriangleId> triangles,
                          std::span<const std::array<Vec3f, 3>> corners);

    void set_face_surface(FaceId face, SurfaceId surface);       // faces outside the soup are ignored
    SurfaceId face_surface(FaceId face) const;                   // default_surface outside the soup
    void set_surface_rule(SurfaceId surface, SurfaceRule rule);  // all solid and two-sided at first
    SurfaceRule surface_rule(SurfaceId surface) const;

    std::size_t triangle_count() const;
    // Of a triangle below triangle_count(); for any other number the behaviour is undefined.
    std::array<Vec3, 3> triangle(TriangleId triangle) const;  // corners, world space
    FaceId triangle_face(TriangleId triangle) const;
    Vec3 triangle_normal(TriangleId triangle) const;  // winding normal, unit; zero for a degenerate one

    Aabb bounds() const;
    BvhStatistics statistics() const;

    // Every triangle whose box meets `box`, ascending, solid or not. Allocates. For tools and tests.
    std::vector<TriangleId> triangles_in(const Aabb& box) const;

    struct Impl;
    const Impl& impl() const { return *impl_; }

  private:
    std::unique_ptr<Impl> impl_;
};

// First touch of the ellipsoid `radii` (all > 0, metres) whose centre moves from `from` by `move`, or
// nothing.
//
// Starting in touch or overlap: a move that does not go further in is free of that triangle, one that does is
// a hit at t = 0 with the normal of the closest point. Ties: smallest t, then interior before edge before
// vertex, then the lowest triangle. A zero move touches nothing. Non-finite input, or radii that are not
// positive, touch nothing. Source: lecture, "Computing the contact point" and "Contact plane in ellipsoid
// space"; docs/sweep.md derives it.
std::optional<Contact> sweep_ellipsoid(const CollisionWorld& world, const Vec3& radii, const Vec3& from,
                                       const Vec3& move);

// One sweep of a batch.
struct Sweep {
    Vec3 radii = Vec3::Ones();
    Vec3 from = Vec3::Zero();
    Vec3 move = Vec3::Zero();
};

// out[i] = the answer to sweeps[i]; the same bits as one by one. On as many threads as there are, and on each
// of them dozens side by side, which is up to twice as fast as asking for one after the other. As many as the
// shorter of the two spans.
void sweep_ellipsoids(const CollisionWorld& world, std::span<const Sweep> sweeps,
                      std::span<std::optional<Contact>> out);

// First solid triangle, from either side, that the ray from `origin` along `direction` (any length above 0)
// meets with t in [0, max_t]; of several at the same t the lowest triangle. A ray in a triangle's plane does
// not meet it, nor does any ray meet a triangle without area: what stops it are their neighbours, or nothing.
// docs/sweep.md, "Rays", says how thin a triangle may be. Nothing for an origin or direction that is not
// finite, a direction of 0, and a max_t that is negative or NaN. `stops`: whether one-sided triangles stop it
// from behind, too.
enum class RayStops : std::uint8_t { solid, as_movement };
std::optional<RayHit> cast_ray(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                               double max_t = std::numeric_limits<double>::infinity(),
                               RayStops stops = RayStops::solid);

// The solid triangle nearest to `point` within `max_distance` (metres, that distance included), or nothing;
// of several at the same squared distance the lowest. Nothing for a point that is not finite, and a
// max_distance that is negative or NaN.
std::optional<ClosestPoint> closest_point(const CollisionWorld& world, const Vec3& point,
                                          double max_distance = std::numeric_limits<double>::infinity());

// The solid triangles that the ellipsoid at `centre` overlaps (distance in sphere space < 1), ascending by
// triangle, as many as `out` holds. Returns how many there are in all, which may be more. A one-sided
// triangle counts only while the centre is not behind its plane, as for sweeps. Non-finite input, or radii
// that are not positive, overlap nothing.
std::size_t find_overlaps(const CollisionWorld& world, const Vec3& radii, const Vec3& centre,
                          std::span<Overlap> out);

// True if find_overlaps would find one. Stops at the first.
bool overlaps_any(const CollisionWorld& world, const Vec3& radii, const Vec3& centre);

}  // namespace slipface
