// Names by which the materials of a scene can be chosen, and written to files that know them by name alone.
#pragma once

#include "slipface/mesh/build.h"

namespace slipface {

// Materials that are equal in everything become one. One with a texture but no name is named after it,
// "road" after "textures/road.png". Of several with one name all but the first get a number, "stone.001", as
// modelling tools write it, which rules and types in names do not see.
void name_materials(PolygonSoup& soup);

}  // namespace slipface
