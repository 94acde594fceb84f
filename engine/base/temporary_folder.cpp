#include "slipface/base/temporary_folder.h"

#include <chrono>
#include <string>
#include <system_error>

namespace slipface {

namespace fs = std::filesystem;

Result<TemporaryFolder> TemporaryFolder::make() {
    std::error_code error;
    const fs::path base = fs::temp_directory_path(error);
    if (base.empty()) return Error{"TMPDIR", "names no folder; expected the folder for temporary files"};
    // Names differ by the clock; create_directory() says whether one was new.
    for (int tries = 0; tries < 100; ++tries) {
        const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
        const fs::path path = base / ("slipface-" + std::to_string(now));
        if (!fs::create_directory(path, error)) continue;
        fs::permissions(path, fs::perms::owner_all, error);
        return TemporaryFolder(path);
    }
    return Error{base.string(), "no folder can be made in it: " + error.message()};
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace slipface
