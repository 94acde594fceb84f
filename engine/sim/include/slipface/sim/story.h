// The story of a tick in plain words, line by line, from its trace alone. All explanations of movement use
// these sentences: the Why panel, `slipface simulate --describe`, `slipface why`, the probe.
#pragma once

#include "slipface/level/level.h"
#include "slipface/sim/run.h"

namespace slipface {

// The source of the names in a story.
struct StoryNames {
    SurfaceTable surfaces;
    LevelMesh mesh;  // of groups and materials; null: faces have numbers only

    StoryNames() = default;
    StoryNames(SurfaceTable types) : surfaces(types) {}
    StoryNames(const std::vector<SurfaceType>& types) : surfaces(types) {}
    StoryNames(const Level& level) : surfaces(level.surfaces), mesh(level.mesh) {}
};

// "`stairs` (face 12)": the group if there is more than one, else the material; "face 12" if neither has a
// name, "the air" for no face.
std::string thing_text(const StoryNames& names, FaceId face);
std::string size_text(double metres);  // of things: "0.25 m", "3 mm"

// A number in a line, for tables and for comparison with the trace.
struct StoryNumber {
    double value = 0.0;  // in `unit`
    std::string unit;    // " mm", " m", " m/s", "°", " %", " s" or empty, as in the text
    std::string text;    // as written in the line, without its unit
};

enum class StoryTone : std::uint8_t {
    plain,    // what happened
    acted,    // a hack or rule did something
    refused,  // a hack or rule was queried and did not act
    trouble,  // most of the requested motion was lost, or the player is inside geometry or was sent back
};

struct StoryLine {
    StoryTone tone = StoryTone::plain;
    int depth = 0;        // 0: a sweep, a push, the beginning, the end; 1: belongs to the sweep above
    bool folded = false;  // happens in every tick of standing or walking; shown only on request
    std::string title;    // of beginning, end and sweeps: "Begins", "Sweep 2, across"; else empty
    std::string text;     // "Touched an edge (face 7, ice), 0.2 m above the feet, after 31.2 of 100.0 mm"
    std::vector<StoryNumber> numbers;   // of the text, in order
    std::optional<std::size_t> record;  // index in the trace; nothing for the beginning and the end
    std::optional<Vec3> position;       // the point to look at, in the trace's coordinates
    Vec3 normal = Vec3::Zero();         // of the contact, zero if there is none
    FaceId face = no_id;
    TriangleId triangle = no_id;
    const SettingInfo* hack = nullptr;  // the switch that decided
};

// The lines of a tick, from its beginning to its end.
std::vector<StoryLine> describe(const TickTrace& trace, const StoryNames& names);
// The lines of the records alone, for a probe.
std::vector<StoryLine> describe(std::span<const TraceRecord> records, const StoryNames& names,
                                const MovementSettings& settings = {});

// "Sweep 2, across: Touched ...": title and text.
std::string line_text(const StoryLine& line);
// The lines as indented text, for a bug report. Includes folded lines.
std::string story_text(std::span<const StoryLine> lines);

}  // namespace slipface
