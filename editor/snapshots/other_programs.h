// Snapshots of other programs: the rows of a suite with "command" or "images".
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "goldens/suite.h"
#include "slipface/base/temporary_folder.h"
#include "snapshots/input_book.h"

namespace slipface {

// The names of a row's images: its frames, or the files of its folder; one empty name: the only image.
// Error: there is no such folder, or a name that no snapshot can have.
Result<std::vector<std::string>> frames_of(const Scene& scene);

// Runs the commands of rows. What one run wrote is taken once: rendering an image again runs its command
// again.
class ProgramRuns {
  public:
    // Errors name the row: a command that fails or takes too long, writes other images than its frames, or
    // numbers that are not understood.
    Result<Rendering> render(const Scene& scene, InputBook& book);

  private:
    struct Run {
        TemporaryFolder folder;
        std::set<std::string> taken;
        Status status;  // all frames of a command that fails wait for it once
    };
    std::map<std::pair<std::filesystem::path, std::string>, Run> runs_;  // by folder and command

    Result<std::filesystem::path> folder_with(const Scene& scene);
};

// The files that a row's command names.
InputBook::Named program_inputs(const Scene& scene, InputBook& book);

}  // namespace slipface
