#pragma once

#include <filesystem>
#include <string>

#include "slipface/base/progress.h"
#include "slipface/mesh/build.h"
#include "warning_list.h"

namespace slipface {

struct ImportedObj {
    PolygonSoup soup;
    bool through_assimp = false;
};

// Reads the OBJ file `path` with the content `text`. Cancelling through `progress` gives an error.
Result<ImportedObj> import_obj(const std::filesystem::path& path, std::string text, WarningList& warnings,
                               Progress* progress);

}  // namespace slipface
