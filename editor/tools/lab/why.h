// What stopped the player in the lab's run, what else happened, and what would cure it: the data of the Why
// panel.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "slipface/sim/cures.h"
#include "slipface/sim/run_events.h"
#include "tools/lab/search.h"

namespace slipface {

struct Editor;

struct RunFindings {
    std::vector<Stop> stops;
    std::vector<RunEvent> events;
};

struct Why {
    std::set<std::string, std::less<>> hidden_words = {};  // of events that are not shown
    Search<RunFindings> findings;                          // of the selected run
    Search<std::vector<Cure>> cures;                       // of one of its stops
    std::optional<std::size_t>
        headline_from;  // the cursor's tick, from which it goes to the headline once it is found
};

// For searches about runs: a failure is a MessageDialog.
SearchWait search_wait(Editor& editor);
bool is_shown(const Why& why, const RunEvent& event);

// What happened in the selected run. Null: it is not complete yet, or the search, which this starts, is
// running.
const RunFindings* findings(Editor& editor);
// The stop at the lab's cursor; null: none is known.
const Stop* stop_at_cursor(Editor& editor);
// Its cures. Null while the search, which this starts, is running.
const std::vector<Cure>* cures_at_cursor(Editor& editor);
// Moves the cursor to the stop's worst tick and the camera to its position.
void go_to_stop(Editor& editor, const Stop& stop);
// Moves the cursor to the run's headline once that is found, or to its end if nothing stopped the player,
// unless the user moves it before. Used after a playtest; follow_headline() once per frame.
void go_to_headline(Editor& editor);
void follow_headline(Editor& editor);
// Applies the cure as one step of history and selects the run under the present settings. A repair of the
// geometry is only shown, because the editor does not change meshes.
void use_cure(Editor& editor, const Cure& cure);

}  // namespace slipface
