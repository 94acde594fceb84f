// What happened in a step, for sounds, effects and rules of a game.
#pragma once

#include "slipface/movement/step.h"
#include "slipface/movement/step_contacts.h"

namespace slipface {

enum class StepEventKind : std::uint8_t {
    landed,    // value: the speed, m/s, at which the body met the ground
    left,      // the ground; value: the speed upwards, m/s
    touched,   // a face of a type other than `default`; value: the speed into it, m/s
    hazard,    // and no hazard in the step before
    stepped,   // up; value: how high, m
    crushed,   // by a platform that left no room
    entered,   // a trigger (triggers.h)
    stayed,    // in it
    departed,  // from it
};

struct StepEvent {
    StepEventKind kind{};
    SurfaceId surface = default_surface;  // of the face
    std::uint32_t platform = no_id;
    FaceId face = no_id;
    double value = 0.0;
};

// The events of one step from its states and contacts, in the order of StepEventKind; a type is touched once
// per step and platform. Writes as many as `out` holds and returns the total. A settings' `radii` says where
// the feet are. Pure: the same arguments give the same events.
std::size_t find_events(const MovementSettings& settings, const PlayerState& before, const PlayerState& after,
                        const StepContacts& contacts, std::span<StepEvent> out);

}  // namespace slipface
