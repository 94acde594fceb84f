#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "platform/file_calls.h"

namespace slipface::platform {
namespace {

namespace fs = std::filesystem;

int result_of(int returned) {
    return returned != 0 ? errno : 0;
}

void take(const struct stat& from, FileStatus& status) {
    const mode_t mode = from.st_mode;
    status.other_kind = S_ISREG(mode)    ? nullptr
                        : S_ISDIR(mode)  ? "a directory"
                        : S_ISFIFO(mode) ? "a pipe"
                        : S_ISSOCK(mode) ? "a socket"
                                         : "a device";
    status.bytes = static_cast<std::uint64_t>(std::max<off_t>(from.st_size, 0));
    status.permissions = mode & 07777;
}

}  // namespace

int open_to_read(const fs::path& file, Links links) {
    // Without O_NONBLOCK, opening a pipe would wait for a writer.
    return ::open(file.c_str(),
                  O_RDONLY | O_CLOEXEC | O_NONBLOCK | (links == Links::refuse ? O_NOFOLLOW : 0));
}

int make_file(const fs::path& file) {
    return ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

int status_of(int handle, FileStatus& status) {
    struct stat found {};
    if (::fstat(handle, &found) != 0) return errno;
    take(found, status);
    return 0;
}

int status_of(const fs::path& file, FileStatus& status) {
    struct stat found {};
    if (::stat(file.c_str(), &found) != 0) return errno;
    take(found, status);
    return 0;
}

int read_some(int handle, char* bytes, std::size_t size, std::size_t& read) {
    ssize_t count = 0;
    do {
        count = ::read(handle, bytes, size);
    } while (count < 0 && errno == EINTR);
    if (count < 0) return errno;
    read = static_cast<std::size_t>(count);
    return 0;
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

int set_permissions(int handle, unsigned permissions) {
    return result_of(::fchmod(handle, static_cast<mode_t>(permissions)));
}

int flush(int handle) {
    return result_of(::fsync(handle));
}

int close(int handle) {
    return result_of(::close(handle));
}

bool take_lock(int handle) {
    return ::flock(handle, LOCK_EX | LOCK_NB) == 0;
}

int may_write(const fs::path& file) {
    return result_of(::access(file.c_str(), W_OK));
}

int replace(const fs::path& from, const fs::path& to) {
    return result_of(::rename(from.c_str(), to.c_str()));
}

int remove(const fs::path& file) {
    return result_of(::unlink(file.c_str()));
}

// File systems that cannot flush a directory return EINVAL.
int flush_folder(const fs::path& folder) {
    const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (handle < 0) return errno == EACCES ? 0 : errno;
    const int error = result_of(::fsync(handle));
    ::close(handle);
    return error == EINVAL ? 0 : error;
}

int process_number() {
    return ::getpid();
}

bool process_is_gone(int number) {
    return ::kill(number, 0) != 0 && errno == ESRCH;
}

}  // namespace slipface::platform
