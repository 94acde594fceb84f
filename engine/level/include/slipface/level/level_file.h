// Levels on disk: NAME.obj (never written by these functions) and NAME.slipface.json beside it.
#pragma once

#include <functional>

#include "slipface/image/grey_image.h"
#include "slipface/level/level.h"

namespace slipface {

struct MatchSummary {
    std::size_t exact = 0, by_plane = 0, by_nearest = 0, orphaned = 0;
    std::string text() const;  // "812 exact, 14 by plane, 3 orphaned"
};

struct LoadedLevel {
    Level level;
    Warnings warnings;                     // of the OBJ and of the level file
    std::vector<FoundSpawn> found_spawns;  // of the geometry's file, whatever the level file says
    std::vector<FoundType> found_types;    // likewise
    std::vector<FaceId> undrawn;           // likewise
    MatchSummary match;
    std::vector<FaceId> guessed;  // faces that got their paint by plane or by nearest, ascending
    double mesh_load_s = 0.0;     // duration of reading the geometry
};

// Opens `path`: an OBJ (its level file is read if there is one) or a level file (its "mesh" is read). Without
// a level file, the rules and hidden faces are what the geometry's file says (Quake maps). The
// level file's errors name the JSON path. Unknown keys are kept; unknown versions, wrong types and duplicate
// keys are errors.
// With `progress` another thread can watch and cancel; a cancelled load is an error.
Result<LoadedLevel> load_level(const std::filesystem::path& path, Progress* progress = nullptr);

// Reads the geometry of `level` again, after another program changed it, and finds the painted faces and the
// orphans again. `level` itself stays as it is; everything but mesh, overrides and orphans is copied from it.
Result<LoadedLevel> reload_mesh(const Level& level, Progress* progress = nullptr);
// The same with the file's coordinates taken otherwise. Painted faces keep their types: they are followed by
// their place in the file, which must be unchanged on disk.
Result<LoadedLevel> reload_mesh(const Level& level, const ImportTransform& transform,
                                Progress* progress = nullptr);

// Whether the geometry on disk is not what was read, by its bytes; a file that cannot be read counts as
// changed.
bool mesh_changed_on_disk(const Level& level);

// Writes level.file_path, atomically. Text: UTF-8, two-space indent, keys in a fixed order, so that a diff
// shows the change.
Status save_level(const Level& level);
Status save_level(const Level& level, const std::filesystem::path& file_path);

// The file's text, for tests, autosave and undo checks.
std::string level_to_json(const Level& level);
// Puts the annotations of `json` (the text of a level file; `place` names it in errors) on `mesh`.
Result<LoadedLevel> level_from_json(std::string_view json, const std::string& location, MeshPtr mesh);

// Makes level.terrain of level.heightfield, or takes it away where there is none. load_level has done it and
// turned an error into a warning; level_from_json has not. Errors name the picture; level.terrain is null
// after them.
Status load_terrain(Level& level);
// The terrain of a picture that is in memory already.
Heightfield make_heightfield(const HeightfieldSource& source, const GreyImage& image);

// NAME.slipface.json for NAME.obj.
std::filesystem::path level_file_for(const std::filesystem::path& mesh_path);

}  // namespace slipface
