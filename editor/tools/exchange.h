// Files that the editor exchanges with others: sets of movement settings, and levels for other programs.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/editor.h"

namespace slipface {

// Each reports failure as a MessageDialog and changes nothing then.
void open_preset(Editor& editor, const std::filesystem::path& path);  // one step of history
// The level's settings. A preset that is replaced hands on its name and its sentence.
void save_preset(Editor& editor, const std::filesystem::path& path);

// The level as it is now, unsaved changes too; by slipface/exchange/export.h. The status says what was
// written.
void export_level_obj(Editor& editor, const std::filesystem::path& path);
void export_level_gltf(Editor& editor, const std::filesystem::path& path);  // .glb: all in one file
void export_level_game(Editor& editor, const std::filesystem::path& path);
// What these write for `path`: itself and the files that go with it.
std::vector<std::filesystem::path> files_of_export(FileDialogKind kind, const std::filesystem::path& path);

}  // namespace slipface
