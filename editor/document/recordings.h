// Recorded runs that the user has not saved, stored so that neither quitting nor a crash loses them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "slipface/base/result.h"

namespace slipface {

class Recordings {
  public:
    static constexpr std::size_t max_stored = 32;

    Recordings() = default;  // stores nothing
    explicit Recordings(std::filesystem::path folder) : folder_(std::move(folder)) {}

    bool active() const { return !folder_.empty(); }
    const std::filesystem::path& folder() const { return folder_; }

    // Writes the text of a tape to "YEAR-MONTH-DAY HOUR.MINUTE.SECOND NAME.tape" (local time) and deletes the
    // oldest files with such names beyond max_stored. Other files in the folder are not touched.
    Status store(std::string_view name, std::string_view text) const;

  private:
    std::filesystem::path folder_;
};

}  // namespace slipface
