// The files opened last, stored under $XDG_CONFIG_HOME/slipface (or ~/.config/slipface).
#pragma once

#include <filesystem>
#include <vector>

#include "document/folders.h"

namespace slipface {

class RecentFiles {
  public:
    static constexpr std::size_t capacity = 12;

    RecentFiles() = default;  // stores nothing on disk
    // The file has one path per line, newest first; a missing file counts as empty.
    explicit RecentFiles(std::filesystem::path file);

    // Makes the path absolute, moves it to the front and writes the file.
    void add(const std::filesystem::path& path);
    const std::vector<std::filesystem::path>& paths() const { return paths_; }

  private:
    std::filesystem::path file_;
    std::vector<std::filesystem::path> paths_;
};

}  // namespace slipface
