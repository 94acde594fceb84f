// The numbers of a run, tick by tick: one table feeds the plots and the CSV.
#pragma once

#include "slipface/sim/run.h"

namespace slipface {

struct RunChannel {
    const char* name;                                       // the CSV's column
    const char* label;                                      // of the plot; empty: only in the CSV
    const char* unit;                                       // "m/s", ""
    const char* meaning;                                    // the tooltip's sentence
    bool step;                                              // a whole number or yes and no, drawn as stairs
    double (*value)(const TapeRun& run, std::size_t tick);  // NaN: there is none at that tick
};
std::span<const RunChannel> run_channels();

// The header and a row a tick: tick, time_s, every channel, the surface's name, and a column of 0 and 1 for
// each hack of hack_rows(), named after it. What is NaN is left empty.
std::string run_csv(const TapeRun& run, SurfaceTable surfaces);

}  // namespace slipface
