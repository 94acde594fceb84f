// A run that another program's controller made, beside Slipface's mover with the same inputs.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "slipface/sim/recorded_faults.h"
#include "tools/lab/search.h"

namespace slipface {

struct Editor;

struct ImportedRun {
    std::string name;                             // of its file
    std::shared_ptr<const RecordedRun> run = {};  // null: none is imported
    Search<std::vector<RecordedFault>> faults = {};

    // The recorded tick that ends next after so many seconds of the lab's tape.
    std::size_t tick_at(double seconds) const;
};

// Opens the run beside the lab's tape, which becomes that of Slipface's mover with the run's body, speed and
// inputs. Reports failure as a MessageDialog and leaves the lab as it was.
void import_run(Editor& editor, const std::filesystem::path& path);
// What disturbed its player. Null while the search, which this starts, is running, or if no run is imported.
const std::vector<RecordedFault>* imported_faults(Editor& editor);
// Moves the cursor to the fault's last tick and the camera to its position.
void go_to_fault(Editor& editor, const RecordedFault& fault);

}  // namespace slipface
