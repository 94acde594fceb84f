// Level files: NAME.obj (these functions never write it) and NAME.slipface.json beside it.
#pragma once

#include <functional>

#include "slipface/image/grey_image.h"
#include "slipface/level/level.h"

namespace slipface {

struct MatchSummary {
    std::size_t exact = 0, by_plane = 0, by_nearest = 0, orphaned = 0;
    std::string text() const;  // "812 exact, 14 by plane, 3 orphaned"
};

// Another reading of the paint that fits the geometry as well: objects that look the same turned or not,
// tiles that all moved by one or stayed. The level has the first reading, in which painted ones of these
// faces are guesses.
struct SecondReading {
    std::vector<FaceId> faces;                    // that it gives another type, ascending
    std::vector<std::optional<SurfaceId>> types;  // [of `faces`] nothing: not painted
    bool empty() const { return faces.empty(); }
};

struct LoadedLevel {
    Level level;
    Warnings warnings;                     // of the OBJ and of the level file
    std::vector<FoundSpawn> found_spawns;  // of the geometry's file, even if the level file has spawns
    std::vector<FoundType> found_types;    // likewise
    std::string type_table;                // likewise, ImportedMesh::type_table
    std::vector<FaceId> undrawn;           // likewise; hidden in a level without a level file
    MatchSummary match;
    SecondReading second;
    double mesh_load_s = 0.0;  // duration of reading the geometry
};

// Loads `path`: a geometry file (and its level file, if there is one) or a level file (and its "mesh").
// Without a level file, the rules and hidden faces come from the geometry's file (Quake maps), and the types
// (glTF that this program exported); so do the spawns of a level that has none. Errors of the level file name
// the JSON path. Unknown keys are preserved; unknown versions, wrong types and duplicate keys are errors.
// Terrain that cannot be read is a warning. With `progress` another thread can watch and cancel; a cancelled
// load is an error.
Result<LoadedLevel> load_level(const std::filesystem::path& path, Progress* progress = nullptr);

// What load_level(path) would read, without loading it, for a job that is to know whether a level changed.
struct LevelFiles {
    // Level file, geometry, terrain, and what geometry of other formats than OBJ and BSP may refer to: files
    // of its folder with its stem or the ending of glTF's buffers. Some may not exist. Sorted.
    std::vector<std::filesystem::path> files;
    std::size_t goals = 0;  // in the level file
};
LevelFiles files_of_level(const std::filesystem::path& path);

// Reads the geometry of `level` again, after another program changed it. Finds the painted, hidden and
// selected faces and the orphans again; all else is copied from `level`. `content`: bytes to read instead of
// the geometry file's.
Result<LoadedLevel> reload_mesh(const Level& level, Progress* progress = nullptr,
                                const std::string* content = nullptr);
// The same with another scale or upward axis. Faces keep their index, so painted faces keep their types; the
// spawns move with the geometry. Error: the file changed on disk.
Result<LoadedLevel> reload_mesh(const Level& level, const ImportTransform& transform,
                                Progress* progress = nullptr);

// Whether the geometry file has other bytes than when it was read. A file that cannot be read counts as
// changed.
bool mesh_changed_on_disk(const Level& level);

// Writes the level file, atomically, to `file_path` or to level.file_path. UTF-8, two-space indent, keys in
// a fixed order, so that a diff shows the change. Never writes the geometry.
Status save_level(const Level& level);
Status save_level(const Level& level, const std::filesystem::path& file_path);

// Without "parts" the text is shorter, and enough where the geometry is certainly the same; that paint is a
// guess is not written then.
enum class LevelText { whole, without_parts };
// The file's text, for tests, autosave, links and undo checks.
std::string level_to_json(const Level& level, LevelText text = LevelText::whole);
// Applies the annotations of a level file's text to `mesh`. `location` names the text in errors.
Result<LoadedLevel> level_from_json(std::string_view json, const std::string& location, MeshPtr mesh);
// The same for the geometry of an open level; the meshes of its props are not read again.
Result<LoadedLevel> level_from_json(std::string_view json, const std::string& location, const Level& base);

// Makes level.terrain from level.heightfield; without a heightfield, or after an error, it is null.
// load_level() does this, level_from_json() does not. Errors name the image file.
Status load_terrain(Level& level);
// The terrain of an image that is in memory already.
Heightfield make_heightfield(const HeightfieldSource& source, const GreyImage& image);

// The path NAME.slipface.json beside NAME.obj.
std::filesystem::path level_file_for(const std::filesystem::path& mesh_path);

}  // namespace slipface
