#include "audit_run.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "audit_checks.h"
#include "slipface/base/hash.h"
#include "slipface/movement/first_contact.h"
#include "step_attempts.h"

namespace slipface {
namespace {

constexpr double stuck_window_s = 2.0;
constexpr double stuck_free_s = 0.25;
constexpr double stuck_distance = 0.01;
constexpr double near_ground = 0.05;
constexpr double visit_gap_s = 0.5;
constexpr std::uint64_t triangles_per_step = 600;
constexpr std::uint64_t least_effort = 1'000'000;  // triangles, however short the audit

// The contacts of a step, for the heat map.
class HeatSink final : public TraceSink {
  public:
    HeatSink(std::vector<FaceHeat>& heat, RecentFaces& touched, std::uint64_t tick, const PlayerInput& input,
             const MovementSettings& settings, double dt)
        : heat_(heat),
          touched_(touched),
          tick_(tick),
          gap_(static_cast<std::uint64_t>(visit_gap_s / dt)),
          wish_(input.wish.x(), 0.0, input.wish.y()),
          wished_speed_(wish_.norm() * settings.walk_speed),
          dt_(dt) {
        if (const double length = wish_.norm(); length > 0.0) wish_ /= length;
    }
    void add(const TraceRecord& record) override {
        switch (std::visit([&](const auto& one) { return attempts_.note(one); }, record)) {
            case StepAttempts::Seen::begins: before_step_ = touched_now_.size(); break;
            case StepAttempts::Seen::acted:
                for (std::size_t i = 0; i < before_step_; ++i)
                    touched_now_[i].lost_us = 0;
                break;
            case StepAttempts::Seen::refused: touched_now_.resize(before_step_); break;
            case StepAttempts::Seen::nothing: break;
        }
        const auto* response = std::get_if<ResponseRecord>(&record);
        if (!response || response->face >= heat_.size()) return;
        touched_now_.push_back({response->face, 0});
        if (!(wished_speed_ > 0.0)) return;
        // Only what was wished counts: the floor takes the fall of every tick and costs nothing.
        const double lost =
            (response->remainder_before - response->remainder_after).dot(wish_) / wished_speed_;
        if (lost > 0.0) touched_now_.back().lost_us = static_cast<std::uint64_t>(1e6 * std::min(lost, dt_));
    }
    // After the tick.
    void finish() {
        for (const Touched& one : touched_now_) {
            FaceHeat& heat = heat_[one.face];
            if (touched_.arrives(one.face, tick_, gap_)) ++heat.visits;
            heat.lost_us += one.lost_us;
        }
    }

