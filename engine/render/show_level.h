// Passes a level to a LevelRenderer.
#pragma once

#include "slipface/level/level.h"
#include "slipface/render/level_renderer.h"

namespace slipface {

// Sets all that is drawn of a level at rest: faces and terrain, textures from the mesh file's folder, baked
// light from the level file's folder, types. Warns about textures and light that could not be used.
Warnings show_level(LevelRenderer& renderer, const Level& level);

// Sets only the types of the level and of its faces.
void show_surfaces(LevelRenderer& renderer, const Level& level);

}  // namespace slipface
