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

// Which way is up in the file. A level has +Y up; a file with another axis is rotated: with +Z up, (x, y, z)
// becomes (x, z, -y).
enum class UpAxis : std::uint8_t { y, z, x, minus_y, minus_z, minus_x };
inline constexpr std::string_view up_axis_names[] = {"y", "z", "x", "-y", "-z", "-x"};

// What the user says of a file's coordinates. What is not given follows from the file or its format.
struct ImportTransform {
    std::optional<double> scale;  // metres per unit of the file; above 0
    std::optional<UpAxis> up;
    friend bool operator==(const ImportTransform&, const ImportTransform&) = default;
};
inline constexpr double smallest_import_scale = 1e-6, largest_import_scale = 1e6;

// What a file's bytes were when it was read, to notice that another program has changed it since.
struct FileStamp {
    std::uint64_t size = 0;
    std::uint64_t hash = 0;
    friend bool operator==(const FileStamp&, const FileStamp&) = default;
};
FileStamp file_stamp(std::string_view bytes);

// Where an assumption about a file's coordinates comes from: the file declares it, the format's usual writers
// suggest it, or the user gave it (the level file's "scale" and "up").
enum class ImportSource : std::uint8_t { declared, guessed, given };
inline constexpr std::string_view import_source_names[] = {"declared", "guessed", "given"};

// How the file's coordinates became metres, +Y up, and why.
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

// A place in the file where a player enters the level (an `info_player_*` entity of a Quake map).
struct FoundSpawn {
    std::string name;          // as the file calls it: "info_player_deathmatch 3"
    Vec3 feet = Vec3::Zero();  // metres, +Y up: the lowest point of a player who stands there
    double yaw = 0.0;          // radians, 0 looks along -Z, counter-clockwise seen from above
    friend bool operator==(const FoundSpawn&, const FoundSpawn&) = default;
};

// What a file says of a material, as a surface type's name ("ice").
struct FoundType {
    std::string material, type;
    friend bool operator==(const FoundType&, const FoundType&) = default;
};

struct ImportedMesh {
    MeshPtr mesh;
    ImportSummary summary;
    std::vector<FoundSpawn> spawns;  // in the file's order; empty where the format has none
    std::vector<FoundType> types;    // by the flags of a Quake map's textures
    std::vector<FaceId> undrawn;     // ascending: what stops a player, but is not seen in the game
    Warnings warnings;               // what was dropped or repaired, with the line where it stood
    FileStamp stamp;
    bool through_assimp = false;  // false: through the reader of ordinary OBJ files
};

struct ImportOptions {
    ImportTransform transform;
    std::size_t max_warnings = 100;
    Progress* progress = nullptr;  // null: nobody looks
};

// The polygons of an OBJ file, each polygon one face, in the file's order. A face's group is the `o` or `g`
// that came last before it. Ordinary files go through a reader of our own on all cores, whose result equals
// assimp's bit for bit; all others through assimp.
// Also reads what assimp does of other formats (formats.h): the polygons of all nodes, in world
// space, for looking at and painting; such files are never written. Other files that these refer to are read
// only in the level's folder or below, as are material libraries. Quake 3 maps have a reader of our own.
//
// The mesh is upright and in metres: by options.transform, else by what the file declares (FBX, COLLADA,
// glTF), else by what the format's usual writers mean (3DS, STL and PLY have +Z up; a Quake map 32 units per
// metre). `summary` says which. A scale out of range (smallest_import_scale to largest_import_scale) is
// refused.
//
// The OBJ text is checked line by line, so every refusal names file and line: an index out of range, a
// coordinate that is not finite or beyond 1e7 m, a line longer than 1 MiB, more than 2^26 faces, no faces at
// all, bytes that are no text. Unknown keywords, lines (`l`), points (`p`), faces with fewer than three
// different corners and a missing MTL are dropped with a warning; at most `max_warnings` are listed, then one
// line says how many more there were. Memory: at most about 40 times the file's size.
Result<ImportedMesh> import_mesh(const std::filesystem::path& path, const ImportOptions& options);
Result<ImportedMesh> import_mesh(const std::filesystem::path& path, std::size_t max_warnings = 100);

}  // namespace slipface
