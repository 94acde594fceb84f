// Pictures of the editor's window: what users see, and the goldens that keep it so.
#pragma once

#include <filesystem>
#include <vector>

#include "slipface/snapshot/golden.h"

namespace slipface {

// One snapshot for each NAME.script in `folder` (screenshots/editor), by name. The script's first comment
// lines may say
// "# level: PATH" (relative to the project, two folders up), "# size: 1280x720", "# scale: 1" and, any number
// of times,
// "# mask: X,Y,WIDTH,HEIGHT" for a part that is not compared.
std::vector<Snapshot> screen_snapshots(const std::filesystem::path& folder);

// "1280x720" as numbers.
std::optional<std::pair<int, int>> parse_size(std::string_view text);

// The editor with `level` open, and the level as a game draws it (a World through GlGraphics) from the same
// viewpoint, the player at its spawn point; as PNG files. An empty `level`: the empty editor alone.
Status write_images(const std::filesystem::path& level, const std::filesystem::path& editor_png,
                    const std::filesystem::path& level_png);

}  // namespace slipface
