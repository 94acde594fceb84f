// What `audit` and `reach` begin with: the level, its settings and the start, as the command line chose them.
#pragma once

#include "cli/options.h"
#include "slipface/base/parallel.h"
#include "slipface/base/team.h"
#include "slipface/level/level_file.h"

namespace slipface::cli {

struct Play {
    Level level;     // with the settings of the command line
    Level as_saved;  // without them
    Vec3 start = Vec3::Zero();
    std::unique_ptr<ThreadLimit> limit;  // while this lives
};

// In a team: on all of its processes, which then agree on program, level, settings, start, all options and
// the bits of the first steps. Prints warnings.
Result<std::unique_ptr<Play>> load_play(const PlayWords& words, Team* team);

inline bool is_first(const Team* team) {
    return team == nullptr || team->rank() == 0;
}
// Prints the error, in a team by rank 0 alone; returns exit_bad_input there.
int fail(const Error& error, const Team* team);

}  // namespace slipface::cli
