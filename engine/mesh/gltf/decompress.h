// Compressed parts of glTF files. A program without the libraries refuses them by name (stand_ins).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/gltf_file.h"

namespace slipface {

// The bytes of a buffer view with EXT_meshopt_compression, whose members `extension` has. Throws GltfRefused.
std::string decompress_meshopt(const GltfValue& extension, std::string_view compressed);

struct DracoMesh {
    std::vector<std::uint32_t> indices;             // three per triangle
    std::map<std::string, GltfNumbers> attributes;  // "POSITION" ...
};

// A primitive with KHR_draco_mesh_compression, whose members `extension` has. Only the attributes that
// `wanted` names are decompressed. Throws GltfRefused.
DracoMesh decompress_draco(const GltfValue& extension, std::string_view compressed,
                           const std::vector<std::string>& wanted);

}  // namespace slipface
