// Runs from and to files that bring their level with them, or name it: capsules and tapes.
#pragma once

#include <filesystem>

namespace slipface {

struct Editor;

// Whether it is a tape or a capsule, by its ending.
bool is_run_file(const std::filesystem::path& path);
// Opens the level of a tape (its name, in the tape's folder or where recent and shipped levels are) or of a
// capsule (unpacked beside the autosaves), and then the run, with Why. Asks first if there are unsaved
// changes.
void open_run_file(Editor& editor, const std::filesystem::path& path);
// Writes the run with its level; see capsule_file.h.
void save_capsule(Editor& editor, const std::filesystem::path& path);
// After a level was opened: opens the run that waits for it.
void open_awaited_run(Editor& editor);

}  // namespace slipface
