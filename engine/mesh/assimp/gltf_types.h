// Surface types that a glTF file gives to its materials, which assimp does not report.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "slipface/mesh/mesh.h"
#include "warning_list.h"

namespace slipface {

// Appends the type in a material's `extras`, {"slipface_type": "ice"}, to its name as "__ice", so that it
// counts like a suffix that a user typed. Blender writes custom properties there. `bytes`: a .gltf or .glb
// file; anything else changes nothing. Materials are found by their names; one without a name, or one whose
// name has two types, stays as it is.
// Returns the scene's table of types, ImportedMesh::type_table.
std::string add_gltf_types(std::string_view bytes, const std::string& location,
                           std::vector<Material>& materials, WarningList& warnings);

}  // namespace slipface
