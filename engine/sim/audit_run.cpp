#include "audit_run.h"

#include <cmath>

#include "audit_checks.h"
#include "slipface/base/hash.h"

namespace slipface {
namespace {

constexpr double stuck_window_s = 2.0;
constexpr double stuck_distance = 0.01;
constexpr double near_ground = 0.05;

// The contacts of a step, for the heat map.
class HeatSink final : public TraceSink {
  public:
    HeatSink(std::vector<FaceHeat>& heat, double dt) : heat_(heat), dt_(dt) {}
    void add(const TraceRecord& record) override {
        const auto* response = std::get_if<ResponseRecord>(&record);
        if (!response || response->face >= heat_.size()) return;
        const double lost = (response->leftover_before.norm() - response->leftover_after.norm()) / dt_;
        if (lost > 0.0) heat_[response->face].lost_mm_s += static_cast<std::uint64_t>(1000.0 * lost);
    }

  private:
    std::vector<FaceHeat>& heat_;
    double dt_;
};

bool is_outside(const Aabb& box, const Vec3& at) {
    return (at.array() < box.min.array()).any() || (at.array() > box.max.array()).any();
}

// The hash of some lives and one more.
std::uint64_t hash_with(std::uint64_t lives, std::uint64_t life) {
    Hasher hasher;
    hasher.u64(lives);
    hasher.u64(life);
    return hasher.value();
}

}  // namespace

StuckWatch::StuckWatch(double dt) : window_(static_cast<std::uint64_t>(stuck_window_s / dt)) {}

void StuckWatch::begin(const Vec3& position) {
    anchor_ = position;
    ticks_ = 0;
    was_free_ = false;
}

bool StuckWatch::tick(const MovementScene& scene, const MovementSettings& settings, const Vec3& position,
                      bool held_on_purpose, const PlayerInput& input) {
    if (held_on_purpose || (position - anchor_).norm() >= stuck_distance) {
        begin(position);
        return false;
    }
    ++ticks_;
    // Looking is expensive, and a walker who stands still for a moment is no news.
    if (ticks_ * 2 >= window_ && !was_free_) was_free_ = way_is_free(scene, settings, position, input.wish);
    if (ticks_ < window_) return false;
    const bool stuck = was_free_;
    begin(position);
    return stuck;
}

AuditRun::AuditRun(AuditArena& arena, const MovementSettings& settings, std::uint32_t number)
    : arena_(&arena),
      settings_(settings),
      number_(number),
      walker_(arena.options.seed, number, 0, arena.options.dt),
      watch_(arena.options.dt) {
    begin_life();
}

void AuditRun::begin_life() {
    walker_ = Walker(arena_->options.seed, number_, static_cast<std::uint32_t>(lives_), arena_->options.dt);
    ++lives_;
    tick_ = 0;
    life_hash_ = 0;
    found_ = {};
    state_ = arena_->spawn;
    watch_.begin(state_.position);
}

void AuditRun::find(FindingKind kind, const Vec3& position, double amount, FaceId face) {
    bool& found = found_[static_cast<std::size_t>(kind)];
    if (found) return;
    found = true;
    findings_.push_back(
        {kind, number_, static_cast<std::uint32_t>(lives_ - 1), tick_, position, amount, face, life_hash_});
}

void AuditRun::check(const AuditTick& now, const PlayerState& before, const TickResult& result,
                     const PlayerInput& input) {
    const auto& [level, scene, rides] = now;
    const PlayerState& after = result.stepped;
    const Vec3 at = position_in_scene(scene, after);
    const Vec3 from = position_in_scene(scene, before);
    // A platform that leaves a walker no room goes through him, and he is told that he is trapped. That is
    // counted, as hazards are; then only what stands still must hold.
    if (after.trapped && !before.trapped) ++crushed_;
    const Against against =
        after.trapped || before.trapped ? Against::what_stands_still : Against::everything;
    // Nothing can have gone wrong where nothing moved.
    if (at != from || !scene.platforms.empty()) {
        if (const auto passed =
                passed_through(scene, rides, settings_, before, input, arena_->options.dt, at, against))
            find(FindingKind::escape, level.to_level(after), passed->amount, passed->face);
        // The step's last check asked the same question of the same worlds with the whole ellipsoid. What it
        // found free holds nothing for a smaller one to overlap; tst_audit.cpp holds it to its word.
        const auto overlap =
            result.end_is_free ? std::nullopt : overlaps_deeply(scene, settings_, at, against);
        if (overlap) find(FindingKind::overlap, level.to_level(after), overlap->amount, overlap->face);
    }
    if (watch_.tick(scene, settings_, at, after.stuck, input))
        find(FindingKind::stuck, level.to_level(after), (at - from).norm(), after.ground_face);
}

void AuditRun::add_heat(std::vector<FaceHeat>& heat, const MovementScene& scene, const PlayerState& before,
                        const PlayerState& after, const PlayerInput& input) const {
    const Vec3 at = position_in_scene(scene, after);
    const bool held = after.grounded || after.climbing || after.stuck;
    if (held && after.ground_face < heat.size()) {
        FaceHeat& face = heat[after.ground_face];
        ++face.visited;
        const double asked = input.wish.norm() * settings_.walk_speed * arena_->options.dt;
        if ((at - position_in_scene(scene, before)).norm() < 0.1 * asked) ++face.stuck;
    }
    if (!held && before.velocity.y() <= 0.0) {
        const auto below = first_touch(scene, settings_.radii, at, Vec3(0.0, -near_ground, 0.0));
        if (below && below->face < heat.size() && below->normal.y() >= std::cos(settings_.max_slope))
            ++heat[below->face].missed_ground;
    }
}

bool AuditRun::tick(const AuditTick& now, std::vector<FaceHeat>* heat) {
    const auto& [level, scene, rides] = now;
    const AuditOptions& options = arena_->options;
    std::optional<HeatSink> sink;
    if (heat) sink.emplace(*heat, options.dt);
    const PlayerInput input = walker_.next();
    const PlayerState before = state_;
    const TickResult result =
        play_tick(scene, settings_, before, input, options.dt, arena_->spawn, sink ? &*sink : nullptr);
    state_ = result.state;
    life_hash_ = state_hash(state_, life_hash_);
    ++steps_;
    ++tick_;
    check(now, before, result, input);
    if (heat) add_heat(*heat, scene, before, result.stepped, input);

    if (result.respawn == Respawn::hazard) {
        ++hazards_;
        watch_.begin(position_in_scene(scene, state_));
    }
    const bool left =
        result.respawn == Respawn::fall ||
        (result.respawn == Respawn::none && is_outside(arena_->bounds, position_in_scene(scene, state_)));
    if (left && arena_->closed) {
        const double made =
            (position_in_scene(scene, result.stepped) - position_in_scene(scene, before)).norm();
        find(FindingKind::escape, level.to_level(result.stepped), made, no_id);
    }
    if (left) {
        if (!arena_->closed) ++left_;
        hash_ = hash_with(hash_, life_hash_);
        begin_life();
    }
    if (options.progress) {
        const auto second = static_cast<std::uint64_t>(std::max(1.0, 1.0 / options.dt));
        if (steps_ % second == 0 && !options.progress(second)) arena_->stopped = true;
    }
    return !left;
}

void AuditRun::add_to(AuditReport& report) const {
    report.steps += steps_;
    report.lives += lives_;
    report.hazards += hazards_;
    report.crushed += crushed_;
    report.left += left_;
    report.hash += hash_with(hash_, life_hash_);
    for (const AuditFinding& finding : findings_) {
        ++report.counts[static_cast<std::size_t>(finding.kind)];
        report.findings.push_back(finding);
    }
}

void walk_side_by_side(const TickScene& level, const AuditArena& arena, std::span<AuditRun> runs,
                       std::vector<FaceHeat>* heat) {
    std::vector<AuditRun*> walking;
    for (;;) {
        for (AuditRun& run : runs) {
            if (!run.complete()) walking.push_back(&run);
        }
        if (walking.empty()) return;
        for (std::size_t tick = 0; !walking.empty(); ++tick) {
            const MovementScene scene = level.at(tick, arena.options.dt);
            const AuditTick now{level, scene, rides_of(scene.platforms)};
            if (arena.stopped) return;
            std::erase_if(walking, [&](AuditRun* run) { return !run->tick(now, heat) || run->complete(); });
        }
    }
}

}  // namespace slipface
