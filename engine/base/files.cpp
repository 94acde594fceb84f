#include "slipface/base/files.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "descriptor.h"
#include "slipface/base/hash.h"
#include "slipface/base/types.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

Result<std::string> read_all(int handle, const struct stat& status, const std::string& location,
                             std::uint64_t max_bytes) {
    const auto too_big = [&](std::uint64_t size) {
        return Error{location, fmt::format("is {} bytes long; at most {} are read", size, max_bytes)};
    };
    const auto size = static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0));
    if (size > max_bytes) return too_big(size);

    // One byte more than the size reported: needed for the read that finds the end, and for a file that grows
    // meanwhile.
    std::string bytes(static_cast<std::size_t>(size) + 1, '\0');
    std::size_t used = 0;
    for (;;) {
        if (used == bytes.size()) bytes.resize(bytes.size() + std::max<std::size_t>(bytes.size() / 2, 4096));
        const ssize_t count = ::read(handle, bytes.data() + used, bytes.size() - used);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return Error{location, "cannot be read: " + reason_of_errno(errno)};
        if (count == 0) break;
        used += static_cast<std::size_t>(count);
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
    // Without O_NONBLOCK, opening a pipe would wait for a writer.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!file.open()) {
        if (errno == ENOENT) return Error{location, "no such file"};
        return Error{location, "cannot be opened: " + reason_of_errno(errno)};
    }
    struct stat status {};
    if (::fstat(file.get(), &status) != 0)
        return Error{location, "cannot be read: " + reason_of_errno(errno)};
    if (!S_ISREG(status.st_mode)) {
        return Error{location, fmt::format("is {}; expected a file", kind_of_file(status.st_mode))};
    }
    try {
        return read_all(file.get(), status, location, max_bytes);
    } catch (const std::bad_alloc&) {
        return Error{location,
                     fmt::format("is {} bytes long; there is not enough memory for it", status.st_size)};
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
