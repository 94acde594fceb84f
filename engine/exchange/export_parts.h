// Functions that all exporters use.
#pragma once

#include "slipface/exchange/export.h"
#include "slipface/exchange/name_materials.h"

namespace slipface {

// The path of the material's texture, relative to `folder` if possible; empty without a texture.
std::string texture_from(const Level& level, const Material& material, const std::filesystem::path& folder);

// False if every corner has the same texture position, zero.
bool textured(const Mesh& mesh);

// Errors: a level without geometry; `path` is one of the level's own files.
Status check_target(const Level& level, const std::filesystem::path& path);

}  // namespace slipface
