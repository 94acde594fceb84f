// The files opened last, kept under $XDG_CONFIG_HOME/slipface (or ~/.config/slipface).
#pragma once

#include <filesystem>
#include <vector>

#include "document/folders.h"

namespace slipface {

class RecentFiles {
  public:
    static constexpr std::size_t capacity = 12;

    RecentFiles() = default;  // remembers nothing on disk
    explicit RecentFiles(
        std::filesystem::path file);  // one path a line, newest first; a missing file is an empty list

    void add(const std::filesystem::path& path);  // made absolute, moved to the front, written at once
    const std::vector<std::filesystem::path>& paths() const { return paths_; }

  private:
    std::filesystem::path file_;
    std::vector<std::filesystem::path> paths_;
};

}  // namespace slipface
