// One walker's whole run of an audit, tick by tick.
#pragma once

#include <atomic>
#include <span>

#include "audit_walker.h"
#include "slipface/sim/audit.h"
#include "slipface/sim/simulate.h"

namespace slipface {

// What all walkers of an audit share.
struct AuditArena {
    const AuditOptions& options;
    PlayerState spawn;
    Aabb bounds;  // in the scene's coordinates; leaving it is leaving the level
    bool closed = false;
    std::uint64_t ticks = 0;           // of each walker, over all its lives
    std::atomic<bool> stopped{false};  // by AuditOptions::progress
};

// Asked to move all the time and came nowhere.
class StuckWatch {
  public:
    explicit StuckWatch(double dt);
    void begin(const Vec3& position);
    // True when the window is over and the walker did not get out of it. `position` is in the scene's
    // coordinates.
    bool tick(const MovementScene& scene, const MovementSettings& settings, const Vec3& position,
              bool held_on_purpose, const PlayerInput& input);

  private:
    std::uint64_t window_;
    Vec3 anchor_ = Vec3::Zero();
    std::uint64_t ticks_ = 0;
    bool was_free_ = false;
};

// The level at a tick, for all walkers.
struct AuditTick {
    const TickScene& level;
    const MovementScene& scene;
    std::vector<Pose> rides;  // rides_of its platforms
};

class AuditRun {
  public:
    AuditRun(AuditArena& arena, const MovementSettings& settings, std::uint32_t number);

    bool complete() const { return steps_ == arena_->ticks; }
    // The next tick, in the scene that the level is at that time of the life. False if the life is over: the
    // next one begins with the level, at time 0. `heat` may be null.
    bool tick(const AuditTick& now, std::vector<FaceHeat>* heat);

    void add_to(AuditReport& report) const;

  private:
    void begin_life();
    void check(const AuditTick& now, const PlayerState& before, const TickResult& result,
               const PlayerInput& input);
    void find(FindingKind kind, const Vec3& position, double amount, FaceId face);
    void add_heat(std::vector<FaceHeat>& heat, const MovementScene& scene, const PlayerState& before,
                  const PlayerState& after, const PlayerInput& input) const;

    AuditArena* arena_;
    MovementSettings settings_;
    std::uint32_t number_;
    Walker walker_;
    StuckWatch watch_;
    PlayerState state_;
    std::uint64_t tick_ = 0;  // of this life
    std::uint64_t life_hash_ = 0;
    std::array<bool, finding_names.size()> found_{};

    std::uint64_t steps_ = 0, lives_ = 0, hazards_ = 0, crushed_ = 0, left_ = 0, hash_ = 0;
    std::vector<AuditFinding> findings_;
};

// Walks all of them to their ends, side by side, so that the platforms are moved once a tick for all. Who
// leaves the level waits until all have, or are done: every life begins at time 0 of the level, as tapes do.
void walk_side_by_side(const TickScene& level, const AuditArena& arena, std::span<AuditRun> runs,
                       std::vector<FaceHeat>* heat);

}  // namespace slipface
