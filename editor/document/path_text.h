// Paths as people read and type them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "document/folder_listing.h"

namespace slipface {

// A file's name or path with what no font can show (control characters, line ends, bytes that are no UTF-8)
// replaced by U+FFFD. A file may have any byte in its name but '/' and 0.
std::string printable(std::string_view bytes);

// "~/levels/easy.obj" for a path below the home folder, and back. Printable; relative paths stay as they are.
std::string with_tilde(const std::filesystem::path& path);
std::filesystem::path expand_tilde(std::string_view text);

// For each path the shortest end of its folder that tells it from the others of the same file name: "a" and
// "b" for x/a/easy.obj and x/b/easy.obj, "a/levels" and "b/levels" for a/levels/easy.obj and
// b/levels/easy.obj. Where the name alone would do, the last folder.
std::vector<std::string> distinguishing_folders(std::span<const std::filesystem::path> paths);

// What Tab makes of a path that is being typed.
struct PathCompletion {
    std::string text;                 // as far as it is certain; with a '/' behind a folder
    std::vector<std::string> others;  // more than one: the names that go on from there, sorted
};
// Relative paths count from `base`. What the dialog would list can follow; names that begin with a dot only
// where a dot is typed, and names that are no UTF-8 never.
PathCompletion complete_path(std::string_view text, const std::filesystem::path& base, FolderWants wants);

}  // namespace slipface
