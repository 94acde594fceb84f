// An open file that closes itself, and words for what went wrong with it.
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace slipface {

// close() returns the errno of a delayed write error, which network file systems report only then.
class Descriptor {
  public:
    explicit Descriptor(int handle) : handle_(handle) {}
    Descriptor(Descriptor&& other) noexcept : handle_(std::exchange(other.handle_, -1)) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor& operator=(Descriptor&&) = delete;
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

inline std::string reason_of_errno(int error) {
    return std::generic_category().message(error);
}

inline const char* kind_of_file(mode_t mode) {
    if (S_ISDIR(mode)) return "a directory";
    if (S_ISFIFO(mode)) return "a pipe";
    if (S_ISSOCK(mode)) return "a socket";
    return "a device";
}

}  // namespace slipface
