// The inner loops of all queries. The float part walks the tree, rejects triangles that certainly do not
// matter, and passes the others to a callback, which decides with the narrow phase in double. The float part
// keeps a triangle when in doubt, and the narrow phase rounds alike everywhere, so no result depends on which
// of the compiled kernels runs. docs/sweep.md, "Boxes" and "The float filter", bounds the errors.
//
// Compiled once for each instruction set; all arguments are plain data.
#pragma once

#include "queries/ray_triangle.h"
#include "queries/sphere_triangle.h"
#include "slipface/collision/near_triangles.h"
#include "tree/bvh_layout.h"

namespace slipface::detail {

// Relative slack of a float time against rounding: a subtraction, a reciprocal and a product separate it from
// exact input, under 8 ulp in all.
inline constexpr float time_slack = 1e-6F;
inline constexpr float least_time = 1e-37F;
// Factor on the time at which a box is left, to cover the rounding of both ends.
inline constexpr float late = 1.0F + 4.0F * time_slack;
// Upper bound of all roundings in a determinant of three vectors (fewer than 40 of 2^-24), relative to the
// product of their lengths.
inline constexpr float determinant_rounding = 4e-6F;
// Separations with a smaller square are not trusted: they are too near the lower end of float.
inline constexpr float least_square = 1e-28F;

// The path of an axis-aligned box (or a point) as slabs: the path reaches the nearer plane of a tree box at
// time (plane - near_offset) * inverse, along each axis.
struct BoxPath {
    float near_offset[4];  // [axis] the path's own far side at its start, rounded away from the path
    float far_offset[4];
    float inverse[4];      // 1 / move; +inf if the move is 0
    float far_inverse[4];  // with the slack of a time at which a box is left
    int near_row[4];       // row of BvhNode::bound: that of the maximum where the move is negative
    int far_row[4];
};

// The same path in sphere space: a corner w becomes (w - centre) * inverse - rest.
struct SpherePath {
    float centre[4];  // [axis]
    float rest[4];
    float inverse[4];  // 1 / radii
    float d[4];
    bool usable;  // products of three factors stay far from the ends of float
};

struct SweepPath {
    BoxPath box;
    SpherePath sphere;
};

// One of the sweeps that go through the tree side by side, and the part of its path that is searched now.
struct WaveSweep {
    SweepPath path;
    float from;  // fraction of the move
    float to;
};
inline constexpr std::uint32_t wave_sweeps = 128;
// A triangle that one of these sweeps may touch.
struct Candidate {
    std::uint32_t sweep;
    std::uint32_t leaf;  // index of the leaf
    std::uint32_t lane;
    float after;  // not touched before this time
};
inline constexpr std::uint32_t wave_candidates = 4096;

struct RayPath {
    BoxPath box;
    float centre[4];
    float rest[4];
    int kx, ky, kz;
    float sx, sy;
    bool usable;
};

struct PointBoxes {
    float up[3];  // the point, rounded up
    float down[3];
    SpherePath sphere;  // no move; for closest points radii of 1
};

// A triangle of a neighbourhood that a sweep may touch.
struct NearCandidate {
    std::uint32_t index;
    float after;  // not touched before this time
};

inline constexpr std::uint32_t leads_out = ~0U;

// The properties of a world that a query needs.
struct WorldExtent {
    float low[3];  // the box of all triangles
    float high[3];
    double reach;  // the largest absolute coordinate that a triangle has ever had
};

enum class Prepared : std::uint8_t {
    beside,        // the whole path lies outside the world's box: nothing is touched
    in_floats,     // finite, radii above 0; the kernels find the triangles that may be touched
    beyond_floats  // not representable in float, perhaps not even finite
};

// Called with a triangle that may matter. Returns the new limit; a negative one stops the search.
using Consider = float (*)(void* context, const Leaf& leaf, std::uint32_t lane);

struct Kernels {
    const char* name;
    // Bytes of a tree below which sweeps longer than a body are faster alone than in a wave: with little
    // memory to wait for, a wave wins only by registers that pick lanes.
    std::size_t wave_worth;
    // Prepares a sweep; `move` may be 0. `query` is unset for `beside`, `path` is set only for `in_floats`.
    Prepared (*prepare_sweep)(const WorldExtent& world, const V3& radii, const V3& from, const V3& move,
                              EllipsoidQuery& query, SweepPath& path);
    // Finds triangles that the sphere may touch no later than `limit`, roughly the nearer ones first.
    void (*sweep)(const WorldView& world, const EllipsoidQuery& query, const SweepPath& path, float limit,
                  Consider consider, void* context);
    // The same for up to wave_sweeps sweeps side by side in one tree, all usable: while one waits for memory,
    // the others proceed. Returns the number of triangles in `out`, in no order, or a number above
    // wave_candidates if they do not fit.
    std::uint32_t (*wave)(const TreeView& tree, const WaveSweep* sweeps, std::uint32_t count, Candidate* out);
    // Finds triangles that the ray may cross no later than `limit`.
    void (*ray)(const WorldView& world, const V3& origin, const V3& direction, const RayPath& path,
                float limit, Consider consider, void* context);
    // Finds triangles whose squared distance may be at most `limit`.
    void (*closest)(const WorldView& world, const V3& at, const PointBoxes& point, float limit,
                    Consider consider, void* context);
    // Collects the triangles that a body can touch while its centre is at most `reach` from `centre` along
    // each axis. If an argument is out of range or they are too many, `out` stays empty with a negative
    // reach.
    void (*near)(const WorldView& view, const WorldExtent& world, const V3& radii, const V3& centre,
                 const V3& reach, NearTriangles& out);
    // Finds the triangles of the neighbourhood that a sweep (`move` may be 0) may touch, and prepares its
    // query if there are any. Returns their number, or leads_out.
    std::uint32_t (*near_sweep)(const NearTriangles& near, const V3& radii, const V3& from, const V3& move,
                                EllipsoidQuery& query, NearCandidate* out);
    // The same for a body at rest.
    std::uint32_t (*near_rest)(const NearTriangles& near, const V3& radii, const V3& centre,
                               EllipsoidQuery& query, NearCandidate* out);
    // The largest y of the triangles of the neighbourhood that a vertical line through the way may cross
    // below `from`, but for those that are steeper than `cosine`; -infinity if there are none.
    float (*near_highest)(const NearTriangles& near, const V3& from, const V3& to, double cosine);
    // Finds the triangles of the neighbourhood that the ray's line may cross; returns their number.
    std::uint32_t (*near_ray)(const NearTriangles& near, const RayPath& path, std::uint32_t* out);

