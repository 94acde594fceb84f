// What lies in a folder, as the file dialog lists it.
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
    bool has_level_file =
        false;                // a level's geometry: its level file lies beside it and has no row of its own
    std::uint64_t bytes = 0;  // of a file
    std::int64_t changed_s = 0;  // since 1970, UTC; of the geometry or its level file, whichever is newer
};

struct FolderListing {
    std::vector<FolderEntry> entries;
    std::string problem;       // why the folder cannot be read; empty: it was
    std::size_t left_out = 0;  // entries beyond the limit
};

struct FolderWants {
    std::function<bool(const std::string& name)> file;  // which files are listed; folders always are
    bool hidden = false;                                // names that begin with a dot, too
    bool one_row_per_level = false;
};

inline constexpr std::size_t max_listed_entries = 100'000;

// Unsorted. A file that vanishes meanwhile, or cannot be looked at, is listed without size and date.
FolderListing list_folder(const std::filesystem::path& folder, const FolderWants& wants);

// OBJ files and whatever else import_mesh() reads, and level files.
bool is_level_name(const std::string& name);

enum class ListingOrder : std::uint8_t { name, size, date };
// Folders first; equal ones by name, in which upper and lower case count as the same.
void sort_listing(std::vector<FolderEntry>& entries, ListingOrder order, bool descending);

// A folder to start from.
struct StartFolder {
    std::string name;
    std::filesystem::path folder;
};
// The home folder, the sample levels, the root, and what is mounted under /media, /run/media and /mnt;
// `mounts` is the text of /proc/self/mounts.
std::vector<StartFolder> usual_folders(std::string_view mounts);
// The folders of these files, each once, in their order.
std::vector<std::filesystem::path> folders_of(std::span<const std::filesystem::path> files);

}  // namespace slipface
