#include "tools/lab/probe.h"

#include <algorithm>
#include <cmath>

#include "slipface/base/text.h"
#include "slipface/collision/collision_world.h"
#include "slipface/sim/probe_test.h"

namespace slipface {
namespace {

std::string vector_text(const Vec3& vector) {
    return to_text(vector.x()) + "," + to_text(vector.y()) + "," + to_text(vector.z());
}

// One word for a POSIX shell.
std::string shell_word(const std::string& text) {
    const auto plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("/._-+,:@%").find(c) != std::string_view::npos;
    };
    if (!text.empty() && text.front() != '-' && std::all_of(text.begin(), text.end(), plain)) return text;
    std::string quoted = text.starts_with('-') ? "./'" : "'";
    for (const char c : text)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace

void Probe::place_on(const Vec3& point, const Vec3& normal, const MovementSettings& settings) {
    if (!point.allFinite()) return;
    const double length = normal.norm();
    const Vec3 away = length > 0.0 && std::isfinite(length) ? Vec3(normal / length) : Vec3(Vec3::UnitY());
    // The point of an ellipsoid whose outward normal is -away lies at centre - R^2 away / |R away|.
    const Vec3 scaled = settings.radii.cwiseProduct(away);
    from = point + settings.radii.cwiseProduct(scaled) / scaled.norm() + away * settings.skin;
    placed = true;
}

ProbeResult run_probe(const Probe& probe, const MovementScene& scene, const MovementSettings& settings) {
    ProbeResult result;
    TraceRecorder recorder;
    result.slide = slide_move(scene, settings, probe.from, probe.move, &recorder);
    result.records = std::move(recorder.records);
    result.starts_overlapping = overlaps_any(scene.collision, settings.radii, probe.from);
    return result;
}

std::vector<ProbeRow> probe_rows(std::span<const TraceRecord> records) {
    std::vector<ProbeRow> rows;
    for (const TraceRecord& record : records) {
        if (const auto* sweep = std::get_if<SweepRecord>(&record)) {
            rows.push_back({*sweep, std::nullopt});
        } else if (const auto* response = std::get_if<ResponseRecord>(&record); response && !rows.empty()) {
            // Several rules may change one remainder in turn; the row shows the first and the last value.
            std::optional<ResponseRecord>& joined = rows.back().response;
            const Vec3 before = joined ? joined->remainder_before : response->remainder_before;
            joined = *response;
            joined->remainder_before = before;
        }
    }
    return rows;
}

std::span<const TraceRecord> first_sweeps(std::span<const TraceRecord> records, std::size_t sweeps) {
    for (std::size_t i = 0; i < records.size(); ++i) {
        if (!std::holds_alternative<SweepRecord>(records[i])) continue;
        if (sweeps == 0) return records.first(i);
        --sweeps;
    }
    return records;
}

std::string probe_test_text(const Probe& probe, const Document& document) {
    const Level& level = document.level();
    ProbeTest test = make_probe_test(document.scene(), level.movement, probe.from, probe.move);
    test.level_name = level.mesh_path.filename().string();
    test.level_fingerprint = document.level().mesh.fingerprint();
    return probe_test_to_text(test);
}

std::string probe_command_line(const Probe& probe, const MovementSettings& settings,
                               const std::string& level) {
    // With '=' a negative first number cannot be taken for an option.
    return "slipface sweep " + shell_word(level) + " --radii=" + vector_text(settings.radii) +
           " --from=" + vector_text(probe.from) + " --move=" + vector_text(probe.move);
}

}  // namespace slipface
