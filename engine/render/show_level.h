// A level as LevelRenderer takes it.
#pragma once

#include "slipface/level/level.h"
#include "slipface/render/level_renderer.h"

namespace slipface {

// All that a level looks like at rest: faces and terrain, textures of the mesh file's folder, baked light of
// the level file's folder, types. Returns what of it could not be used.
Warnings show_level(LevelRenderer& renderer, const Level& level);

// The types of the level and of its faces alone.
void show_surfaces(LevelRenderer& renderer, const Level& level);

}  // namespace slipface
