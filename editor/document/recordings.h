// Runs that were recorded and not saved, kept where neither quitting nor a crash can take them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "slipface/base/result.h"

namespace slipface {

class Recordings {
  public:
    static constexpr std::size_t max_kept = 32;

    Recordings() = default;  // keeps nothing
    explicit Recordings(std::filesystem::path folder) : folder_(std::move(folder)) {}

    bool active() const { return !folder_.empty(); }
    const std::filesystem::path& folder() const { return folder_; }

    // Writes the text of a tape as "YEAR-MONTH-DAY HOUR.MINUTE.SECOND NAME.tape" in local time and deletes
    // the oldest files of such names beyond most_kept. Other files in the folder are left alone.
    Status keep(std::string_view name, std::string_view text) const;

  private:
    std::filesystem::path folder_;
};

}  // namespace slipface
