// The level file of `easy`: which materials are what, some faces painted by hand, where the player starts,
// viewpoints.
#pragma once

#include <filesystem>

#include "slipface/base/result.h"

namespace slipface::generate {

// Writes easy.slipface.json beside `obj`, which must have been written before.
Status write_easy_level(const std::filesystem::path& obj);

}  // namespace slipface::generate
