// The lab's run as text, and opening it.
#pragma once

#include <filesystem>
#include <string>

#include "slipface/base/result.h"
#include "slipface/sim/capsule.h"

namespace slipface {

struct Editor;

// "capsule=..." (capsule.h), to be put behind the '#' of a page's address: the tape, the tick at the cursor,
// and the level's types, paint and settings; of a level that comes with the program only how they differ from
// it. Empty: there is no tape.
std::string link_to_run(Editor& editor);

// Where a level of that file name is: the open one, those that come with the program, and recent ones. Empty:
// nowhere.
std::filesystem::path find_level(const Editor& editor, const std::string& name);

// Opens the capsule's level at its tick, with the Why panel. The level is found by its name among the open
// one, those that come with the program, and recent ones. Unsaved changes are an error; what fails changes
// nothing.
Status open_capsule(Editor& editor, const Capsule& capsule);

}  // namespace slipface
