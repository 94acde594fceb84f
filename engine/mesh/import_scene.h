#pragma once

#include <filesystem>
#include <string>

#include "imported_soup.h"
#include "slipface/base/progress.h"
#include "warning_list.h"

namespace slipface {

// A file of another format than OBJ, straight through assimp: the polygons of all nodes, in the file's world
// space, and what the file says of that. Other files that it refers to are read only in its folder or below.
// Cancelled through `progress` it is an error. `bytes` are the file's; `extension` is in lower case.
Result<ImportedSoup> import_scene(const std::filesystem::path& path, const std::string& extension,
                                  std::string bytes, WarningList& warnings, Progress* progress);

}  // namespace slipface
