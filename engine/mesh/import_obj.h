#pragma once

#include <filesystem>
#include <string>

#include "slipface/mesh/build.h"
#include "warning_list.h"

namespace slipface {

Result<PolygonSoup> import_obj(const std::filesystem::path& path, std::string text, WarningList& warnings);

}  // namespace slipface
