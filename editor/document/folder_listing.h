// The content of a folder, as the file dialog lists it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace slipface {

struct FolderEntry {
    std::string name;  // any bytes but '/'
    bool folder = false;
    // This is a level's geometry; its level file is in the same folder and has no row of its own.
    bool has_level_file = false;
    std::uint64_t bytes = 0;     // of a file
    std::int64_t changed_s = 0;  // since 1970, UTC; the newer of geometry and level file
};

struct FolderListing {
    std::vector<FolderEntry> entries;
    std::string problem;       // why the folder cannot be read; empty: it can
    std::size_t left_out = 0;  // entries beyond the limit
};

struct FolderWants {
    std::function<bool(const std::string& name)> file;  // which files are listed; folders always are
    bool hidden = false;                                // names that begin with a dot are listed, too
    bool one_row_per_level = false;
};

inline constexpr std::size_t max_listed_entries = 100'000;

// Unsorted. A file that disappears meanwhile, or cannot be examined, has no size and no date.
FolderListing list_folder(const std::filesystem::path& folder, const FolderWants& wants);

// True for level files, OBJ files and whatever else import_mesh() reads.
bool is_level_name(const std::string& name);

enum class ListingOrder : std::uint8_t { name, size, date };
// Folders first. Equal entries are sorted by name; upper and lower case count as the same.
void sort_listing(std::vector<FolderEntry>& entries, ListingOrder order, bool descending);

// A folder that the dialog offers to start from.
struct StartFolder {
    std::string name;
    std::filesystem::path folder;
};
// The home folder, the sample levels, the root, and the mounts under /media, /run/media and /mnt; `mounts` is
// the text of /proc/self/mounts.
std::vector<StartFolder> usual_folders(std::string_view mounts);
// The folders of these files in the order of the files, each once.
std::vector<std::filesystem::path> folders_of(std::span<const std::filesystem::path> files);

}  // namespace slipface
