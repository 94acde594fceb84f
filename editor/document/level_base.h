// What the level file held when a document was last the same as it: what its unsaved changes add to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "slipface/base/result.h"

namespace slipface {

// A hash of what the text of a level file says: the white space between its words does not count. Never 0.
std::uint64_t content_of(std::string_view json);

struct LevelBase {
    std::shared_ptr<const std::string> text{};  // null: there was no file
    std::uint64_t content = 0;                  // content_of(*text); 0: there was no file
};
LevelBase level_base(std::optional<std::string> text);
// The file as it is now. A file that does not exist is no error.
Result<LevelBase> read_level_base(const std::filesystem::path& file);

}  // namespace slipface
