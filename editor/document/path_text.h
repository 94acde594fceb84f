// Paths as people read and type them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "document/folder_listing.h"

namespace slipface {

// Replaces by U+FFFD what no font can show (control characters, line ends, invalid UTF-8) in a file's name or
// path. A file name may hold any byte except '/' and 0.
std::string printable(std::string_view bytes);

// "~/levels/easy.obj" for a path below the home folder, and back. Printable; relative paths stay unchanged.
std::string with_tilde(const std::filesystem::path& path);
std::filesystem::path expand_tilde(std::string_view text);

// For each path the shortest end of its folder that distinguishes it from others with the same file name: "a"
// and "b" for x/a/easy.obj and x/b/easy.obj, "a/levels" and "b/levels" for a/levels/easy.obj and
// b/levels/easy.obj. If the file name is unique, the last folder.
std::vector<std::string> distinguishing_folders(std::span<const std::filesystem::path> paths);

// What the Tab key makes of a path.
struct PathCompletion {
    std::string text;                 // as far as it is unique; a folder ends with '/'
    std::vector<std::string> others;  // if there are several: the possible names, sorted
};
// Relative paths start at `base`. Candidates are the names that the dialog would list. Names that begin with
// a dot are candidates only after a typed dot; names that are not UTF-8 never are.
PathCompletion complete_path(std::string_view text, const std::filesystem::path& base, FolderWants wants);

}  // namespace slipface
