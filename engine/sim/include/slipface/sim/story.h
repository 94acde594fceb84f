// The story of a tick in plain words, line by line, from its trace and nothing else.
#pragma once

#include "slipface/sim/run.h"

namespace slipface {

// A number as a line tells it, for tables and for holding it against the trace.
struct StoryNumber {
    double value = 0.0;  // in the unit shown
    std::string text;    // as it stands in the line, with its unit
};

enum class StoryTone : std::uint8_t {
    plain,    // what happened
    acted,    // a hack or rule did something
    refused,  // a hack or rule was asked and did not act
    trouble,  // the player was stopped dead, is inside geometry, or a step was taken back
};

struct StoryLine {
    StoryTone tone = StoryTone::plain;
    int depth = 0;      // 0: a sweep, a push, the beginning, the end; 1: what belongs to the sweep above
    std::string title;  // "Sweep 2, horizontal", "Straight ahead"
    std::string text;   // "touches the edge of triangle 12 (face 7, ice) after 31.2 mm of 100 mm"
    std::vector<StoryNumber> numbers;   // of the text, in order
    std::optional<std::size_t> record;  // in the trace; nothing for the beginning and the end
    std::optional<Vec3> place;          // where to look
    Vec3 normal = Vec3::Zero();         // of the contact, zero if there is none
    FaceId face = no_id;
    TriangleId triangle = no_id;
    const SettingInfo* hack = nullptr;  // the switch that decided
};

std::vector<StoryLine> tell(const TickTrace& trace, SurfaceTable surfaces);
// Only the records, as of a probe.
std::vector<StoryLine> tell(std::span<const TraceRecord> records, SurfaceTable surfaces);

// The one line that says most about why the tick went as it did: the first trouble, else the contact that
// took away most speed, else nothing.
std::optional<std::size_t> telling_line(std::span<const StoryLine> lines,
                                        std::span<const TraceRecord> records);

// The lines as text, one each, indented, as for a bug report.
std::string story_text(std::span<const StoryLine> lines);

}  // namespace slipface
