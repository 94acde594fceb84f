#pragma once

#include <optional>
#include <string_view>

#include "obj_scan.h"
#include "slipface/base/progress.h"
#include "slipface/mesh/build.h"

namespace slipface {

// What an ordinary OBJ file holds, without its materials' looks.
struct ObjPolygons {
    PolygonSoup soup;  // indexed; `materials` is empty
    std::vector<NameOnLine> materials;
    std::vector<NameOnLine> libraries;
};

// Reads an OBJ text on all cores, to the bits that scan_obj() and assimp come to. Nothing for a text with
// anything out of the ordinary in it, be it wrong or only rare (continued lines, comments behind a statement,
// curves, faces that would be dropped): the careful reader judges those, and words the warnings. Nothing,
// too, when `progress` was cancelled.
std::optional<ObjPolygons> read_ordinary_obj(std::string_view text, Progress* progress);

}  // namespace slipface