  private:
    struct Touched {
        FaceId face;
        std::uint64_t lost_us;
    };
    std::vector<FaceHeat>& heat_;
    RecentFaces& touched_;
    std::vector<Touched> touched_now_;
    StepAttempts attempts_;
    std::size_t before_step_ = 0;
    std::uint64_t tick_, gap_;
    Vec3 wish_;
    double wished_speed_, dt_;
};

// The two faces that hold a walker at `at`: the nearest, and the one that faces it most.
std::pair<FaceId, FaceId> holding_faces(const MovementScene& scene, const MovementSettings& settings,
                                        const Vec3& at) {
    const Vec3 radii = settings.radii.array() + 2.0 * settings.skin;
    std::vector<Overlap> touched;
    const auto look_in = [&](const auto& world) {
        std::array<Overlap, 64> found;
        const std::size_t count = std::min(found.size(), find_overlaps(world, radii, at, found));
        touched.insert(touched.end(), found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count));
    };
    look_in(scene.collision);
    for (const MovingPart& part : scene.platforms)
        look_in(part.at_end());
    std::pair<FaceId, FaceId> faces{no_id, no_id};
    const auto nearest = std::max_element(
        touched.begin(), touched.end(),
        [](const Overlap& a, const Overlap& b) { return a.depth_sphere_space < b.depth_sphere_space; });
    if (nearest == touched.end()) return faces;
    faces.first = nearest->face;
    double maximum = 1.0;
    for (const Overlap& other : touched) {
        const double along = other.normal.dot(nearest->normal);
        if (other.face == faces.first || along >= maximum) continue;
        maximum = along;
        faces.second = other.face;
    }
    return faces;
}

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

FaceHeat& FaceHeat::operator+=(const FaceHeat& more) {
    visits += more.visits;
    lost_us += more.lost_us;
    stood += more.stood;
    stuck += more.stuck;
    missed_ground += more.missed_ground;
    return *this;
}

StuckWatch::StuckWatch(double dt)
    : dt_(dt),
      window_(static_cast<std::uint64_t>(stuck_window_s / dt)),
      patience_(std::max<std::uint64_t>(2, static_cast<std::uint64_t>(std::ceil(stuck_free_s / dt)))) {}

void StuckWatch::begin(const Vec3& position) {
    anchor_ = position;
    ticks_ = 0;
    free_ = 0;
}

std::optional<double> StuckWatch::tick(const MovementScene& scene, const MovementSettings& settings,
                                       const Vec3& position, bool held_on_purpose, const PlayerInput& input) {
    if (held_on_purpose || (position - anchor_).norm() >= stuck_distance) {
        begin(position);
        return std::nullopt;
    }
    ++ticks_;
    // Looking is expensive, and a walker who stands still for a moment is no news.
    if (ticks_ + patience_ <= window_) return std::nullopt;
    if (input.wish != heading_) free_ = 0;
    heading_ = input.wish;
    free_ = path_is_free(scene, settings, position, input.wish) ? free_ + 1 : 0;
    if (ticks_ < window_ || free_ < patience_) return std::nullopt;
    const double seconds = static_cast<double>(ticks_) * dt_;
    begin(position);
    return seconds;
}

bool RecentFaces::arrives(FaceId face, std::uint64_t tick, std::uint64_t gap) {
    std::erase_if(touches_, [&](const Touch& touch) { return touch.tick + gap < tick; });
    const auto known = std::find_if(touches_.begin(), touches_.end(),
                                    [&](const Touch& touch) { return touch.face == face; });
    if (known == touches_.end()) {
        touches_.push_back({face, tick});
        return true;
    }
    known->tick = tick;
    return false;
}

AuditRun::AuditRun(AuditArena& arena, const MovementSettings& settings, std::uint32_t number)
    : arena_(&arena),
      settings_(settings),
      number_(number),
      walker_(arena.options.seed, number, 0, arena.options.dt, settings),
      watch_(arena.options.dt),
      effort_left_(std::max(triangles_per_step * arena.ticks, least_effort)) {
    begin_life();
}

void AuditRun::begin_life() {
    walker_ = Walker(arena_->options.seed, number_, static_cast<std::uint32_t>(lives_), arena_->options.dt,
                     settings_);
    start_ = &arena_->starts[start_of(number_, lives_, arena_->starts.size())];
    ++lives_;
    tick_ = 0;
    life_hash_ = 0;
    found_ = {};
    exit_.reset();
    last_ground_ = no_id;
    touched_ = {};
    state_ = start_->player;
    watch_.begin(state_.position);
}

AuditFinding AuditRun::finding_now(FindingKind kind, const Vec3& position,
                                   const std::optional<CheckFailure>& failure) const {
    AuditFinding finding{.kind = kind,
                         .walker = number_,
                         .life = static_cast<std::uint32_t>(lives_ - 1),
                         .tick = tick_,
                         .position = position};
    finding.hash = life_hash_;
    if (failure) {
        finding.amount = failure->amount;
        finding.face = failure->face;
    }
    return finding;
}

void AuditRun::find(AuditFinding finding) {
    bool& found = found_[static_cast<std::size_t>(finding.kind)];
    if (found) return;
    found = true;
    findings_.push_back(std::move(finding));
}

void AuditRun::note_exit(const AuditTick& now, const PlayerState& before, const PlayerState& after) {
    const auto& [level, scene, rides] = now;
    if (is_held(after)) last_ground_ = after.ground_face;
    const Vec3 at = position_in_scene(scene, after);
    if (!is_outside(arena_->level_bounds, at)) {
        exit_.reset();
    } else if (!exit_) {
        exit_ = finding_now(FindingKind::left_level, level.to_level(after));
        exit_->amount = (at - position_in_scene(scene, before)).norm();
        exit_->face = last_ground_;
    }
}

void AuditRun::check(const AuditTick& now, const PlayerState& before, const TickResult& result,
                     const PlayerInput& input) {
    const auto& [level, scene, rides] = now;
    const PlayerState& after = result.stepped;
    const Vec3 at = position_in_scene(scene, after);
    const Vec3 from = position_in_scene(scene, before);
    // Where the body changes, the lower one is in both.
    const MovementSettings body = settings_of_body(settings_, before.crouched ? before : after);
    // A platform that leaves a walker no room passes through it, and the walker's state is "trapped". That is
    // counted as hazards are; then only static geometry must hold.
    if (after.crushed) ++crushed_;
    const Against against =
        after.trapped || before.trapped ? Against::what_stands_still : Against::everything;
    // Nothing can have gone wrong where nothing moved.
    if (at != from || !scene.platforms.empty()) {
        if (const auto passed =
                passed_through(scene, rides, body, before, input, arena_->options.dt, at, against))
            find(finding_now(FindingKind::passed_through, level.to_level(after), passed));
        // The step's last check asked the same question of the same worlds with the whole ellipsoid. What it
        // found free holds nothing for a smaller one to overlap; tst_audit.cpp holds it to its word.
        const auto overlap = result.end_is_free
                                 ? std::nullopt
                                 : overlaps_deeply(scene, settings_of_body(settings_, after), at, against);
        if (overlap) find(finding_now(FindingKind::overlap, level.to_level(after), overlap));
    }
    if (const auto seconds = watch_.tick(scene, body, at, after.stuck, input)) {
        AuditFinding stuck = finding_now(FindingKind::stuck, level.to_level(after));
        stuck.amount = *seconds;
        std::tie(stuck.face, stuck.other) = holding_faces(scene, body, at);
        find(std::move(stuck));
    }
}

void AuditRun::add_heat(std::vector<FaceHeat>& heat, const MovementScene& scene, const PlayerState& before,
                        const PlayerState& after, const PlayerInput& input) const {
    const Vec3 at = position_in_scene(scene, after);
    const bool held = is_held(after);
    const Vec3 radii = body_radii(settings_, after);
    if (held && after.ground_face < heat.size()) {
        FaceHeat& face = heat[after.ground_face];
        ++face.stood;
        const double requested = input.wish.norm() * settings_.walk_speed * arena_->options.dt;
        if ((at - position_in_scene(scene, before)).norm() < 0.1 * requested) ++face.stuck;
    }
    if (!held && before.velocity.y() <= 0.0) {
        const auto below = first_contact(scene, radii, at, Vec3(0.0, -near_ground, 0.0));
        if (below && below->face < heat.size() && below->normal.y() >= std::cos(settings_.max_slope))
            ++heat[below->face].missed_ground;
    }
}

void AuditRun::spend_effort(const MovementScene& scene, const PlayerState& before) {
    const Vec3 at = position_in_scene(scene, before);
    const double motion = (before.velocity.norm() + settings_.walk_speed) * arena_->options.dt;
    const Vec3 reach = settings_.radii.array() + settings_.step_height + motion;
    effort_left_ -= std::min<std::uint64_t>(effort_left_, crowd_in(scene, {at - reach, at + reach}));
}

bool AuditRun::tick(const AuditTick& now, std::vector<FaceHeat>* heat) {
    const auto& [level, scene, rides] = now;
    const AuditOptions& options = arena_->options;
    std::optional<HeatSink> sink;
    const PlayerInput input = walker_.next();
    if (heat) sink.emplace(*heat, touched_, tick_, input, settings_, options.dt);
    const PlayerState before = state_;
    const TickResult result =
        play_tick(scene, settings_, before, input, options.dt, *start_, sink ? &*sink : nullptr);
    if (result.crowded) spend_effort(scene, before);
    if (sink) sink->finish();
    state_ = result.state;
    life_hash_ = state_hash(state_, life_hash_);
    ++steps_;
    ++tick_;
    check(now, before, result, input);
    note_exit(now, before, result.stepped);
    if (heat) add_heat(*heat, scene, before, result.stepped, input);

    if (result.respawn == Respawn::hazard || result.respawn == Respawn::crushed) {
        hazards_ += result.respawn == Respawn::hazard;
        watch_.begin(position_in_scene(scene, state_));
    }
    const bool left =
        result.respawn == Respawn::fall ||
        (result.respawn == Respawn::none && is_outside(arena_->bounds, position_in_scene(scene, state_)));
    // Through a face that should have held is one finding, not two.
    if (left && arena_->closed && exit_ && !found_[static_cast<std::size_t>(FindingKind::passed_through)])
        find(*exit_);
    if (left) {
        // A fall limit may lie inside the level; a walker below it has left nothing.
        if (result.respawn == Respawn::fall && !exit_) {
            ++falls_;
        } else if (!arena_->closed) {
            ++left_;
            if (exit_) exits_.push_back({exit_->face, 1, number_, exit_->position});
        }
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
    if (effort_left_ == 0) report.untried += arena_->ticks - steps_;
    report.lives += lives_;
    report.hazards += hazards_;
    report.crushed += crushed_;
    report.left += left_;
    report.exits.insert(report.exits.end(), exits_.begin(), exits_.end());
    report.falls += falls_;
    report.hash += hash_with(hash_, life_hash_);
    const auto first = static_cast<std::ptrdiff_t>(report.findings.size());
    for (const AuditFinding& finding : findings_) {
        ++report.counts[static_cast<std::size_t>(finding.kind)];
        report.findings.push_back(finding);
    }
    // A walker is known to have left some time after it did.
    std::stable_sort(report.findings.begin() + first, report.findings.end(),
                     [](const AuditFinding& a, const AuditFinding& b) {
                         return std::tie(a.life, a.tick) < std::tie(b.life, b.tick);
                     });
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
