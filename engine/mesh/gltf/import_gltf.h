// glTF 2.0, as its specification means it.
#pragma once

#include <filesystem>
#include <string>

#include "assimp/imported_soup.h"
#include "slipface/base/progress.h"
#include "warning_list.h"

namespace slipface {

// Reads a .gltf or .glb: the polygons of the scene that it shows, in its world space. A skin is in the pose
// of its joints, morph targets have their default weights, and instances of a node are objects of their own.
// Errors name the place in the file. `bytes`: its content. `too_old`: set if it is glTF 1.0, another format
// that is then an error.
Result<ImportedSoup> import_gltf(const std::filesystem::path& path, std::string bytes, WarningList& warnings,
                                 Progress* progress, bool* too_old = nullptr);

}  // namespace slipface
