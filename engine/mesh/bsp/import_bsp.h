#pragma once

#include <string>
#include <string_view>

#include "assimp/imported_soup.h"
#include "warning_list.h"

namespace slipface {

// Reads a Quake 3 map: its drawn faces, then its undrawn walls, its spawns, and the surface types from the
// flags of its textures. Materials have the names of the map's textures. Coordinates are those of the map: +Z
// up, 32 units per metre. Every offset, size and index is checked.
Result<ImportedSoup> import_bsp(std::string_view bytes, const std::string& location, WarningList& warnings,
                                Progress* progress);

}  // namespace slipface
