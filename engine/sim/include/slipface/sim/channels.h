// The numbers of a run, tick by tick: one table for the plots and the CSV.
#pragma once

#include "slipface/sim/run.h"

namespace slipface {

struct RunChannel {
    const char* name;                                       // the CSV's column
    const char* label;                                      // of the plot; empty: only in the CSV
    const char* unit;                                       // "m/s", ""
    const char* meaning;                                    // the tooltip's sentence
    bool step;                                              // whole numbers or yes and no, drawn as steps
    double (*value)(const TapeRun& run, std::size_t tick);  // NaN: no value at that tick
};
std::span<const RunChannel> run_channels();

// A header and one row per tick: tick, time_s, every channel, the buttons that are
// held, the surface's name, and for each hack of
// hack_rows() a column of 0 and 1 with its name. NaN is an empty cell.
std::string run_csv(const TapeRun& run, SurfaceTable surfaces);

}  // namespace slipface
