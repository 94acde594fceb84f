#pragma once

#include <string>
#include <vector>

#include "slipface/exchange/bake.h"

namespace slipface {

struct MaterialPatch {
    std::filesystem::path path;
    std::string before, after;
};

// The material libraries that the level's OBJ file names, those outside its folder too; nothing where the
// geometry is no OBJ or cannot be read.
std::vector<std::filesystem::path> named_libraries(const Level& level);

// The material libraries of an OBJ text with the typed materials appended: a copy of the material's lines
// under the new name, its colour tinted. A library that already has the name, one outside the level's folder
// and one that cannot be read are left alone.
std::vector<MaterialPatch> patch_libraries(const Level& level, std::string_view obj,
                                           const TypedMaterials& materials);

}  // namespace slipface
