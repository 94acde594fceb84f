#pragma once

#include <filesystem>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "obj_scan.h"
#include "slipface/mesh/mesh.h"
#include "warning_list.h"

namespace slipface {

using MaterialsByName = std::unordered_map<std::string, Material>;

// The grey material that a name stands for until a library says more.
inline Material named_material(std::string name) {
    Material material;
    material.name = std::move(name);
    return material;
}

// Reads `newmtl`, `Kd` and `map_Kd` of an MTL file; the first definition of a name counts. `folder` is put
// before texture names: the MTL's own folder as seen from the level's.
void read_mtl(std::string text, const std::string& location, const std::filesystem::path& folder,
              MaterialsByName& materials, WarningList& warnings);

// The libraries that an OBJ file names, as far as they lie in its folder or below; each that cannot be read
// is a warning. Returns whether any was read.
bool load_libraries(const std::filesystem::path& obj, const std::vector<NameOnLine>& libraries,
                    MaterialsByName& materials, WarningList& warnings);

}  // namespace slipface
