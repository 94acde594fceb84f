#pragma once

#include <filesystem>
#include <string>

#include "slipface/base/progress.h"
#include "slipface/mesh/build.h"
#include "warning_list.h"

namespace slipface {

// Reads the OBJ file `path` with the content `text`. Cancelling through `progress` gives an error.
Result<PolygonSoup> import_obj(const std::filesystem::path& path, std::string text, WarningList& warnings,
                               Progress* progress);

}  // namespace slipface