    // Finds the first touch of a triangle; false if there is none with t <= t_max.
    bool (*sweep_triangle)(const LeafTriangle& triangle, const EllipsoidQuery& query, double t_max,
                           TriangleHit& hit);
    Nearest (*nearest_part)(const LeafTriangle& triangle, const EllipsoidQuery& query);
    // True if the centre is behind the plane of the winding, or the triangle has no plane.
    bool (*is_behind)(const LeafTriangle& triangle, const EllipsoidQuery& query);
    // True if a one-sided triangle ignores the query that touches it at `hit`, because the body does not come
    // from its front.
    bool (*passes_one_sided)(const LeafTriangle& triangle, const EllipsoidQuery& query,
                             const TriangleHit& hit);
    Touch (*touch_of_hit)(const LeafTriangle& triangle, const EllipsoidQuery& query, const TriangleHit& hit);
    Touch (*touch_of_nearest)(const LeafTriangle& triangle, const EllipsoidQuery& query,
                              const Nearest& nearest);
    // Finds where the ray crosses a triangle; false if it does not, or before its start.
    bool (*ray_triangle)(const LeafTriangle& triangle, const ShearedRay& ray, RayTouch& touch);
};

extern const Kernels baseline_kernels;
#if defined(__x86_64__)
extern const Kernels avx2_kernels;
extern const Kernels avx512_kernels;
#endif

// The kernels in use: the widest that the processor supports, unless another set was selected.
const Kernels& kernels();

}  // namespace slipface::detail
