#pragma once

#include <string>
#include <vector>

#include "slipface/base/progress.h"
#include "slipface/mesh/build.h"
#include "warning_list.h"

namespace slipface {

// A name and the line on which it was first used.
struct NameOnLine {
    std::string name;
    std::size_t line = 0;
};

// The content of an OBJ file, without the properties of its materials.
struct ObjPolygons {
    PolygonSoup soup;                   // indexed; `materials` is empty
    std::vector<NameOnLine> materials;  // `usemtl` names, in the order in which faces use them
    std::vector<NameOnLine> libraries;  // the arguments of each `mtllib`
};

// Reads an OBJ text on all cores. Numbers are rounded as assimp rounds them. The errors are those of
// import_mesh(). `location`: the file's name in messages. What is returned after `progress` was cancelled is
// incomplete.
Result<ObjPolygons> read_obj(std::string text, const std::string& location, WarningList& warnings,
                             Progress* progress);

}  // namespace slipface
