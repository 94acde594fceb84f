#include "slipface/level/appearance_files.h"

#include <algorithm>
#include <array>
#include <string>

#include "slipface/base/text.h"

namespace slipface {

namespace fs = std::filesystem;

std::vector<fs::path> appearance_files(const fs::path& level) {
    constexpr std::array endings{".mtl", ".png", ".jpg", ".jpeg", ".tga", ".bmp", ".gif", ".webp"};
    constexpr std::size_t max_files = 100'000;
    std::vector<fs::path> files;
    std::error_code error;
    fs::recursive_directory_iterator entry(level.parent_path().empty() ? "." : level.parent_path(), error),
        end;
    for (; !error && entry != end && files.size() < max_files; entry.increment(error)) {
        const std::string ending = to_lower(entry->path().extension().string());
        if (std::find(endings.begin(), endings.end(), ending) != endings.end())
            files.push_back(entry->path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace slipface
