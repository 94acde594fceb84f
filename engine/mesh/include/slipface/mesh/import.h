// Reading a level's geometry from disk.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/base/progress.h"
#include "slipface/base/result.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

// The upward axis of the file. A level has +Y up, so other files are rotated: with +Z up, (x, y, z) becomes
// (x, z, -y).
enum class UpAxis : std::uint8_t { y, z, x, minus_y, minus_z, minus_x };
inline constexpr std::string_view up_axis_names[] = {"y", "z", "x", "-y", "-z", "-x"};

// The user's choice for a file's coordinates. Values that are not set follow from the file or its format.
struct ImportTransform {
    std::optional<double> scale;  // metres per unit of the file; above 0
    std::optional<UpAxis> up;
    bool flip = false;  // the faces look the other way: their corners are read backwards
    friend bool operator==(const ImportTransform&, const ImportTransform&) = default;
};
inline constexpr double smallest_import_scale = 1e-6, largest_import_scale = 1e6;

// Identifies the content of a file when it was read, to notice later changes by other programs.
struct FileStamp {
    std::uint64_t size = 0;
    std::uint64_t hash = 0;
    friend bool operator==(const FileStamp&, const FileStamp&) = default;
};
FileStamp file_stamp(std::string_view bytes);

// The origin of an assumption about a file's coordinates: declared by the file, guessed from the usual
// writers of the format, or given by the user (the level file's "scale" and "up").
enum class ImportSource : std::uint8_t { declared, guessed, given };
inline constexpr std::string_view import_source_names[] = {"declared", "guessed", "given"};

// How the file's coordinates were converted to metres and +Y up, and why.
struct ImportSummary {
    double scale = 1.0;  // metres per unit of the file, as applied
    ImportSource scale_from = ImportSource::guessed;
    std::string scale_reason;  // a few words: "UnitScaleFactor 1"
    UpAxis up = UpAxis::y;     // the file's upward axis, as applied
    ImportSource up_from = ImportSource::guessed;
    std::string up_reason;
    Vec3 size = Vec3::Zero();  // metres: extent of the mesh along x, y, z
    friend bool operator==(const ImportSummary&, const ImportSummary&) = default;
};

// A position where a player enters the level (an `info_player_*` entity of a Quake map).
struct FoundSpawn {
    std::string name;          // name in the file: "info_player_deathmatch 3"
    Vec3 feet = Vec3::Zero();  // metres, +Y up: the lowest point of a standing player
    double yaw = 0.0;          // radians; 0 looks along -Z, counter-clockwise seen from above
    friend bool operator==(const FoundSpawn&, const FoundSpawn&) = default;
};

// The surface type that the file gives to a material ("ice").
struct FoundType {
    std::string material, type;
    friend bool operator==(const FoundType&, const FoundType&) = default;
};

struct ImportedMesh {
    MeshPtr mesh;
    ImportSummary summary;
    std::vector<FoundSpawn> spawns;  // in the order of the file; empty if the format has none
    std::vector<FoundType> types;    // from the flags of a Quake map's textures
    // The JSON text that glTF's scene has as "slipface_types", not checked: the types with their parameters
    // as a level file has them; empty: none.
    std::string type_table;
    std::vector<FaceId> undrawn;  // ascending: faces that the game does not draw, such as sky
    Warnings warnings;            // parts that were dropped or repaired, with their line
    FileStamp stamp;
};

struct ImportOptions {
    ImportTransform transform;
    std::size_t max_warnings = 100;
    const std::string* content = nullptr;  // an OBJ's bytes to read instead of the file's; null: the file's
    Progress* progress = nullptr;          // null: no progress is reported
};

// Reads an OBJ file: each polygon becomes one face, in the order of the file, and its group is the last `o`
// or `g` before it. A reader of our own reads it on all cores, and its numbers are assimp's bit for bit.
// Other formats (formats.h) are also read, to view and paint them; such files are never written. They go
// through assimp, in a child process if the program offers one (scene_child.h), with the polygons of all
// nodes in world space; Quake 3 maps have a reader of our own. Files
// that they refer to, and material libraries, are read only in the level's folder or below.
//
// The mesh has +Y up and is in metres: by options.transform, else as the file declares (FBX, COLLADA, glTF),
// else as the usual writers of the format do (3DS, STL and PLY: +Z up; Quake maps: 32 units per metre).
// `summary` reports which. A scale outside smallest_import_scale to largest_import_scale is an error.
//
// OBJ text is checked line by line, so every error names file and line: an index out of range, a coordinate
// that is not finite or beyond 1e7 units, a line longer than 1 MiB, more than 2^26 faces, no faces, bytes
// that are not text. Unknown keywords, lines (`l`), points (`p`), faces with fewer than three different
// corners and a missing MTL are dropped with a warning. At most `max_warnings` are listed, then one line with
// the number of the others. Memory: at most about 40 times the size of the file.
Result<ImportedMesh> import_mesh(const std::filesystem::path& path, const ImportOptions& options);
Result<ImportedMesh> import_mesh(const std::filesystem::path& path, std::size_t max_warnings = 100);

}  // namespace slipface
