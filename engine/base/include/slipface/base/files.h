// Whole-file reading and writing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "slipface/base/result.h"

namespace slipface {

// The bytes of `path`. Refuses, with the reason: a missing file, a directory or other non-regular file, a
// file of more than `max_bytes`, an unreadable one.
Result<std::string> read_file(const std::filesystem::path& path,
                              std::uint64_t max_bytes = std::uint64_t{4} << 30);

// Replaces `path` by `bytes` so that a reader, and a machine that loses power, sees the old or the new file
// and never a mixture: writes a temporary file beside it, flushes it to disk, renames it.
Status write_file_atomic(const std::filesystem::path& path, std::string_view bytes);

// Whether `file`, symbolic links followed as far as they exist, lies in `folder` or below.
bool lies_within(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace slipface
