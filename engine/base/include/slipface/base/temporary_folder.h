// A folder of the system's temporary folder that goes with its owner.
#pragma once

#include <filesystem>

#include "slipface/base/result.h"

namespace slipface {

class TemporaryFolder {
  public:
    // Of a name that no other has, for this user alone.
    static Result<TemporaryFolder> make();
    TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::move(other.path_)) { other.path_.clear(); }
    TemporaryFolder& operator=(TemporaryFolder&&) = delete;
    ~TemporaryFolder();

    const std::filesystem::path& path() const { return path_; }

  private:
    explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}
    std::filesystem::path path_;
};

}  // namespace slipface
