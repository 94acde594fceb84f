// Materials and pictures of a glTF file.
#pragma once

#include <filesystem>
#include <vector>

#include "gltf/buffer.h"
#include "pictures_beside.h"
#include "slipface/exchange/name_materials.h"

namespace slipface {

// Adds `materials`, `textures` and `images` to the file. Pictures are PNG or JPEG files that exist in the
// level's folder or below, or that the level's own file contains; others are converted to PNG, and materials
// whose picture cannot be read have none.
// `embed`: pictures go into the buffer. Otherwise a picture in `folder`, the file's, or below is referred to,
// and others are returned to be written beside the file, as STEM-PICTURE.
std::vector<ExportedFile> add_gltf_materials(const Level& level, const TypedMaterials& materials,
                                             const std::filesystem::path& file, bool embed,
                                             GltfBuffer& buffer, GltfJson& root);

}  // namespace slipface
