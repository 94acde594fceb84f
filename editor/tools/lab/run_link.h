// The lab's run as a link, and opening one.
#pragma once

#include <string>
#include <string_view>

#include "slipface/base/result.h"

namespace slipface {

struct Editor;

// "capsule=...", to be put behind the '#' of a page's address (capsule.h): the tape, the tick at the cursor,
// and the level's types, paint and settings. Empty: there is no tape.
std::string link_to_run(Editor& editor);

// Opens "capsule=..." or "demo=NAME" (a hack's demo scene); a '#' before it is ignored. A capsule's level is
// found by its name among the open one, those that ship with the program, and recent ones; it opens at the
// capsule's tick, with the Why panel. A demo asks first if there are unsaved changes; with them, a capsule is
// an error, as are damaged texts and unknown names.
Status open_link(Editor& editor, std::string_view text);

}  // namespace slipface
