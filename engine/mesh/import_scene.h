#pragma once

#include <filesystem>

#include "slipface/mesh/build.h"
#include "warning_list.h"

namespace slipface {

// Whether `extension` ("gltf", lower case, without the dot) is one that import_scene() reads.
bool scene_extension(std::string_view extension);

// A file of another format than OBJ, straight through assimp: the polygons of all nodes, in world space.
// Other files that it refers to are read only in its folder or below.
Result<PolygonSoup> import_scene(const std::filesystem::path& path, WarningList& warnings);

}  // namespace slipface
