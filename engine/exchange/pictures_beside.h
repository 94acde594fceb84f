// Pictures that are written beside an exported file, as STEM-PICTURE.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "export_parts.h"

namespace slipface {

class PicturesBeside {
  public:
    explicit PicturesBeside(const std::filesystem::path& exported);
    // Returns the name of the new file in folder().
    std::filesystem::path add(const std::filesystem::path& picture, std::string bytes);
    const std::filesystem::path& folder() const { return folder_; }
    std::vector<ExportedFile> take() { return std::move(files_); }

  private:
    std::filesystem::path folder_;
    std::string stem_;
    std::vector<ExportedFile> files_;
};

}  // namespace slipface
