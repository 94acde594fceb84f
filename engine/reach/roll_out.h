// Rolling inputs out from a state, with notes of what is new.
#pragma once

#include <functional>
#include <unordered_map>

#include "slipface/reach/search.h"

namespace slipface {

// splitmix64 (Steele, Lea, Flood 2014).
class ReachRandom {
  public:
    explicit ReachRandom(std::uint64_t state) : state_(state) {}
    std::uint64_t bits();
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>((bits() >> 32) % count); }

  private:
    std::uint64_t state_;
};

// What moves near a cell makes time part of it: as where the platform is, never as the clock. A pause is one
// stage however long it is; so is the rest of the time after a path that does not repeat.
struct MovingArea {
    Aabb box;             // of all that the platform ever touches, and a jump around it; scene coordinates
    double period = 0.0;  // seconds; 0: it does not repeat
    std::vector<double> stages;  // when each begins, seconds, ascending from 0

    std::size_t stage(double time_s) const;
    // Seconds until the next stage begins; 0 if none does any more.
    double until_next(double time_s) const;
};

// What all roll-outs of a search share.
struct ReachWorld {
    const Level* level = nullptr;
    ReachOptions options;
    RunStart start;
    double cell_m = 0.5;
    double lowest = 0.0;             // nothing is below; scene coordinates
    std::vector<MovingArea> moving;  // [platform]
    std::vector<Vec3> goals;         // scene coordinates
    Vec3 home = Vec3::Zero();        // where a player at rest at the start stands; scene coordinates

    // The first that holds a position in the scene, by its index; moving.size() if none does.
    std::size_t moving_at(const Vec3& position) const;
    std::uint64_t cell_key(const MovementScene& scene, const PlayerState& state, std::uint32_t tick) const;
    bool is_home(const MovementScene& scene, const PlayerState& state) const;
    bool changes() const { return !moving.empty(); }
};

// A state that a roll-out came to, worth keeping: in a new cell, on a new face, at a goal, or sooner.
struct Found {
    ReachNode node;  // parent: where the roll-out began
    std::uint32_t first_press = 0, press_count = 0;
    FaceId face = no_id;  // stood on, if that is news
    std::uint32_t goal = no_id;
};

// All that the roll-outs from one node brought.
struct Harvest {
    std::vector<Found> found;
    std::vector<Press> presses;
    std::vector<ReachExit> exits;  // press ranges in `presses`
    std::vector<NodeId> reached;   // known nodes whose cells were entered, if `from` is not known to return
    std::uint64_t steps = 0;
};

// What is known before a round; read by many threads.
struct ReachKnown {
    const ReachArchive& archive;
    const std::vector<Reached>& faces;
    const std::vector<Reached>& goals;
    const std::unordered_map<std::uint64_t, std::uint32_t>& exit_at;  // [ReachExit::spot]; never iterated
};

// The level at any tick, for one thread. Moving platforms costs more than a step, and roll-outs from one node
// pass through the same ticks again and again: those are kept.
class TickScenes {
  public:
    TickScenes(LevelScene& level, double dt);
    const MovementScene& at(std::uint32_t tick);
    Vec3 to_level(const PlayerState& state) const { return still_.to_level(state); }
    const TickScene& still() const { return still_; }  // steps in order, without keeping any

  private:
    static constexpr std::size_t kept = 128;  // ticks: longer than most flights
    struct Kept {
        std::uint32_t tick = no_id;
        std::unique_ptr<LevelScene> level;
        std::optional<MovementScene> scene;
    };
    LevelScene& level_;
    double dt_;
    TickScene still_;
    std::optional<MovementScene> always_;  // where nothing moves
    std::vector<Kept> kept_;
};

// Sees every tick; for measuring.
using TickWatcher = std::function<void(const MovementScene& scene, const PlayerState& state,
                                       std::span<const Press> presses, std::uint32_t tick)>;

// The buttons that the second visit of each pair presses when something happens; none: visits are no pairs.
ButtonSet buttons_at_moments(const MovementSettings& settings);

// Rolls out from `from`, its visits number `first` to `last` - 1. The same arguments give the same harvest.
void roll_out(const ReachWorld& world, TickScenes& scenes, const ReachKnown& known, NodeId from,
              std::uint32_t first, std::uint32_t last, Harvest& harvest,
              const TickWatcher* watcher = nullptr);

}  // namespace slipface
