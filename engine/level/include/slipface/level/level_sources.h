// The files that an open level was read from, besides its geometry and its level file.
#pragma once

#include <filesystem>
#include <vector>

#include "slipface/level/level.h"

namespace slipface {

// Paths, sorted, each once, there or missing.
struct LevelSources {
    // The meshes of the props, and what these and the geometry refer to: MTL files, buffers of glTF.
    std::vector<std::filesystem::path> meshes;
    std::vector<std::filesystem::path> textures;
    // Terrain and light map.
    std::vector<std::filesystem::path> maps;
};
LevelSources level_sources(const Level& level);

}  // namespace slipface
