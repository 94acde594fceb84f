// The sweep probe: an ellipsoid placed in the level, a displacement dragged from it, and what
// collide-and-slide makes of it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "document/document.h"

namespace slipface {

struct Probe {
    bool placed = false;
    Vec3 from = Vec3::Zero();  // centre
    Vec3 move = Vec3::Zero();  // metres
    // How many of the sweeps are shown, counted from the first; nothing: all.
    std::optional<std::size_t> shown_sweeps = std::nullopt;

    // Positions the ellipsoid on a surface hit at `point` with `normal`, just clear of it.
    void place_on(const Vec3& point, const Vec3& normal, const MovementSettings& settings);
};

struct ProbeResult {
    SlideResult slide;
    std::vector<TraceRecord> records;
    bool starts_overlapping = false;
};
ProbeResult run_probe(const Probe& probe, const MovementScene& scene, const MovementSettings& settings);

// One sweep and the response to its contact, as a row of a table.
struct ProbeRow {
    SweepRecord sweep;
    std::optional<ResponseRecord> response;
};
std::vector<ProbeRow> probe_rows(std::span<const TraceRecord> records);

// The records of the first `sweeps` sweeps, each with its response.
std::span<const TraceRecord> first_sweeps(std::span<const TraceRecord> records, std::size_t sweeps);

// The probe as the text of a test, which `slipface sweep LEVEL --test FILE` runs.
std::string probe_test_text(const Probe& probe, const Document& document);

// The command line that repeats the probe's first sweep.
std::string probe_command_line(const Probe& probe, const MovementSettings& settings,
                               const std::string& level);

}  // namespace slipface
