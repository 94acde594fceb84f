// What the exporters share.
#pragma once

#include "slipface/exchange/bake.h"
#include "slipface/exchange/export.h"

namespace slipface {

// The material's texture as seen from `folder`; empty where it has none.
std::string texture_from(const Level& level, const Material& material, const std::filesystem::path& folder);

// Refuses a level without geometry, and to write over the level's own files.
Status check_target(const Level& level, const std::filesystem::path& path);

}  // namespace slipface
