// What a step touched, for a game: sounds, dust, damage, pushes of bodies that its physics moves.
#pragma once

#include <cstddef>
#include <span>

#include "slipface/movement/trace.h"

namespace slipface {

struct StepContact {
    Vec3 point = Vec3::Zero();   // on the face, in the scene's coordinates
    Vec3 normal = Vec3::Zero();  // unit, towards the body
    FaceId face = no_id;
    TriangleId triangle = no_id;     // as in Contact
    std::uint32_t platform = no_id;  // of MovementScene::platforms, or no_id
    SurfaceId surface = default_surface;
    Feature feature = Feature::interior;
    Pass pass = Pass::slide;  // step, snap: where a step up and a snap to the floor ended; probe: a platform
                              // that pushes the body
    double speed = 0.0;       // m/s, at which the body and the face approached each other along the normal
};

// The contacts of a step, in order: those of its moves, not those of moves that were tried and taken back.
// One of the same face, normal and pass is noted once, with the highest speed. step() fills `out` and
// allocates nothing.
//
//   std::array<StepContact, 16> room;
//   StepContacts contacts{room};
//   state = step(scene, settings, state, input, dt, nullptr, &contacts).state;
//   for (const StepContact& one : contacts.found()) ...
struct StepContacts {
    std::span<StepContact> out;
    std::size_t count = 0;  // in `out`; a step begins at 0
    bool full = false;      // there were more than `out` holds

    std::span<const StepContact> found() const { return out.first(count); }
};

}  // namespace slipface
