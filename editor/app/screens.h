// Images of the editor's window: screenshots for users and golden images.
#pragma once

#include <filesystem>
#include <vector>

#include "snapshots/input_book.h"

namespace slipface {

// One snapshot for each NAME.script in `folder` (screenshots/editor), by name. The script's first comment
// lines may contain "# level: PATH" (relative to the project, two folders up), "# size: 1280x720",
// "# scale: 1" and any number of "# mask: X,Y,WIDTH,HEIGHT" for parts that are not compared. Levels and tapes
// that a script names are its inputs; `book` learns them, and must outlive the snapshots.
std::vector<Snapshot> screen_snapshots(const std::filesystem::path& folder, InputBook& book);

// "1280x720" as numbers.
std::optional<std::pair<int, int>> parse_size(std::string_view text);

// Writes two PNG files from one viewpoint, the player at the spawn point: the editor with `level` open, and
// the level as a game draws it (a World through GlGraphics). With an empty `level` only the empty editor.
Status write_images(const std::filesystem::path& level, const std::filesystem::path& editor_png,
                    const std::filesystem::path& level_png);

}  // namespace slipface
