// The clips of a glTF file: its animations.
#pragma once

#include <vector>

#include "gltf/gltf_scene.h"
#include "slipface/mesh/rig.h"

namespace slipface {

// Clips of the nodes of `rig`, which are those of the scene. `index_of`: [node of the file] its index there,
// or no_id. A channel of something else is left out, and so is a clip without any.
std::vector<Clip> gltf_clips(GltfFile& file, const Rig& rig, const std::vector<std::uint32_t>& index_of);

}  // namespace slipface
