// Reading a level's geometry from disk.
#pragma once

#include <filesystem>

#include "slipface/base/result.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

struct ImportedMesh {
    MeshPtr mesh;
    Warnings warnings;  // what was dropped or repaired, with the line where it stood
};

// The polygons of an OBJ file, through assimp, each polygon one face, in the file's order. A face's group is
// the `o` or `g` that came last before it. Also reads glTF, GLB, PLY, STL, OFF and COLLADA: the polygons of
// all nodes, in world space; other files that these refer to are read only in the level's folder or below, as
// are material libraries.
//
// The OBJ text is checked line by line before assimp sees it, so every refusal names file and line: an index
// out of range, a coordinate that is not finite or beyond 1e7 m, a line longer than 1 MiB, more than 2^26
// faces, no faces at all, bytes that are no text. Unknown keywords, lines (`l`), points (`p`), faces with
// fewer than three different corners and a missing MTL are dropped with a warning; at most `max_warnings` are
// listed, then one line says how many more there were. Memory: at most about 40 times the file's size.
Result<ImportedMesh> import_mesh(const std::filesystem::path& path, std::size_t max_warnings = 100);

}  // namespace slipface
