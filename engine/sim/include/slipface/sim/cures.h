// Changes that would have let the player pass a stop: a switch, the smallest change of a number, another
// surface type on the face. Each one is found by running the same tape again with the change, and states its
// cost in the quarter minute before the stop and shortly after it.
#pragma once

#include <functional>

#include "slipface/sim/stops.h"

namespace slipface {

struct Cure {
    std::string text;                   // "Maximum slope 50° to 50.6°"
    std::string button;                 // "Turn on", "Set", "Paint", "Show"
    std::vector<std::string> settings;  // "max_slope=50.6deg"; empty: the cure changes the level
    std::vector<FaceId> faces;          // to paint; empty: none
    SurfaceType type;                   // for those faces; added to the level unless it has an equal one
    MeshPtr mesh;                       // the level's mesh repaired: the same faces, other corners; or null
    Vec3 position = Vec3::Zero();       // of a repair

    double gained_m = 0.0;  // additional motion towards the stick or up a ladder, until the trial ends
    bool passes = false;    // regains at least half of the lost motion, and the player is not sent back
    std::string cost;       // "costs 0.52 m before it"; empty: no cost found
    int bluntness = 0;      // 0: changes little else .. 5: removes the face from the game
    double change = 0.0;    // of a number, as a fraction of its old value
};

// Cures of one of the run's stops, at most six. `run` is a complete run in the level. `repairs` are tried,
// too: cures with a mesh and without results. `cancelled` is asked between trials; what is found then is of
// no use.
//
// Those that pass come first, of these the ones without a cost, then the ones that change least, then those
// that gain most. A cure passes only if it does so from ten starts that differ by parts of a tick and by
// millimetres: a change that only shifts the timing is none. Numbers are the smallest that do. What does not
// pass is listed only where nothing passes.
std::vector<Cure> find_cures(
    const Level& level, const TapeRun& run, const Stop& stop, std::vector<Cure> repairs = {},
    const std::function<bool()>& cancelled = [] { return false; });

// Applies the cure to a level: its settings, its type to its faces, or its mesh. Errors: an unknown setting,
// no such face, too many surface types.
Status apply_cure(Level& level, const Cure& cure);

// "Step up on: 1.20 m further" and the cost.
std::string cure_text(const Cure& cure);

}  // namespace slipface
