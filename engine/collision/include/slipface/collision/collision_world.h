// Collision queries against the triangles of a level: sweeps of an ellipsoid, rays, closest points, overlaps.
//
// A world is built once from a mesh; the surface type of each face may change at any time without a rebuild.
// Queries are const, allocate nothing unless stated, and may run on any number of threads while no thread
// changes the world.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "slipface/base/result.h"
#include "slipface/collision/contact.h"

namespace slipface {

// The properties of a surface type that collision uses.
struct SurfaceRule {
    bool solid = true;  // false: nothing collides with it
    // true: a sweep hits the triangle only from the front: if the move is against the winding normal, the
    // triangle does not cut the body where it starts deeper than a fiftieth of its radii, and where the body
    // touches the centre is in front by half of the body's extent. So a jump-through floor holds what falls
    // on it, and a body beside its rim passes. A triangle without a normal is never hit. Closest points see
    // both sides; for rays see RayStops.
    bool one_sided = false;
};

struct TriangleSoup {
    std::span<const Vec3f> positions;                         // world space, metres
    std::span<const std::array<std::uint32_t, 3>> triangles;  // indices into positions
    std::span<const FaceId> faces;                            // [triangle] the face that it belongs to
    // [triangle] the body that it moves with; empty: all belong to one body. Bodies share no leaf of the
    // tree, so moving one costs time proportional to its triangles and leaves the boxes of the others tight.
    std::span<const std::uint32_t> bodies = {};
};

struct Instance;  // instances.h
namespace detail {
enum class LeafForm : std::uint8_t;
}

struct BvhStatistics {
    std::size_t triangles = 0;  // those of instances, too
    std::size_t nodes = 0;
    std::size_t bytes = 0;  // BVH and collision triangles together; a mesh of several instances counts once
    int depth = 0;
};

struct RayHit {
    double t = 0.0;  // in units of the length of the direction
    Vec3 point = Vec3::Zero();
    Vec3 normal = Vec3::Zero();  // unit, towards the ray's origin; -direction for a degenerate triangle
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
    Feature feature = Feature::interior;  // part of the triangle nearest to the centre in sphere space
    Vec3 point = Vec3::Zero();            // the nearest point, world space
    Vec3 normal = Vec3::Zero();  // unit, towards the centre, world space; the winding normal if the centre is
                                 // on the triangle
    double depth_sphere_space = 0.0;  // 1 - distance in sphere space, (0, 1]
};

class CollisionWorld {
  public:
    CollisionWorld();  // empty: every query misses
    ~CollisionWorld();
    CollisionWorld(CollisionWorld&&) noexcept;
    CollisionWorld& operator=(CollisionWorld&&) noexcept;

    // Builds a world. No triangles give an empty world. Degenerate triangles are allowed: they collide as the
    // edges and points that they are. Errors: more than 2^25 triangles, an index out of range, the wrong
    // number of `faces` or `bodies`, a coordinate that is not finite, too little memory.
    static Result<CollisionWorld> build(const TriangleSoup& soup);
    // The same with instances of meshes: every query gives the same bits as in a world of all their placed
    // triangles. Further errors: an instance without a mesh, a placement that is not finite or flattens the
    // mesh, faces that are not ascending, types of another number of faces.
    static Result<CollisionWorld> build(const TriangleSoup& soup, std::span<const Instance> instances);
    // The same for geometry that a pose moves and turns (posed.h).
    static Result<CollisionWorld> build_movable(const TriangleSoup& soup);
    // Replaces the instances; the soup's tree stays, and an instance that stays where it is costs little.
    // Queries then give the same bits as a new world, and bounds() is that of the present positions. Must not
    // run during queries. Errors: as build(); then nothing changes.
    Status set_instances(std::span<const Instance> instances);

    // Moves triangles[i] to the corners corners[i], world space, and refits the tree (moving platforms).
    // Queries then give the same answers as a new world with these corners; they only get slower if triangles
    // of one body drift apart. bounds() still includes the old positions. Must not run during queries.
    // Errors: spans of unequal length, triangles that do not exist or belong to instances, coordinates that
    // are not finite; then nothing is moved.
    Status move_triangles(std::span<const TriangleId> triangles,
                          std::span<const std::array<Vec3f, 3>> corners);

    void set_face_surface(FaceId face, SurfaceId surface);  // faces outside the soup are ignored
    // The same for the faces 0, 1, 2, ...; instances with the same types then share them.
    void set_face_surfaces(std::span<const SurfaceId> surfaces);
    SurfaceId face_surface(FaceId face) const;                   // default_surface outside the soup
    void set_surface_rule(SurfaceId surface, SurfaceRule rule);  // at first all are solid and two-sided
    SurfaceRule surface_rule(SurfaceId surface) const;

