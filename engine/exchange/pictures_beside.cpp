#include "pictures_beside.h"

#include <fmt/format.h>

#include <algorithm>

#include "slipface/base/system.h"

namespace slipface {

namespace fs = std::filesystem;

PicturesBeside::PicturesBeside(const fs::path& exported)
    : folder_(exported.parent_path().empty() ? fs::path(".") : exported.parent_path()),
      stem_(exported.stem().string()) {}

fs::path PicturesBeside::add(const fs::path& picture, std::string bytes) {
    const std::string last = picture.filename().string();
    fs::path name = path_of(stem_ + "-" + last);
    const auto taken = [&](const ExportedFile& other) { return other.path == folder_ / name; };
    for (int number = 2; std::any_of(files_.begin(), files_.end(), taken); ++number)
        name = path_of(fmt::format("{}-{}-{}", stem_, number, last));
    files_.push_back({folder_ / name, std::move(bytes)});
    return name;
}

}  // namespace slipface
