#include "tools/audit_job.h"

#include <algorithm>
#include <cmath>

#include "slipface/mesh/mesh.h"

namespace slipface {

std::shared_ptr<AuditJob> AuditJob::start(const Document& document, const AuditSettings& settings) {
    std::shared_ptr<AuditJob> job(new AuditJob);
    job->settings = settings;
    job->level_ = document.level();
    job->face_revision_ = document.face_revision();
    job->options_.walkers = static_cast<std::uint32_t>(std::clamp(settings.walkers, 1, 100000));
    job->options_.duration_s = std::clamp(settings.duration_s, 1.0, 3600.0);
    job->options_.seed = static_cast<std::uint64_t>(std::max(settings.seed, 0));
    job->options_.heat = true;
    AuditJob* const self = job.get();  // outlived: the destructor waits for the thread
    job->thread_ = std::thread([self] {
        AuditOptions options = self->options_;
        options.progress = [self](std::uint64_t steps) {
            self->steps_ += steps;
            return !self->cancelled_;
        };
        Result<AuditReport> report = run_audit(self->level_, options);
        if (report)
            self->report_ = std::move(*report);
        else
            self->problem_ = report.error().text();
        self->done_ = true;
    });
    return job;
}

AuditJob::~AuditJob() {
    cancelled_ = true;
    if (thread_.joinable()) thread_.join();
}

double AuditJob::progress() const {
    const double all = options_.walkers * std::ceil(options_.duration_s / options_.dt);
    return all > 0.0 ? std::min(1.0, static_cast<double>(steps_.load()) / all) : 0.0;
}

bool AuditJob::fits(const Document& document) const {
    return level_.mesh == document.level().mesh && face_revision_ == document.face_revision();
}

double AuditJob::value(HeatKind of, FaceId face) const {
    const FaceHeat& heat = report_->heat[face];
    switch (of) {
        case HeatKind::lost_speed:
            return static_cast<double>(heat.lost_mm_s) / 1000.0;
        case HeatKind::stuck:
            return static_cast<double>(heat.stuck);
        case HeatKind::missed_ground:
            return static_cast<double>(heat.missed_ground);
        case HeatKind::visited:
            return static_cast<double>(heat.visited);
        case HeatKind::unreached: {
            const bool walkable = face_normal(*level_.mesh, face).y() >= std::cos(level_.movement.max_slope);
            return walkable && heat.visited == 0 ? 1.0 : 0.0;
        }
    }
    return 0.0;
}

double AuditJob::worst(HeatKind of) const {
    double most = 0.0;
    if (!report()) return most;
    for (std::size_t face = 0; face < report_->heat.size(); ++face)
        most = std::max(most, value(of, static_cast<FaceId>(face)));
    return most;
}

const std::vector<float>& AuditJob::heat(const Document& document, HeatKind of) const {
    if (!report() || !fits(document)) {
        heat_.clear();
        heat_kind_.reset();
        return heat_;
    }
    if (heat_kind_ == of) return heat_;
    heat_kind_ = of;
    heat_.assign(report_->heat.size(), 0.0f);
    const double most = worst(of);
    if (!(most > 0.0)) return heat_;
    // Few faces take most of it; the root makes the others visible.
    for (std::size_t face = 0; face < heat_.size(); ++face)
        heat_[face] = static_cast<float>(std::sqrt(value(of, static_cast<FaceId>(face)) / most));
    return heat_;
}

Tape AuditJob::tape_of(const AuditFinding& finding) const {
    return audit_tape(level_, options_, finding);
}

}  // namespace slipface
