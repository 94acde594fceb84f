#include "folder_io.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <cstring>

#include "slipface/base/files.h"

namespace slipface {

namespace fs = std::filesystem;

FolderIo::FolderIo(const fs::path& folder) {
    std::error_code error;
    folder_ = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error);
}

bool FolderIo::readable(const fs::path& file) const {
    std::error_code error;
    const fs::path inner = fs::weakly_canonical(file, error);
    if (error || folder_.empty()) return false;
    const bool inside =
        std::mismatch(folder_.begin(), folder_.end(), inner.begin(), inner.end()).first == folder_.end();
    return inside && fs::is_regular_file(inner, error);
}

bool FolderIo::Exists(const char* file) const {
    try {
        return readable(file);
    } catch (const std::exception&) {
        return false;
    }
}

Assimp::IOStream* FolderIo::Open(const char* file, const char* mode) {
    if (std::strpbrk(mode, "wa+") != nullptr || !readable(file)) return nullptr;
    const auto bytes = read_file(file);
    if (!bytes) return nullptr;
    auto copy = std::make_unique<std::uint8_t[]>(bytes->size() + 1);
    std::memcpy(copy.get(), bytes->data(), bytes->size());
    auto* stream = new Assimp::MemoryIOStream(copy.get(), bytes->size(), true);
    (void)copy.release();  // the stream owns it from here on
    return stream;
}

void FolderIo::Close(Assimp::IOStream* stream) {
    delete stream;
}

}  // namespace slipface
