// Levels on disk: NAME.obj (never written by these functions) and NAME.slipface.json beside it.
#pragma once

#include <functional>

#include "slipface/level/level.h"

namespace slipface {

struct MatchSummary {
    std::size_t exact = 0, by_plane = 0, by_nearest = 0, orphaned = 0;
    std::string text() const;  // "812 exact, 14 by plane, 3 orphaned"
};

struct LoadedLevel {
    Level level;
    Warnings warnings;  // of the OBJ and of the level file
    MatchSummary match;
    double mesh_load_s = 0.0;  // duration of reading the geometry
};

// Opens `path`: an OBJ (its level file is read if there is one) or a level file (its "mesh" is read). The
// level file's errors name the JSON path. Unknown keys are kept; unknown versions, wrong types and duplicate
// keys are errors.
Result<LoadedLevel> load_level(const std::filesystem::path& path);

// Writes level.file_path, atomically. Text: UTF-8, two-space indent, keys in a fixed order, so that a diff
// shows the change.
Status save_level(const Level& level);
Status save_level(const Level& level, const std::filesystem::path& file_path);

// The file's text, for tests, autosave and undo checks.
std::string level_to_json(const Level& level);
// Puts the annotations of `json` (the text of a level file; `place` names it in errors) on `mesh`.
Result<LoadedLevel> level_from_json(std::string_view json, const std::string& place, MeshPtr mesh);

// NAME.slipface.json for NAME.obj.
std::filesystem::path level_file_for(const std::filesystem::path& mesh_path);

}  // namespace slipface
