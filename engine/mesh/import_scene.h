#pragma once

#include <filesystem>

#include "slipface/base/progress.h"
#include "slipface/mesh/build.h"
#include "warning_list.h"

namespace slipface {

// A file of another format than OBJ, straight through assimp: the polygons of all nodes, in world space.
// Other files that it refers to are read only in its folder or below. Cancelled through `progress` it is an
// error.
Result<PolygonSoup> import_scene(const std::filesystem::path& path, WarningList& warnings,
                                 Progress* progress);

}  // namespace slipface
