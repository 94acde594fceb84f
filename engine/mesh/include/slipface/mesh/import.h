// Reading a level's geometry from disk.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "slipface/base/progress.h"
#include "slipface/base/result.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

// Which way is up in the file. A level has +Y up; a file with +Z up is turned: (x, y, z) becomes (x, z, -y).
enum class UpAxis : std::uint8_t { y, z };
inline constexpr std::string_view up_axis_names[] = {"y", "z"};

// How a file's coordinates become metres, +Y up.
struct ImportTransform {
    double scale = 1.0;  // metres a unit of the file; above 0
    UpAxis up = UpAxis::y;
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

struct ImportedMesh {
    MeshPtr mesh;
    Warnings warnings;  // what was dropped or repaired, with the line where it stood
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
// Also reads what assimp does of other formats (mesh_extensions()): the polygons of all nodes, in world
// space, for looking at and painting; such files are never written. Other files that these refer to are read
// only in the level's folder or below, as are material libraries.
//
// The OBJ text is checked line by line, so every refusal names file and line: an index out of range, a
// coordinate that is not finite or beyond 1e7 m, a line longer than 1 MiB, more than 2^26 faces, no faces at
// all, bytes that are no text. Unknown keywords, lines (`l`), points (`p`), faces with fewer than three
// different corners and a missing MTL are dropped with a warning; at most `max_warnings` are listed, then one
// line says how many more there were. Memory: at most about 40 times the file's size.
Result<ImportedMesh> import_mesh(const std::filesystem::path& path, const ImportOptions& options);
Result<ImportedMesh> import_mesh(const std::filesystem::path& path, std::size_t max_warnings = 100);

// The endings that import_mesh() reads, lower case without the dot, "obj" first.
std::span<const std::string_view> mesh_extensions();

}  // namespace slipface
