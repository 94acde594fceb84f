// An audit that runs in a background thread, and its results.
#pragma once

#include <memory>

#include "document/background.h"
#include "document/document.h"
#include "slipface/sim/audit.h"

namespace slipface {

enum class HeatKind { lost_time, stuck, missed_ground, visited, unreached };
inline constexpr std::array<const char*, 5> heat_names{"Lost time", "Stuck", "Missed ground", "Visited",
                                                       "Never visited"};

// One row per kind: what the panel, its tooltips and the legend in the view say.
struct HeatInfo {
    const char* meaning;
    const char* unit;  // of the values; empty for yes or no
};
const HeatInfo& info_of(HeatKind kind);
std::string heat_text(HeatKind kind, double value);  // "0.12 s per visit"

struct AuditSettings {
    int walkers = 60;
    double duration_s = 30.0;  // simulated, per walker
    int seed = 1;
    bool everywhere = false;  // walkers start wherever a short search gets, not only at the spawn
};

class AuditJob {
  public:
    // Copies what it needs from the document and starts at once.
    static std::shared_ptr<AuditJob> start(const Document& document, const AuditSettings& settings);

    bool running() const { return !work_->ready(); }
    double progress() const { return work_->progress().fraction(); }  // 0..1
    void cancel() { work_->cancel(); }
    // After the end: the report; null if there is none, and then problem() says why.
    const AuditReport* report() const;
    std::string problem() const;
    // True if the audited level is the open one and its geometry and surfaces have not changed.
    bool fits(const Document& document) const;

    // [face] square root of its value as a fraction of the worst in the level, 0..1; empty if there is no
    // report or it does not fit. `unreached` is 1 for faces that a player could stand on and no walker
    // reached.
    const std::vector<float>& heat(const Document& document, HeatKind kind) const;
    double worst(HeatKind kind) const;  // on one face, in the kind's unit
    // The value of a face with this heat. The square root makes small values visible.
    double value_at(HeatKind of, double fraction) const { return fraction * fraction * worst(of); }
    // The run of a finding up to the tick at which the error occurred.
    Tape tape_of(const AuditFinding& finding) const;

    AuditSettings settings;
    HeatKind kind = HeatKind::lost_time;
    bool show_heat = true;
    std::optional<std::size_t> opened;  // finding that was opened last

  private:
    struct Audited {
        AuditOptions options;  // with the places where the walkers started
        AuditReport report;
    };

    AuditJob() = default;
    static Result<Audited> run(Level& level, const AuditSettings& settings, Progress& progress);
    const Audited* audited() const;
    double value(HeatKind kind, FaceId face) const;

    std::shared_ptr<Level> level_;  // the work makes it begin where a player fits
    std::uint64_t face_revision_ = 0;
    std::unique_ptr<Background<Result<Audited>>> work_;
    mutable std::optional<HeatKind> heat_kind_;
    mutable std::vector<float> heat_;
};

}  // namespace slipface
