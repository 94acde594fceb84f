#pragma once

#include <optional>
#include <string_view>

#include "obj/obj_scan.h"
#include "slipface/base/progress.h"
#include "slipface/mesh/build.h"

namespace slipface {

// The content of an ordinary OBJ file, without the properties of its materials.
struct ObjPolygons {
    PolygonSoup soup;  // indexed; `materials` is empty
    std::vector<NameOnLine> materials;
    std::vector<NameOnLine> libraries;
};

// Reads an OBJ text on all cores, with the same bits as scan_obj() and assimp. Returns nothing for a text
// with anything unusual, whether wrong or only rare (continued lines, comments after a statement, curves,
// faces that would be dropped): the careful reader handles those and writes the warnings. Also returns
// nothing if `progress` was cancelled.
std::optional<ObjPolygons> read_ordinary_obj(std::string_view text, Progress* progress);

}  // namespace slipface
