// Pictures that are written beside an exported file, as STEM-PICTURE.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace slipface {

struct PictureFile {
    std::filesystem::path path;
    std::string bytes;
};

class PicturesBeside {
  public:
    explicit PicturesBeside(const std::filesystem::path& exported);
    // Returns the name of the new file in folder().
    std::filesystem::path add(const std::filesystem::path& picture, std::string bytes);
    const std::filesystem::path& folder() const { return folder_; }
    std::vector<PictureFile> take() { return std::move(files_); }

  private:
    std::filesystem::path folder_;
    std::string stem_;
    std::vector<PictureFile> files_;
};

}  // namespace slipface
