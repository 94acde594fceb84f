// What the two halves of reading changed files again have in common: reload.cpp and changed_files.cpp.
#pragma once

#include "tools/editor.h"

namespace slipface {

// Reads the geometry again. `unasked`: only if it has other bytes. `then`: the answer about the level file
// that is given afterwards.
void start_reload(Editor& editor, bool unasked, bool materials, std::optional<ChangedAnswer> then = {});
// When read unasked, a file that is broken now may be complete in a moment.
void read_failed(Editor& editor, const std::filesystem::path& file, const Error& error, bool unasked);
std::string guessed_text(const Document& document);  // for the status line; empty: nothing was guessed

// The level file as it is now, beside the document. same: it says what the document adds to, or is gone.
// taken: it was taken over, because nothing was unsaved. asked: the question is open. broken: it cannot be
// read.
enum class LevelFileState { same, taken, asked, broken };
LevelFileState look_at_level_file(Editor& editor);
void ask_about_geometry(Editor& editor, const LoadedLevel& read_again);
void geometry_is_settled(Editor& editor);  // the question is no longer about it

}  // namespace slipface
