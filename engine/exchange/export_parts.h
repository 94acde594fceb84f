// Functions that all exporters use.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "slipface/base/result.h"
#include "slipface/exchange/export.h"
#include "slipface/exchange/name_materials.h"

namespace slipface {

struct ExportedFile {
    std::filesystem::path path;
    std::string bytes;
};

// The files of each target, to be written together. Errors as in export.h.
Result<std::vector<ExportedFile>> obj_files(const Level& level, const std::filesystem::path& path);
Result<std::vector<ExportedFile>> gltf_files(const Level& level, const std::filesystem::path& path,
                                             std::span<const GltfNode> nodes);
Result<std::vector<ExportedFile>> flat_files(const Level& level, const std::filesystem::path& path);

// The path of the material's texture, relative to `folder` if possible; empty without a texture.
std::string texture_from(const Level& level, const Material& material, const std::filesystem::path& folder);

// False if every corner has the same texture position, zero.
bool textured(const Mesh& mesh);

}  // namespace slipface
