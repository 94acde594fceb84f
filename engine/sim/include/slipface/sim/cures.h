// Changes that would have let the player pass a stop: a switch, the smallest change of a number, another
// surface type on the face. Each one is found by running the same tape again with the change, and states its
// cost elsewhere on the tape.
#pragma once

#include <memory>

#include "slipface/sim/stops.h"

namespace slipface {

struct Cure {
    std::string text;                   // "Maximum slope 50° to 50.6°"
    std::string button;                 // "Turn on", "Set", "Paint", "Show"
    std::vector<std::string> settings;  // "max_slope=50.6deg"; empty: the cure changes the level
    FaceId face = no_id;                // the face to paint, or no_id
    SurfaceType type;                   // for that face; added to the level unless it has an equal one
    MeshPtr mesh;                       // the level's mesh repaired: the same faces, other corners; or null
    Vec3 position = Vec3::Zero();       // of a repair

    double gained_m = 0.0;  // additional motion towards the stick or up a ladder, until the trial ends
    bool passes = false;    // regains at least half of the lost motion, and the player is not sent back
    std::string cost;       // "costs 0.52 m before it"; empty: no cost found
    int bluntness = 0;      // 0: changes little else .. 5: removes the face from the game
    double change = 0.0;    // of a number, as a fraction of its old value
};

// Searches in slices, so that an editor stays responsive. The cures do not depend on the size of the slices.
class CureSearch {
  public:
    static constexpr double lead_s = 1.0;   // trials start this long before the stop: a jump may start there
    static constexpr double after_s = 1.5;  // and end this long after the start of the stop
    static constexpr std::size_t maximum = 6;  // maximum number of cures, all checked on the whole tape

    // `level` is copied (its mesh is shared); `run` is a complete run in it, `stop` one of the run's stops.
    // `repairs` are tried, too: cures with a mesh and without results.
    CureSearch(const Level& level, const TapeRun& run, const Stop& stop, std::vector<Cure> repairs = {});
    ~CureSearch();
    CureSearch(CureSearch&&) noexcept;
    CureSearch& operator=(CureSearch&&) noexcept;

    // Simulates about `ticks` further ticks; true when done.
    bool advance(std::size_t ticks);
    bool done() const;
    // Empty until done. Cures that pass come first, of these the ones without a cost on the tape, then the
    // ones that change least, then those that gain most. Cures that do not pass are
    // listed only where none passes.
    const std::vector<Cure>& cures() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Applies the cure to a level: its settings, its type to its face, or its mesh. Errors: an unknown setting,
// no such face, too many surface types.
Status apply_cure(Level& level, const Cure& cure);

// "Step up on: 1.20 m further" and the cost.
std::string cure_text(const Cure& cure);

}  // namespace slipface
