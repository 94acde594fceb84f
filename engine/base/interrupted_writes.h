// The names and the list by which the work of a killed writer is recognised.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "descriptor.h"

namespace slipface {

// ".NAME.slipface.PID-N.tmp" beside `target`: a name that no other writer uses, short enough for the file
// system.
std::filesystem::path temporary_name(const std::filesystem::path& target);

// ".slipface.PID-N.renames" in `folder`.
std::filesystem::path rename_list_name(const std::filesystem::path& folder);

// From the temporary name to the name, both relative to the list's folder.
using Renames = std::vector<std::pair<std::filesystem::path, std::filesystem::path>>;
std::string rename_list_text(const Renames& renames);

}  // namespace slipface
