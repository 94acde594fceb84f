// What stopped the player in the lab's run, and what would cure it: the data of the Why panel.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "document/background.h"
#include "slipface/sim/cures.h"

namespace slipface {

struct Editor;

// The cures of one stop, searched for in a background thread.
struct CureJob {
    std::uint64_t revision = 0;      // of the lab
    std::size_t run = 0, first = 0;  // the stop's first tick
    std::unique_ptr<Background<Result<std::vector<Cure>>>> work = {};
    bool taken = false;  // `cures` is valid
    std::vector<Cure> cures = {};
};

// The stop at the lab's cursor; null: none.
const Stop* stop_at_cursor(Editor& editor);
// Its cures. Null while the search, which this starts, is running.
const std::vector<Cure>* cures_at_cursor(Editor& editor);
// Moves the cursor to the stop's worst tick and the camera to its position.
void go_to_stop(Editor& editor, const Stop& stop);
// Moves the cursor to the run's headline, or to its end if nothing stopped the player. Used after a playtest.
void go_to_headline(Editor& editor);
// Applies the cure as one step of history and selects the run under the present settings. A repair of the
// geometry is only shown, because the editor does not change meshes.
void use_cure(Editor& editor, const Cure& cure);

}  // namespace slipface
