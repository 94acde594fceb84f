// Players that push each other and stand on each other.
#pragma once

#include <span>

#include "slipface/movement/rest.h"

namespace slipface {

struct CrowdMember {
    const MovementSettings* settings = nullptr;  // never null; with its own radii
    PlayerState state;                           // before, and then after the step
    PlayerInput input;
    const SceneFilter* filter = nullptr;  // instead of the scene's; other members meet it as meet() says
    StepContacts* contacts = nullptr;     // of its step, without other members
    Rest* rest = nullptr;  // the member's own, that the game keeps; null: a member at rest costs a step
};

// step() for each member, on all available threads: for players that pass through each other. The results do
// not depend on the order of the members, nor on the number of threads.
void step_many(const MovementScene& scene, std::span<CrowdMember> members, double dt);

// One step of `dt` seconds of all members: step() for each, and then those that met are kept apart.
//
// - Two bodies touch where their distance is 1 in the space in which the ellipsoid of the summed radii is the
//   unit sphere. That is exact for bodies of the same proportions; for a crouching body beside a standing one
//   it is a hundredth less than their distance.
// - A member that comes down on another one stands on it where the contact is no steeper than its
//   `max_slope`: it is grounded, with ground_face = no_id, is carried along, and can jump.
// - All other contacts push horizontally, each of the two by half; what a wall does not let one of them give
//   way, the other one does. They lose the speed at which they approached each other, each half of it. Of two
//   that want the same way the one behind does more of both, so that a crowd passes a door one by one.
// - All give way at once, in up to nine rounds, each by no more than the longest push that it gets: nobody's
// turn
//   comes first. In a pile a member sees 16 of those around it, and the next steps take the others apart.
// - Pushing moves a member only as slide_move() would: step()'s guarantee holds. Between a wall and a crowd,
//   members may overlap each other; the next steps take them apart.
//
// Members meet also if they would pass through each other within the step. The results have the same bits for
// every order of the members, unless two of them are at exactly the same position or more than 16 are in one
// place, and for every number of threads. Members whose state step() would return unchanged are passed
// through. Takes time in proportion to the number of members and contacts. Allocates memory; uses all
// available threads.
void step_crowd(const MovementScene& scene, std::span<CrowdMember> members, double dt);

}  // namespace slipface