    std::size_t triangle_count() const;
    // The triangle must be below triangle_count(); otherwise the behaviour is undefined.
    std::array<Vec3, 3> triangle(TriangleId triangle) const;  // corners, world space
    FaceId triangle_face(TriangleId triangle) const;
    Vec3 triangle_normal(TriangleId triangle) const;  // winding normal, unit; zero for a degenerate triangle

    // The box of all positions that the triangles have had; empty for an empty world.
    Aabb bounds() const;
    BvhStatistics statistics() const;

    // All triangles, solid or not, whose boxes touch `box`, ascending. Allocates. For tools and tests.
    std::vector<TriangleId> triangles_in(const Aabb& box) const;
    // About how many triangles a query that stays within `box` looks at: those of all leaves that touch it.
    // Large where boxes do not tell triangles apart, so that each query there is slow; for searches that end
    // before they take too long. The same on every machine.
    std::size_t crowd_in(const Aabb& box) const;

    struct Impl;
    const Impl& impl() const { return *impl_; }

  private:
    friend class CollisionMesh;
    static Result<CollisionWorld> build(const TriangleSoup& soup, std::span<const Instance> instances,
                                        detail::LeafForm form);

    std::unique_ptr<Impl> impl_;
};

// The first hit of an ellipsoid with radii `radii` (all > 0, metres) whose centre moves from `from` by
// `move`, or nothing.
//
// If the sweep starts in contact with a triangle or overlaps it: a move that does not go further in ignores
// that triangle; a move that does is a hit at t = 0 with the normal of the closest point. Of several hits the
// smallest t wins, then interior before edge before vertex, then the lowest triangle. A zero move, input that
// is not finite and radii that are not positive hit nothing. Source: Brown University CS1950u, lecture 7,
// "Computing the contact point" and "Contact plane in ellipsoid space"; docs/sweep.md derives it.
std::optional<Contact> sweep_ellipsoid(const CollisionWorld& world, const Vec3& radii, const Vec3& from,
                                       const Vec3& move);

// The arguments of one sweep of a batch; world space, metres.
struct Sweep {
    Vec3 radii = Vec3::Ones();
    Vec3 from = Vec3::Zero();
    Vec3 move = Vec3::Zero();
};

// Sets out[i] to the result of sweeps[i], for as many as the shorter of the two spans. The results have the
// same bits as single sweeps. Uses all available threads and processes many sweeps side by side on each,
// which is up to twice as fast as one after the other.
void sweep_ellipsoids(const CollisionWorld& world, std::span<const Sweep> sweeps,
                      std::span<std::optional<Contact>> out);

// The first solid triangle that the ray from `origin` along `direction` (any length above 0) hits with t in
// [0, max_t], or nothing. Both sides are hit unless `stops` is as_movement: then one-sided triangles do not
// stop the ray from behind. Of several at the same t the lowest triangle wins. A triangle that has no area or
// lies in line with the ray is not hit; only its neighbours can stop such a ray (docs/sweep.md, "Rays", gives
// the limit). Returns nothing for an origin or direction that is not finite, a direction of 0, and a max_t
// that is negative or NaN.
enum class RayStops : std::uint8_t { solid, as_movement };
std::optional<RayHit> cast_ray(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                               double max_t = std::numeric_limits<double>::infinity(),
                               RayStops stops = RayStops::solid);

// The solid triangle nearest to `point` at a distance of at most `max_distance` metres, or nothing. Of
// several at the same squared distance the lowest wins. Returns nothing for a point that is not finite, and a
// max_distance that is negative or NaN.
std::optional<ClosestPoint> closest_point(const CollisionWorld& world, const Vec3& point,
                                          double max_distance = std::numeric_limits<double>::infinity());

// The solid triangles that the ellipsoid at `centre` overlaps (distance in sphere space < 1), ascending.
// Writes as many of the lowest as `out` holds and returns the total, which may be larger. A one-sided
// triangle counts only while the centre is not behind its plane, as for sweeps. Input that is not finite and
// radii that are not positive overlap nothing.
std::size_t find_overlaps(const CollisionWorld& world, const Vec3& radii, const Vec3& centre,
                          std::span<Overlap> out);

// True if find_overlaps would find at least one; stops at the first.
bool overlaps_any(const CollisionWorld& world, const Vec3& radii, const Vec3& centre);

}  // namespace slipface
