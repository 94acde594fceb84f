// What stopped the player of the lab's run, and what would cure it: the data of the Why panel.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "document/background.h"
#include "slipface/sim/cures.h"

namespace slipface {

struct Editor;

// The cures of one stop, searched for beside the window.
struct CureJob {
    std::uint64_t revision = 0;      // of the lab
    std::size_t run = 0, first = 0;  // the stop's first tick
    std::unique_ptr<Background<std::vector<Cure>>> work = {};
    bool taken = false;  // `cures` are there
    std::vector<Cure> cures = {};
};

// The stop that the lab's cursor is in, or nothing.
const Stop* stop_at_cursor(Editor& editor);
// Its cures; null while they are searched for, which this starts.
const std::vector<Cure>* cures_at_cursor(Editor& editor);
void go_to_stop(Editor& editor, const Stop& stop);  // the cursor to its worst tick, the camera to its place
// The cursor to the run's headline: after a playtest. The end of the run if nothing stopped the player.
void go_to_headline(Editor& editor);
// One step of history; then the run under the settings as they are now is the one that is told.
void use_cure(Editor& editor, const Cure& cure);

}  // namespace slipface
