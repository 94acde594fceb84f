// The story of a tick in plain words, line by line, from its trace and nothing else. Whatever explains
// movement to a person writes its sentences here: the Why panel, `slipface simulate --tell`, `slipface why`,
// the probe.
#pragma once

#include "slipface/level/level.h"
#include "slipface/sim/run.h"

namespace slipface {

// Where the names in a story come from.
struct StoryNames {
    SurfaceTable surfaces;
    const Mesh* mesh = nullptr;  // of groups and materials; null: faces have numbers only

    StoryNames() = default;
    StoryNames(SurfaceTable types, const Mesh* of = nullptr) : surfaces(types), mesh(of) {}
    StoryNames(const std::vector<SurfaceType>& types, const Mesh* of = nullptr) : surfaces(types), mesh(of) {}
    StoryNames(const Level& level) : surfaces(level.surfaces), mesh(level.mesh.get()) {}
};

// A number as a line says it, for tables and for holding it against the trace.
struct StoryNumber {
    double value = 0.0;  // in `unit`
    std::string unit;    // " mm", " m", " m/s", "°", " %", " s" or empty, as in the text
    std::string text;    // as it stands in the line, without its unit
};

enum class StoryTone : std::uint8_t {
    plain,    // what happened
    acted,    // a hack or rule did something
    refused,  // a hack or rule was queried and did not act
    trouble,  // most of the motion that was wished was lost, the player is inside geometry, or was put back
};

struct StoryLine {
    StoryTone tone = StoryTone::plain;
    int depth = 0;        // 0: a sweep, a push, the beginning, the end; 1: what belongs to the sweep above
    bool folded = false;  // happens in every tick of standing or walking: shown on request
    std::string title;    // of beginning, end and sweeps: "Begins", "Sweep 2, across"; else empty
    std::string text;     // "Touched an edge (face 7, ice), 0.2 m above the feet, after 31.2 of 100.0 mm"
    std::vector<StoryNumber> numbers;   // of the text, in order
    std::optional<std::size_t> record;  // in the trace; nothing for the beginning and the end
    std::optional<Vec3> position;       // where to look
    Vec3 normal = Vec3::Zero();         // of the contact, zero if there is none
    FaceId face = no_id;
    TriangleId triangle = no_id;
    const SettingInfo* hack = nullptr;  // the switch that decided
};

std::vector<StoryLine> describe(const TickTrace& trace, const StoryNames& names);
// Only the records, as of a probe.
std::vector<StoryLine> describe(std::span<const TraceRecord> records, const StoryNames& names,
                                const MovementSettings& settings = {});

// "Sweep 2, across: Touched ...": title and text.
std::string line_text(const StoryLine& line);
// The lines as text, one each, indented, as for a bug report. Folded lines too.
std::string story_text(std::span<const StoryLine> lines);

}  // namespace slipface
