// An open file that closes itself, and words for what went wrong with it.
#pragma once

#include <string>
#include <system_error>
#include <utility>

#include "platform/file_calls.h"

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
        return handle >= 0 ? platform::close(handle) : 0;
    }

  private:
    int handle_;
};

inline std::string reason_of_errno(int error) {
    return std::generic_category().message(error);
}

}  // namespace slipface
