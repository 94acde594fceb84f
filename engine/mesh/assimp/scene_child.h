#pragma once

#include "assimp/import_scene.h"

namespace slipface {

// Reads the scene in a child process. Nothing: there is none (read_scenes_in_child()).
std::optional<Result<ImportedSoup>> import_scene_in_child(const std::filesystem::path& path,
                                                          std::string_view bytes, WarningList& warnings,
                                                          Progress* progress);

}  // namespace slipface
