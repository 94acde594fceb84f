#include "document/recordings.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <ctime>
#include <vector>

#include "slipface/base/files.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

// "2026-01-31 09.05.00 easy.tape": sorted by name they are sorted by time.
bool is_recording(const std::string& name) {
    constexpr std::string_view shape = "dddd-dd-dd dd.dd.dd ";
    if (name.size() <= shape.size() || !name.ends_with(".tape")) return false;
    return std::equal(shape.begin(), shape.end(), name.begin(),
                      [](char wanted, char c) { return wanted == 'd' ? c >= '0' && c <= '9' : c == wanted; });
}

void delete_oldest(const fs::path& folder, std::size_t maximum) {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (is_recording(it->path().filename().string())) found.push_back(it->path());
    std::sort(found.begin(), found.end());
    for (std::size_t i = 0; i + maximum < found.size(); ++i)
        fs::remove(found[i], error);
}

}  // namespace

Status Recordings::store(std::string_view name, std::string_view text) const {
    if (!active()) return {};
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) return Error{folder_.string(), "cannot be created: " + error.message()};
    fs::path file;
    // If a file of this second exists, use the next second, so that sorting by name stays sorting by time.
    for (std::time_t now = std::time(nullptr); file.empty() || fs::exists(file, error); ++now) {
        std::tm local{};
        ::localtime_r(&now, &local);
        file = folder_ / fmt::format("{:%Y-%m-%d %H.%M.%S} {}.tape", local, name);
    }
    if (Status status = write_file_atomic(file, text); !status) return status;
    delete_oldest(folder_, max_stored);
    return {};
}

}  // namespace slipface
