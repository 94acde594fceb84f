// Files exchanged with other programs: presets of movement settings, and exported levels.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/editor.h"

namespace slipface {

// Each reports failure as a MessageDialog and then changes nothing.
void open_preset(Editor& editor, const std::filesystem::path& path);  // one step of history
// Writes the level's settings. If the file exists, its name and description are preserved.
void save_preset(Editor& editor, const std::filesystem::path& path);

// Write the current level with its unsaved changes (slipface/exchange/export.h). The status line says what
// was written.
void export_level_obj(Editor& editor, const std::filesystem::path& path);
void export_level_gltf(Editor& editor, const std::filesystem::path& path);  // .glb: all in one file
void export_level_game(Editor& editor, const std::filesystem::path& path);
// All files that the export to `path` writes: `path` itself and those that belong to it.
std::vector<std::filesystem::path> files_of_export(FileDialogKind kind, const std::filesystem::path& path);

}  // namespace slipface
