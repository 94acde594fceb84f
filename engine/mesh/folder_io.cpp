#include "folder_io.h"

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "slipface/base/files.h"
#include "slipface/mesh/formats.h"

namespace slipface {

namespace fs = std::filesystem;

namespace {

// A file in memory. Some of assimp's readers read at the end of a truncated file for ever. An exception,
// which assimp turns into an error, stops them.
class GuardedStream final : public Assimp::IOStream {
  public:
    explicit GuardedStream(std::string bytes) : bytes_(std::move(bytes)) {}

    std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
        if (size == 0 || count == 0) return 0;
        const std::size_t items = std::min(count, (bytes_.size() - at_) / size);
        if (items == 0 && ++reads_at_end_ > patience) throw std::runtime_error("unexpected end of file");
        std::memcpy(buffer, bytes_.data() + at_, items * size);
        at_ += items * size;
        return items;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        const std::size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
        if (offset > bytes_.size() - base) return aiReturn_FAILURE;
        at_ = base + offset;
        return aiReturn_SUCCESS;
    }
    std::size_t Tell() const override { return at_; }
    std::size_t FileSize() const override { return bytes_.size(); }
    void Flush() override {}

  private:
    static constexpr int patience = 1000;
    std::string bytes_;
    std::size_t at_ = 0;
    int reads_at_end_ = 0;
};

}  // namespace

FolderIo::FolderIo(const fs::path& folder, std::vector<std::string>& asked_for)
    : folder_(folder), asked_for_(asked_for) {}

bool FolderIo::readable(const fs::path& file) const {
    std::error_code error;
    return lies_within(file, folder_) && fs::is_regular_file(file, error);
}

bool FolderIo::Exists(const char* file) const {
    try {
        return readable(file);
    } catch (const std::exception&) {
        return false;
    }
}

Assimp::IOStream* FolderIo::Open(const char* file, const char* mode) {
    if (std::strpbrk(mode, "wa+") != nullptr) return nullptr;
    if (lies_within(file, folder_) &&
        std::find(asked_for_.begin(), asked_for_.end(), file) == asked_for_.end())
        asked_for_.emplace_back(file);
    if (!readable(file)) return nullptr;
    auto bytes = read_file(file, max_geometry_bytes);
    return bytes ? new GuardedStream(std::move(*bytes)) : nullptr;
}

void FolderIo::Close(Assimp::IOStream* stream) {
    delete stream;
}

}  // namespace slipface
