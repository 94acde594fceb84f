#include "slipface/base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "descriptor.h"
#include "slipface/base/hash.h"
#include "slipface/base/types.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

Result<std::string> read_all(int handle, std::uint64_t size, const std::string& location,
                             std::uint64_t max_bytes) {
    const auto too_big = [&](std::uint64_t found) {
        return Error{location, fmt::format("is {} bytes long; at most {} are read", found, max_bytes)};
    };
    if (size > max_bytes) return too_big(size);

    // One byte more than the size reported: needed for the read that finds the end, and for a file that grows
    // meanwhile.
    std::string bytes(static_cast<std::size_t>(size) + 1, '\0');
    std::size_t used = 0;
    for (;;) {
        if (used == bytes.size()) bytes.resize(bytes.size() + std::max<std::size_t>(bytes.size() / 2, 4096));
        std::size_t count = 0;
        if (const int error = platform::read_some(handle, bytes.data() + used, bytes.size() - used, count);
            error != 0)
            return Error{location, "cannot be read: " + reason_of_errno(error)};
        if (count == 0) break;
        used += count;
        if (used > max_bytes) return too_big(used);
    }
    bytes.resize(used);
    return bytes;
}

}  // namespace

Result<std::string> read_file(const fs::path& path, std::uint64_t max_bytes) {
    const std::string location = path.string();
    if (location.find('\0') != std::string::npos)
        return Error{"", "a path with a zero byte in it names no file"};
    const Descriptor file(platform::open_to_read(path, platform::Links::follow));
    if (!file.open()) {
        if (errno == ENOENT) return Error{location, "no such file"};
        return Error{location, "cannot be opened: " + reason_of_errno(errno)};
    }
    platform::FileStatus status;
    if (const int error = platform::status_of(file.get(), status); error != 0)
        return Error{location, "cannot be read: " + reason_of_errno(error)};
    if (status.other_kind != nullptr)
        return Error{location, fmt::format("is {}; expected a file", status.other_kind)};
    try {
        return read_all(file.get(), status.bytes, location, max_bytes);
    } catch (const std::bad_alloc&) {
        return Error{location,
                     fmt::format("is {} bytes long; there is not enough memory for it", status.bytes)};
    }
}

std::uint64_t fingerprint_of_files(std::span<const fs::path> files) {
    Hasher hasher;
    for (const fs::path& file : files) {
        hasher.text(file.filename().string());
        const Result<std::string> bytes = read_file(file);
        hasher.u64(bytes ? bytes->size() : no_id);
        if (bytes) hasher.u64(hash_blocks(bytes->data(), bytes->size()));
    }
    return hasher.value();
}

bool lies_within(const fs::path& file, const fs::path& folder) {
    std::error_code error;
    const fs::path inner = fs::weakly_canonical(file, error);
    if (error) return false;
    const fs::path outer = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error);
    if (error || outer.empty()) return false;
    return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

}  // namespace slipface
