// The primitives of a glTF file's meshes: vertices in the mesh's own space, and triangles.
#pragma once

#include <array>
#include <vector>

#include "gltf/gltf_file.h"
#include "slipface/base/types.h"

namespace slipface {

struct GltfPrimitive {
    std::vector<std::uint32_t> corners;       // three vertices for each triangle
    std::vector<Vec3f> positions;             // [vertex]
    std::vector<Vec2f> uv;                    // [vertex] V down; or empty
    std::vector<std::vector<Vec3f>> targets;  // [morph target][vertex] what it adds to the position, or empty
    // Joints of a skin, by their place in its list, and their weights: a number of pairs for each vertex.
    std::size_t influences = 0;
    std::vector<std::uint32_t> joints;
    std::vector<float> weights;
    std::size_t dropped = 0;  // points and lines, which are no faces
};

// `uv_set`: the attribute that the primitive's material uses.
GltfPrimitive gltf_primitive(GltfFile& file, const GltfValue& primitive, const std::string& uv_set);

}  // namespace slipface
