#pragma once

#include <filesystem>
#include <string>

#include "assimp/imported_soup.h"
#include "slipface/base/progress.h"
#include "warning_list.h"

namespace slipface {

// Whether this program has assimp: the page in a browser and the build for Windows have not.
bool reads_scenes();

// Reads a file of another format than OBJ through assimp: the polygons of all nodes, in the world space of
// the file, and the frame that it declares. Files that it refers to are read only in its folder or below.
// Cancelling through `progress` gives an error. `bytes`: the content; `extension`: lower case. In a child
// process if there is one (scene_child.h), else as read_scene(), in this process.
Result<ImportedSoup> import_scene(const std::filesystem::path& path, const std::string& extension,
                                  std::string bytes, WarningList& warnings, Progress* progress);
Result<ImportedSoup> read_scene(const std::filesystem::path& path, const std::string& extension,
                                std::string bytes, WarningList& warnings, Progress* progress);

}  // namespace slipface
