// One walker's run of an audit, tick by tick.
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

// Index of the start of a walker's life, of so many.
inline std::size_t start_of(std::uint32_t walker, std::uint64_t life, std::size_t starts) {
    return static_cast<std::size_t>((walker + life) % starts);
}

// The data that all walkers of an audit share.
struct AuditArena {
    const AuditOptions& options;
    std::vector<RunStart> starts;  // at least one
    Aabb level_bounds;             // of all parts of the level at all times, in the scene's coordinates
    Aabb bounds;                   // larger; a walker outside of it has left the level
    bool closed = false;
    std::uint64_t ticks = 0;           // of each walker, over all its lives
    std::atomic<bool> stopped{false};  // set by AuditOptions::progress
};

// Detects a walker that is stuck: it moved nowhere in spite of its inputs, and at the end its path was free
// for a quarter of a second on one heading. A walker that turns away from a wall is gone by then.
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
    std::uint64_t free_ = 0;  // latest ticks in a row on one heading with a free path
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

// The level in a tick, for all walkers.
struct AuditTick {
    const TickScene& level;
    const MovementScene& scene;
    std::vector<Pose> rides;  // rides_of() its platforms
};

class AuditRun {
  public:
    AuditRun(AuditArena& arena, const MovementSettings& settings, std::uint32_t number);

    bool complete() const { return steps_ == arena_->ticks || effort_left_ == 0; }
    // Simulates the next tick. `now` is the level at that time of the life. False if the life is over: the
    // next one starts at the level's time 0. `heat` may be null.
    bool tick(const AuditTick& now, std::vector<FaceHeat>* heat);

    void add_to(AuditReport& report) const;

  private:
    void begin_life();
    // After a step among very many triangles.
    void spend_effort(const MovementScene& scene, const PlayerState& before);
    void check(const AuditTick& now, const PlayerState& before, const TickResult& result,
               const PlayerInput& input);
    AuditFinding finding_now(FindingKind kind, const Vec3& position,
                             const std::optional<CheckFailure>& failure = std::nullopt) const;
    void find(AuditFinding finding);
    // Stores in exit_ where the walker left the level's bounds, until it comes back.
    void note_exit(const AuditTick& now, const PlayerState& before, const PlayerState& after);
    void add_heat(std::vector<FaceHeat>& heat, const MovementScene& scene, const PlayerState& before,
                  const PlayerState& after, const PlayerInput& input) const;

    AuditArena* arena_;
    MovementSettings settings_;
    std::uint32_t number_;
    Walker walker_;
    StuckWatch watch_;
    const RunStart* start_ = nullptr;  // of this life
    PlayerState state_;
    std::uint64_t tick_ = 0;  // of this life
    std::uint64_t life_hash_ = 0;
    std::array<bool, finding_kind_count> found_{};
    std::optional<AuditFinding> exit_;  // the tick since which it is outside of the level's bounds
    FaceId last_ground_ = no_id;
    RecentFaces touched_;
    // Triangles that a query of each step among very many may still look at: without a bound some levels,
    // whose boxes do not tell triangles apart, would take hours.
    std::uint64_t effort_left_;

    std::uint64_t steps_ = 0, lives_ = 0, hazards_ = 0, crushed_ = 0, left_ = 0, falls_ = 0, hash_ = 0;
    std::vector<AuditFinding> findings_;
    std::vector<AuditExit> exits_;
};

// Simulates all runs to their ends, side by side, so that platforms move once per tick for all. A walker that
// leaves the level waits until all others have left it or are done, because every life starts at the level's
// time 0, like a tape.
void walk_side_by_side(const TickScene& level, const AuditArena& arena, std::span<AuditRun> runs,
                       std::vector<FaceHeat>* heat);

}  // namespace slipface
