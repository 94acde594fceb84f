// Names by which the materials of a scene can be chosen, and written to files that know them by name alone.
#pragma once

#include "slipface/mesh/build.h"

namespace slipface {

// Materials that are equal in everything become one. One with a texture but no name is named after it,
// "road" after "textures/road.png". One name means one look (material_looks.h).
void name_materials(PolygonSoup& soup);

}  // namespace slipface
