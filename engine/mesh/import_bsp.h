#pragma once

#include <string>
#include <string_view>

#include "slipface/mesh/build.h"
#include "warning_list.h"

namespace slipface {

// A Quake 3 map: polygons stay faces, meshes are triangles, curved patches are cut into quads. Materials are
// named as the map's textures. Coordinates are the map's: +Z up, about 40 units a metre. Every offset, size
// and index is checked.
Result<PolygonSoup> import_bsp(std::string_view bytes, const std::string& place, WarningList& warnings);

}  // namespace slipface
