#pragma once

#include <filesystem>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "obj/obj_reader.h"
#include "slipface/mesh/mesh.h"
#include "warning_list.h"

namespace slipface {

using MaterialsByName = std::unordered_map<std::string, Material>;

// The grey material that a name stands for if no library describes it.
inline Material named_material(std::string name) {
    Material material;
    material.name = std::move(name);
    return material;
}

// Reads `newmtl`, `Kd` and `map_Kd` of an MTL file; of several definitions of a name the first applies.
// `folder` is prepended to texture names: the folder of the MTL relative to the level.
void read_mtl(std::string text, const std::string& location, const std::filesystem::path& folder,
              MaterialsByName& materials, WarningList& warnings);

// Loads the libraries that an OBJ file names, if they lie in its folder or below; each that cannot be read
// gives a warning. Appends the paths of all that are named to `files`. Returns whether any was read.
bool load_libraries(const std::filesystem::path& obj, const std::vector<NameOnLine>& libraries,
                    MaterialsByName& materials, std::vector<std::string>& files, WarningList& warnings);

}  // namespace slipface
