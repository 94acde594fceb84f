#include "tools/lab/audit_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "slipface/level/find_start.h"
#include "slipface/mesh/mesh.h"
#include "slipface/reach/search.h"

namespace slipface {

namespace {

constexpr HeatInfo heat_infos[] = {
    {"Seconds lost per visit", "s per visit"},
    {"Time that walkers pushed the stick on a face but hardly moved, all walkers together", "s"},
    {"Time spent falling close above a face without ground contact, all walkers together", "s"},
    {"Seconds all walkers spent on this face", "s"},
    {"Walkable faces that no walker reached", ""},
};
static_assert(std::size(heat_infos) == heat_names.size());

constexpr std::uint64_t search_rounds = 100;

}  // namespace

const HeatInfo& info_of(HeatKind kind) {
    return heat_infos[static_cast<std::size_t>(kind)];
}

std::string heat_text(HeatKind kind, double value) {
    const int digits = value >= 100.0 ? 0 : value >= 10.0 ? 1 : value >= 0.1 ? 2 : 3;
    return fmt::format("{:.{}f} {}", value, value == 0.0 ? 0 : digits, info_of(kind).unit);
}

std::shared_ptr<AuditJob> AuditJob::start(const Document& document, const AuditSettings& settings) {
    std::shared_ptr<AuditJob> job(new AuditJob);
    job->settings = settings;
    job->level_ = std::make_shared<Level>(document.level());
    job->face_revision_ = document.face_revision();
    job->work_ = std::make_unique<Background<Result<Audited>>>(
        [level = job->level_, settings](Progress& progress) { return run(*level, settings, progress); },
        std::function<void()>());
    return job;
}

Result<AuditJob::Audited> AuditJob::run(Level& level, const AuditSettings& settings, Progress& progress) {
    AuditOptions options;
    options.walkers = static_cast<std::uint32_t>(std::clamp(settings.walkers, 1, 100000));
    options.duration_s = std::clamp(settings.duration_s, 1.0, 3600.0);
    options.seed = static_cast<std::uint64_t>(std::max(settings.seed, 0));
    options.heat = true;
    const Result<Start> start = settle_start(level);
    if (!start) return start.error();
    if (settings.everywhere) {
        Result<ReachSearch> search = ReachSearch::begin(level, start->position, {});
        if (!search) return search.error();
        ReachLimits limits;
        limits.rounds = search_rounds;
        search->run(limits, &progress);
        auto starts = usable_starts(level, search->standing_places(options.walkers), options.dt);
        if (!starts) return starts.error();
        options.starts = std::move(*starts);
    }
    progress.begin("Walking", 0.0, 1.0);
    const double all = options.walkers * std::ceil(options.duration_s / options.dt);
    std::atomic<std::uint64_t> done{0};
    AuditOptions watched = options;
    watched.progress = [&](std::uint64_t steps) {
        progress.advance(static_cast<double>(done += steps) / all);
        return !progress.cancelled();
    };
    Result<AuditReport> report = run_audit(level, watched);
    if (!report) return report.error();
    return Audited{std::move(options), std::move(*report)};
}

const AuditJob::Audited* AuditJob::audited() const {
    const Result<Audited>* const result = work_->result();
    return result != nullptr && *result ? &**result : nullptr;
}

const AuditReport* AuditJob::report() const {
    return audited() != nullptr ? &audited()->report : nullptr;
}

std::string AuditJob::problem() const {
    const Result<Audited>* const result = work_->result();
    return result == nullptr || *result ? "" : result->error().text();
}

bool AuditJob::fits(const Document& document) const {
    return level_->mesh == document.level().mesh && face_revision_ == document.face_revision();
}

double AuditJob::value(HeatKind of, FaceId face) const {
    const FaceHeat& heat = report()->heat[face];
    switch (of) {
        case HeatKind::lost_time:
            return heat.visits == 0
                       ? 0.0
                       : 1e-6 * static_cast<double>(heat.lost_us) / static_cast<double>(heat.visits);
        case HeatKind::stuck: return static_cast<double>(heat.stuck) * audited()->options.dt;
        case HeatKind::missed_ground: return static_cast<double>(heat.missed_ground) * audited()->options.dt;
        case HeatKind::visited: return static_cast<double>(heat.stood) * audited()->options.dt;
        case HeatKind::unreached: {
            const bool walkable =
                face_normal(*level_->mesh, face).y() >= std::cos(level_->movement.max_slope);
            return walkable && heat.stood == 0 ? 1.0 : 0.0;
        }
    }
    return 0.0;
}

double AuditJob::worst(HeatKind of) const {
    double maximum = 0.0;
    if (!report()) return maximum;
    for (std::size_t face = 0; face < report()->heat.size(); ++face)
        maximum = std::max(maximum, value(of, static_cast<FaceId>(face)));
    return maximum;
}

const std::vector<float>& AuditJob::heat(const Document& document, HeatKind of) const {
    if (!report() || !fits(document)) {
        heat_.clear();
        heat_kind_.reset();
        return heat_;
    }
    if (heat_kind_ == of) return heat_;
    heat_kind_ = of;
    heat_.assign(report()->heat.size(), 0.0f);
    const double maximum = worst(of);
    if (!(maximum > 0.0)) return heat_;
    // A few faces have most of the value; the square root makes the others visible.
    for (std::size_t face = 0; face < heat_.size(); ++face)
        heat_[face] = static_cast<float>(std::sqrt(value(of, static_cast<FaceId>(face)) / maximum));
    return heat_;
}

Tape AuditJob::tape_of(const AuditFinding& finding) const {
    return audit_tape(*level_, audited()->options, finding);
}

}  // namespace slipface
