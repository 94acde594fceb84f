#pragma once

#include <string>
#include <string_view>

#include "imported_soup.h"
#include "warning_list.h"

namespace slipface {

// A Quake 3 map: its drawn faces, then what stops a player without being drawn, its spawns, and the types
// that its textures' flags stand for. Materials are named as the map's textures. Coordinates are the map's:
// +Z up, 32 units per metre. Every offset, size and index is checked.
Result<ImportedSoup> import_bsp(std::string_view bytes, const std::string& location, WarningList& warnings,
                                Progress* progress);

}  // namespace slipface
