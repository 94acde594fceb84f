#include "document/recent_files.h"

#include <algorithm>

#include "slipface/base/files.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr std::uint64_t max_bytes = 1 << 20;

bool storable(std::string_view line) {
    return !line.empty() &&
           std::none_of(line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r' || c == '\0'; });
}

}  // namespace

RecentFiles::RecentFiles(std::filesystem::path file) : file_(std::move(file)) {
    const Result<std::string> text = read_file(file_, max_bytes);
    if (!text) return;
    for (std::string_view line : split(*text, '\n')) {
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        if (!storable(line) || paths_.size() == capacity) continue;
        std::filesystem::path path(line);
        if (path.is_absolute() && std::find(paths_.begin(), paths_.end(), path) == paths_.end())
            paths_.push_back(std::move(path));
    }
}

void RecentFiles::add(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(path, error).lexically_normal();
    if (error || !storable(absolute.native())) return;
    std::erase(paths_, absolute);
    paths_.insert(paths_.begin(), absolute);
    if (paths_.size() > capacity) paths_.resize(capacity);
    if (file_.empty()) return;

    std::string text;
    for (const std::filesystem::path& kept : paths_)
        text += kept.native() + '\n';
    std::filesystem::create_directories(file_.parent_path(), error);
    // Errors are ignored: the list is a convenience, and the next file tries again.
    static_cast<void>(write_file_atomic(file_, text));
}

}  // namespace slipface
