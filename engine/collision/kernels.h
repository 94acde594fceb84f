// What every query spends its time in. The float part walks the tree, drops what certainly does not matter,
// and hands the rest to a callback, which decides by the narrow phase in double. The first errs on the side
// of keeping and the second rounds alike everywhere, so no answer depends on which of the compiled kernels
// runs. docs/sweep.md, "Boxes" and "The float filter", bounds the errors.
//
// Compiled once for each instruction set; everything passed is plain data.
#pragma once

#include "bvh_layout.h"
#include "slipface/collision/near_triangles.h"
#include "sphere_triangle.h"

namespace slipface::detail {

// Relative slack of a float time against rounding: each is a subtraction, a reciprocal and a product away
// from exact input, under 8 ulp in all.
inline constexpr float time_slack = 1e-6F;
inline constexpr float least_time = 1e-37F;
// What a time on the way out of a box is multiplied by, to cover the rounding of both ends.
inline constexpr float late = 1.0F + 4.0F * time_slack;
// More than all roundings of a determinant of three vectors together (fewer than 40 of 2^-24), relative
// to the product of their lengths.
inline constexpr float determinant_rounding = 4e-6F;
// Separations whose square is smaller are not trusted: they are too near float's lower end.
inline constexpr float least_square = 1e-28F;

// The path of an axis-aligned box (or a point) as slabs: an axis' nearer plane of a tree box is passed at
// (plane - near_offset) * inverse.
struct BoxPath {
    float near_offset[4];  // [axis] where the path's own further side starts, rounded away from the path
    float far_offset[4];
    float inverse[4];      // 1 / move, +inf for none
    float far_inverse[4];  // with the slack of a time on the way out
    int near_row[4];       // of BvhNode::bound: the maximum's where the move is negative
    int far_row[4];
};

// The same path in sphere space. A corner w is (w - centre) * inverse - rest there.
struct SpherePath {
    float centre[4];  // [axis]
    float rest[4];
    float inverse[4];  // 1 / radii
    float d[4];
    bool usable;  // products of three factors stay far from float's ends
};

struct SweepPath {
    BoxPath box;
    SpherePath sphere;
};

// One of the sweeps that go through the tree side by side, and the part of its way that is looked at now.
struct WaveSweep {
    SweepPath path;
    float from;  // fraction of the move
    float to;
};
inline constexpr std::uint32_t wave_sweeps = 128;
// A triangle that one of them may touch.
struct Candidate {
    std::uint32_t sweep;
    std::uint32_t leaf;  // place
    std::uint32_t lane;
    float after;  // not before this time
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
    float after;  // not before this time
};

inline constexpr std::uint32_t leads_out = ~0U;

// What a query has to know of the world.
struct WorldExtent {
    float low[3];  // the box of all triangles
    float high[3];
    double reach;  // the largest coordinate that a triangle ever had
};

enum class Prepared : std::uint8_t {
    beside,        // the whole way lies beside the world: nothing is touched
    in_floats,     // finite, radii above 0; the kernels find what may be touched
    beyond_floats  // perhaps not even finite
};

// Called with a triangle that may matter; returns the limit from now on, and below 0 to stop.
using Consider = float (*)(void* context, const Leaf& leaf, std::uint32_t lane);

struct Kernels {
    const char* name;
    // What a sweep needs, unless it is beside. `move` may be 0.
    Prepared (*prepare_sweep)(const WorldExtent& world, const V3& radii, const V3& from, const V3& move,
                              EllipsoidQuery& query, SweepPath& path);
    // Triangles that the sphere may touch no later than `limit`, nearer ones roughly first.
    void (*sweep)(const TreeView& tree, const SweepPath& path, float limit, Consider consider, void* context);
    // The same for up to wave_sweeps sweeps at a time, all usable: what waits for one of them is done for the
    // others meanwhile. Returns how many triangles are in `out`, in no order, or more than there is room for.
    std::uint32_t (*wave)(const TreeView& tree, const WaveSweep* sweeps, std::uint32_t count, Candidate* out);
    // Triangles that the ray may cross no later than `limit`.
    void (*ray)(const TreeView& tree, const RayPath& path, float limit, Consider consider, void* context);
    // Triangles whose squared distance may be at most `limit`.
    void (*closest)(const TreeView& tree, const PointBoxes& point, float limit, Consider consider,
                    void* context);
    // Triangles that a body can touch while its centre is no further than `reach` from `centre` along any
    // axis. Leaves `out` as it is where that is out of range, and with nowhere to be where they are too many.
    void (*near)(const TreeView& tree, const WorldExtent& world, const V3& radii, const V3& centre,
                 const V3& reach, NearTriangles& out);
    // Makes the query of a sweep, which may rest, and finds those of them that it may touch on its way.
    // Returns how many, or leads_out.
    std::uint32_t (*near_sweep)(const NearTriangles& near, const V3& radii, const V3& from, const V3& move,
                                EllipsoidQuery& query, NearCandidate* out);

    // The first touch of a triangle; false if there is none with t <= t_max.
    bool (*sweep_triangle)(const LeafTriangle& triangle, const EllipsoidQuery& query, double t_max,
                           TriangleHit& hit);
    Nearest (*nearest_part)(const LeafTriangle& triangle, const EllipsoidQuery& query);
    // Whether the centre is behind the plane of the winding, or there is none.
    bool (*is_behind)(const LeafTriangle& triangle, const EllipsoidQuery& query);
    // Whether a one-sided triangle lets the query pass: its centre is behind it, or the move does not go
    // against the winding normal.
    bool (*passes_one_sided)(const LeafTriangle& triangle, const EllipsoidQuery& query);
    Touch (*touch_of_hit)(const LeafTriangle& triangle, const EllipsoidQuery& query, const TriangleHit& hit);
    Touch (*touch_of_nearest)(const LeafTriangle& triangle, const EllipsoidQuery& query,
                              const Nearest& nearest);
};

extern const Kernels baseline_kernels;
#if defined(__x86_64__)
extern const Kernels avx2_kernels;
extern const Kernels avx512_kernels;
#endif

// The ones in use: the widest that the processor has, unless another was asked for.
const Kernels& kernels();

}  // namespace slipface::detail
