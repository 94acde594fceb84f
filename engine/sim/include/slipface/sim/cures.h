// What would have let the player pass a stop: switches, the smallest change of a number, another surface type
// on the face. Each is found by running the same tape again with the change, and says what it costs
// elsewhere.
#pragma once

#include <memory>

#include "slipface/sim/stops.h"

namespace slipface {

struct Cure {
    std::string text;                   // "Maximum slope 50° to 50.6°"
    std::string button;                 // "Turn on", "Set", "Paint"
    std::vector<std::string> settings;  // "max_slope=50.6deg"; empty: the cure paints
    FaceId face = no_id;                // painted, else no_id
    SurfaceType type;                   // that the face gets; added to the level if it has none like it

    double gained_m = 0.0;  // towards the stick until `until`, more than without the change
    bool passes = false;    // makes up for at least half of what the stop took, without being sent back
    std::string cost;       // "then falls out of the level"; empty: nothing found
    int bluntness = 0;      // 0: changes little else .. 5: takes the face out of the game
    double change = 0.0;    // of a number, as a fraction of what it was
};

// Searches in slices, so that an editor stays quick. The same arguments give the same cures, however it is
// sliced.
class CureSearch {
  public:
    static constexpr double lead_s = 1.0;   // begins this long before the stop: a jump onto it starts there
    static constexpr double after_s = 1.5;  // and watches this long from its beginning on
    static constexpr std::size_t maximum = 6;  // cures that are checked on the whole tape and kept

    // `level` is copied (its mesh is shared); `run` is a complete run in it, and `stop` one of its stops.
    CureSearch(const Level& level, const TapeRun& run, const Stop& stop);
    ~CureSearch();
    CureSearch(CureSearch&&) noexcept;
    CureSearch& operator=(CureSearch&&) noexcept;

    // Works on for about as many ticks; true when done.
    bool advance(std::size_t ticks);
    bool done() const;
    // Those that pass come first, the ones that change least before all, then those that gain most. Final
    // when done, empty before.
    const std::vector<Cure>& cures() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

std::vector<Cure> find_cures(const Level& level, const TapeRun& run, const Stop& stop);

// Takes the cure into a level: its settings, or its type and the painted face.
Status apply_cure(Level& level, const Cure& cure);

// "Step up on: 1.20 m further" and what it costs.
std::string cure_text(const Cure& cure);

}  // namespace slipface
