// Files that decide how a level looks.
#pragma once

#include <filesystem>
#include <vector>

namespace slipface {

// Material libraries and images in the level's folder and below it, of which it may use some; sorted.
std::vector<std::filesystem::path> appearance_files(const std::filesystem::path& level);

}  // namespace slipface
