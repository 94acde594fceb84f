#include "document/folder_listing.h"

#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <system_error>

#include "document/folders.h"
#include "slipface/base/text.h"
#include "slipface/level/level_file.h"
#include "slipface/mesh/formats.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view level_suffix = ".slipface.json";

bool is_level_file_name(const std::string& name) {
    return to_lower(name).ends_with(level_suffix);
}

void look_at(const fs::path& path, FolderEntry& entry) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return;
    entry.bytes = static_cast<std::uint64_t>(status.st_size);
    entry.changed_s = static_cast<std::int64_t>(status.st_mtim.tv_sec);
}

// Merges a level file into the row of its geometry if that is listed, too.
void join_levels(std::vector<FolderEntry>& entries) {
    std::set<std::string> joined;
    std::vector<const FolderEntry*> level_files;
    for (const FolderEntry& entry : entries)
        if (!entry.folder && is_level_file_name(entry.name)) level_files.push_back(&entry);
    std::sort(level_files.begin(), level_files.end(),
              [](const FolderEntry* a, const FolderEntry* b) { return a->name < b->name; });
    for (FolderEntry& entry : entries) {
        if (entry.folder || mesh_format_of(entry.name) == nullptr) continue;
        const std::string file = level_file_for(entry.name).string();
        const auto found =
            std::lower_bound(level_files.begin(), level_files.end(), file,
                             [](const FolderEntry* a, const std::string& b) { return a->name < b; });
        if (found == level_files.end() || (*found)->name != file) continue;
        entry.has_level_file = true;
        entry.changed_s = std::max(entry.changed_s, (*found)->changed_s);
        joined.insert(file);
    }
    std::erase_if(entries, [&](const FolderEntry& entry) { return joined.contains(entry.name); });
}

// "/media/My\040disk" as /proc/self/mounts spells it.
std::string unescaped(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto octal = [&](std::size_t at) {
            return at < text.size() && text[at] >= '0' && text[at] < '8';
        };
        if (text[i] == '\\' && octal(i + 1) && octal(i + 2) && octal(i + 3)) {
            result +=
                static_cast<char>((text[i + 1] - '0') * 64 + (text[i + 2] - '0') * 8 + (text[i + 3] - '0'));
            i += 3;
        } else {
            result += text[i];
        }
    }
    return result;
}

}  // namespace

bool is_level_name(const std::string& name) {
    return mesh_format_of(name) != nullptr || is_level_file_name(name);
}

FolderListing list_folder(const fs::path& folder, const FolderWants& wants) {
    FolderListing listing;
    std::error_code error;
    fs::directory_iterator it(folder, error);
    for (const fs::directory_iterator end; !error && it != end; it.increment(error)) {
        FolderEntry entry;
        entry.name = it->path().filename().string();
        if (entry.name.starts_with('.') && !wants.hidden) continue;
        std::error_code unreadable;
        entry.folder = it->is_directory(unreadable);
        if (!entry.folder && !wants.file(entry.name)) continue;
        if (listing.entries.size() == max_listed_entries) {
            ++listing.left_out;
            continue;
        }
        look_at(it->path(), entry);
        listing.entries.push_back(std::move(entry));
    }
    if (error) listing.problem = error.message();
    if (wants.one_row_per_level) join_levels(listing.entries);
    return listing;
}

void sort_listing(std::vector<FolderEntry>& entries, ListingOrder order, bool descending) {
    // Lower case once per entry, not once per comparison.
    struct Row {
        FolderEntry entry;
        std::string lower;
    };
    std::vector<Row> rows;
    rows.reserve(entries.size());
    for (FolderEntry& entry : entries) {
        std::string lower = to_lower(entry.name);
        rows.push_back({std::move(entry), std::move(lower)});
    }
    const auto by_name = [](const Row& a, const Row& b) {
        return a.lower != b.lower ? a.lower < b.lower : a.entry.name < b.entry.name;
    };
    std::sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) {
        if (a.entry.folder != b.entry.folder) return a.entry.folder;
        if (order == ListingOrder::size && a.entry.bytes != b.entry.bytes && !a.entry.folder)
            return descending ? a.entry.bytes > b.entry.bytes : a.entry.bytes < b.entry.bytes;
        if (order == ListingOrder::date && a.entry.changed_s != b.entry.changed_s)
            return descending ? a.entry.changed_s > b.entry.changed_s : a.entry.changed_s < b.entry.changed_s;
        return descending && order == ListingOrder::name ? by_name(b, a) : by_name(a, b);
    });
    for (std::size_t i = 0; i < rows.size(); ++i)
        entries[i] = std::move(rows[i].entry);
}

std::vector<StartFolder> usual_folders(std::string_view mounts) {
    std::vector<StartFolder> places;
    if (const char* const home = std::getenv("HOME"); home && *home == '/') places.push_back({"Home", home});
    if (const fs::path data = data_folder(); !data.empty()) places.push_back({"Samples", data / "levels"});
    places.push_back({"File system", "/"});
    for (const std::string_view line : split(mounts, '\n')) {
        const auto words = split(line, ' ');
        if (words.size() < 2) continue;
        const std::string at = unescaped(words[1]);
        const bool medium =
            at.starts_with("/media/") || at.starts_with("/run/media/") || at.starts_with("/mnt");
        if (medium) places.push_back({fs::path(at).filename().string(), at});
    }
    return places;
}

std::vector<fs::path> folders_of(std::span<const fs::path> files) {
    std::vector<fs::path> folders;
    for (const fs::path& file : files)
        if (std::find(folders.begin(), folders.end(), file.parent_path()) == folders.end())
            folders.push_back(file.parent_path());
    return folders;
}

}  // namespace slipface
