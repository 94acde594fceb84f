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

// `text` is what the file holds. Cancelled through `progress` it is an error.
Result<ImportedObj> import_obj(const std::filesystem::path& path, std::string text, WarningList& warnings,
                               Progress* progress);

}  // namespace slipface
