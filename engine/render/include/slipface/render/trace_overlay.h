// Draws a trace of a sweep or a step. The editor's probe, the snapshots and all other views of a trace use
// the same colours:
//
//   white outline      where the ellipsoid started
//   blue to violet     the ellipsoid after each sweep, in order, with the path of its centre
//   yellow             contact points
//   green              contact normals and contact planes
//   red, cyan          the remainder before and after a contact, from the centre at the contact
//   orange             push-outs
#pragma once

#include <span>

#include "slipface/movement/trace.h"
#include "slipface/render/overlay.h"

namespace slipface {

struct TraceStyle {
    bool ghosts = true;    // ellipsoids; else only the path of the centre
    bool contacts = true;  // points and normals
    bool planes = true;    // contact planes as discs
    bool remainders = true;
    float opacity = 1.0f;  // of the whole drawing, 0..1
};

namespace trace_colors {
inline constexpr Color start{0.95f, 0.96f, 0.98f, 0.9f};
inline constexpr Color contact{1.0f, 0.86f, 0.20f, 1.0f};
inline constexpr Color normal{0.36f, 0.88f, 0.42f, 1.0f};
inline constexpr Color remainder_before{0.98f, 0.33f, 0.30f, 1.0f};
inline constexpr Color remainder_after{0.25f, 0.86f, 0.93f, 1.0f};
inline constexpr Color push_out{1.0f, 0.60f, 0.18f, 1.0f};
}  // namespace trace_colors

// The colour of sweep number `index` of a trace: blue at 0, violet from 5 on. Tables of sweeps use it too.
Color sweep_color(int index);

// Adds the drawing of `records`, in their coordinates, to `overlay`. `radii`: of the ellipsoid, metres.
void draw_trace(Overlay& overlay, std::span<const TraceRecord> records, const Vec3& radii,
                const TraceStyle& style = {});

}  // namespace slipface
