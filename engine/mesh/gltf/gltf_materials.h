// The materials of a glTF file, with the pictures that it contains.
#pragma once

#include <vector>

#include "gltf/gltf_file.h"
#include "slipface/mesh/mesh.h"
#include "warning_list.h"

namespace slipface {

struct GltfMaterial {
    Material material;
    std::string uv_set = "TEXCOORD_0";  // the attribute with its texture positions
    // How texture positions with V up follow from the file's, which have V down.
    Eigen::Matrix<float, 2, 3> uv_transform = (Eigen::Matrix<float, 2, 3>() << 1, 0, 0, 0, -1, 1).finished();
};

// All materials of the file, and one more, which is white, for faces without one. A type in a material's
// `extras`, {"slipface_type": "ice"}, is appended to its name as "__ice", so that it counts like a suffix
// that a user typed. Blender writes custom properties there.
std::vector<GltfMaterial> gltf_materials(GltfFile& file, WarningList& warnings);

}  // namespace slipface
