#pragma once

#include <string>
#include <vector>

#include "slipface/exchange/name_materials.h"

namespace slipface {

struct MaterialPatch {
    std::filesystem::path path;
    std::string before, after;
};

// The changes that add the typed materials to the material libraries of an OBJ text: a copy of the material's
// lines under the new name, with a tinted colour. A name that the library already has is not added. Libraries
// outside the level's folder, and those that cannot be read, are not changed.
std::vector<MaterialPatch> patch_libraries(const Level& level, std::string_view obj,
                                           const TypedMaterials& materials);

}  // namespace slipface
