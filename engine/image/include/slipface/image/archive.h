// Several files in one: a tar archive packed by gzip, which every system's own tools open.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "slipface/base/result.h"

namespace slipface {

struct ArchiveEntry {
    std::string name;  // relative, with '/': "textures/sand.png", at most 100 bytes
    std::string bytes;
    friend bool operator==(const ArchiveEntry&, const ArchiveEntry&) = default;
};

inline constexpr std::size_t max_archive_bytes = std::size_t{1} << 30;  // unpacked

// The same entries give the same bytes. Errors: a name that is too long, or more than max_archive_bytes.
Result<std::string> archive_of(std::span<const ArchiveEntry> entries);
// Reads what archive_of() writes, and such archives of others: files only, folders are skipped. `location`
// names it in errors. A name that leads out of its folder, or comes twice, is an error.
Result<std::vector<ArchiveEntry>> read_archive(std::string_view bytes, const std::string& location);

}  // namespace slipface
