#include "slipface/base/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <new>
#include <system_error>
#include <utility>

#include "slipface/base/hash.h"
#include "slipface/base/types.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) {
    return std::generic_category().message(error);
}

// An open file that closes itself. close() returns the errno of a delayed write error, which network file
// systems report only then.
class Descriptor {
  public:
    explicit Descriptor(int handle) : handle_(handle) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { (void)close(); }

    bool open() const { return handle_ >= 0; }
    int get() const { return handle_; }
    int close() {
        const int handle = std::exchange(handle_, -1);
        return handle >= 0 && ::close(handle) != 0 ? errno : 0;
    }

  private:
    int handle_;
};

const char* kind_of(mode_t mode) {
    if (S_ISDIR(mode)) return "a directory";
    if (S_ISFIFO(mode)) return "a pipe";
    if (S_ISSOCK(mode)) return "a socket";
    return "a device";
}

// The end of a chain of symbolic links, whether or not a file is there.
Result<fs::path> link_target(const fs::path& path) {
    constexpr int longest_chain = 40;  // the limit in Linux
    fs::path target = path;
    for (int hop = 0; hop < longest_chain; ++hop) {
        std::error_code error;
        if (!fs::is_symlink(fs::symlink_status(target, error))) return target;
        const fs::path next = fs::read_symlink(target, error);
        if (error) return Error{path.string(), "cannot follow the symbolic link: " + error.message()};
        target = next.is_absolute() ? next : target.parent_path() / next;
    }
    return Error{path.string(), "too many symbolic links, one after the other"};
}

// A name beside `target` that no other writer uses and that is short enough for the file system.
fs::path temporary_name(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    constexpr std::size_t longest_stem = 200;
    const std::string stem = target.filename().string().substr(0, longest_stem);
    return target.parent_path() / fmt::format(".{}.{}-{}.tmp", stem, ::getpid(), counter++);
}

int write_all(int handle, std::string_view bytes) {
    constexpr std::size_t largest_write = std::size_t{1} << 30;  // Linux writes at most 2 GiB at once
    while (!bytes.empty()) {
        const ssize_t written = ::write(handle, bytes.data(), std::min(bytes.size(), largest_write));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

// Writes and flushes a new file. Returns 0, or the errno that stopped it.
int write_new(const fs::path& path, std::string_view bytes, const mode_t* mode) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!file.open()) return errno;
    if (mode != nullptr && ::fchmod(file.get(), *mode & 07777) != 0) return errno;
    if (const int error = write_all(file.get(), bytes); error != 0) return error;
    if (::fsync(file.get()) != 0) return errno;
    return file.close();
}

// Flushes the folder, so that the rename survives a power failure. File systems that cannot flush a directory
// return EINVAL.
int flush_directory(const fs::path& file) {
    const fs::path folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
    const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!directory.open()) return errno == EACCES ? 0 : errno;
    return ::fsync(directory.get()) != 0 && errno != EINVAL ? errno : 0;
}

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
        if (count < 0) return Error{location, "cannot be read: " + reason(errno)};
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
        return Error{location, "cannot be opened: " + reason(errno)};
    }
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) return Error{location, "cannot be read: " + reason(errno)};
    if (!S_ISREG(status.st_mode)) {
        return Error{location, fmt::format("is {}; expected a file", kind_of(status.st_mode))};
    }
    try {
        return read_all(file.get(), status, location, max_bytes);
    } catch (const std::bad_alloc&) {
        return Error{location,
                     fmt::format("is {} bytes long; there is not enough memory for it", status.st_size)};
    }
}

Status write_file_atomic(const fs::path& path, std::string_view bytes) {
    const std::string location = path.string();
    if (path.filename().empty() || location.find('\0') != std::string::npos) {
        return Error{location, "names no file to write"};
    }
    const auto resolved = link_target(path);
    if (!resolved) return resolved.error();
    const fs::path& target = *resolved;

    struct stat status {};
    const bool exists = ::stat(target.c_str(), &status) == 0;
    if (exists && !S_ISREG(status.st_mode)) {
        return Error{location, fmt::format("is {}; expected a file", kind_of(status.st_mode))};
    }
    // A rename would replace a write-protected file, against the wish of its owner.
    if (exists && ::access(target.c_str(), W_OK) != 0) {
        return Error{location, "cannot be written: " + reason(errno)};
    }

    // In containers process numbers begin anew, so that a name may be left over from a process that was
    // killed.
    constexpr int max_tries = 100;
    fs::path temporary;
    int error = EEXIST;
    for (int tries = 0; error == EEXIST && tries < max_tries; ++tries) {
        temporary = temporary_name(target);
        error = write_new(temporary, bytes, exists ? &status.st_mode : nullptr);
    }
    if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
    if (error != 0) {
        if (error != EEXIST) ::unlink(temporary.c_str());
        return Error{location, "cannot be written: " + reason(error)};
    }
    if (error = flush_directory(target); error != 0) {
        return Error{location, "is written, but its folder cannot be flushed to disk: " + reason(error)};
    }
    return {};
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
