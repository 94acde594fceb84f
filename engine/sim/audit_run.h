// One walker's whole run of an audit, tick by tick.
#pragma once

#include <atomic>
#include <optional>
#include <span>
#include <vector>

#include "audit_checks.h"
#include "audit_walker.h"
#include "slipface/sim/audit.h"
#include "slipface/sim/simulate.h"

namespace slipface {

// What all walkers of an audit share.
struct AuditArena {
    const AuditOptions& options;
    RunStart start;
    Aabb level_bounds;  // of all that the level holds, in the scene's coordinates
    Aabb bounds;        // larger than that; leaving it is leaving the level
    bool closed = false;
    std::uint64_t ticks = 0;           // of each walker, over all its lives
    std::atomic<bool> stopped{false};  // by AuditOptions::progress
};

// Asked to move all the time and came nowhere, at last for a quarter of a second along a free way: a walker
// who turns away from a wall is gone by then.
class StuckWatch {
  public:
    explicit StuckWatch(double dt);
    void begin(const Vec3& position);
    // Seconds without moving, once the walker counts as stuck. `position` is in the scene's coordinates,
    // after the tick of `input`.
    std::optional<double> tick(const MovementScene& scene, const MovementSettings& settings,
                               const Vec3& position, bool held_on_purpose, const PlayerInput& input);

  private:
    double dt_;
    std::uint64_t window_, patience_;  // ticks
    Vec3 anchor_ = Vec3::Zero();
    Vec2 heading_ = Vec2::Zero();
    std::uint64_t ticks_ = 0;
    std::uint64_t free_ = 0;  // latest ticks in a row on one heading whose way was free
};

// The faces that a walker touched lately, so that a visit of several ticks counts once.
class RecentFaces {
  public:
    // True if `face` was not touched in the `gap` ticks before `tick`.
    bool arrives(FaceId face, std::uint64_t tick, std::uint64_t gap);

  private:
    struct Touch {
        FaceId face = no_id;
        std::uint64_t tick = 0;
    };
    std::vector<Touch> touches_;
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
    AuditFinding finding_now(FindingKind kind, const Vec3& position,
                             const std::optional<CheckFailure>& failure = std::nullopt) const;
    void find(AuditFinding finding);
    // Where the walker is on its way out of the level, if it is.
    void note_exit(const AuditTick& now, const PlayerState& before, const PlayerState& after);
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
    std::array<bool, finding_kind_count> found_{};
    std::optional<AuditFinding> exit_;  // outside of the level's bounds since then
    FaceId last_ground_ = no_id;
    RecentFaces touched_;

    std::uint64_t steps_ = 0, lives_ = 0, hazards_ = 0, crushed_ = 0, left_ = 0, hash_ = 0;
    std::vector<AuditFinding> findings_;
};

// Walks all of them to their ends, side by side, so that the platforms are moved once a tick for all. Who
// leaves the level waits until all have, or are done: every life begins at time 0 of the level, as tapes do.
void walk_side_by_side(const TickScene& level, const AuditArena& arena, std::span<AuditRun> runs,
                       std::vector<FaceHeat>* heat);

}  // namespace slipface
