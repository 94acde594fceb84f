// The levels' textures, painted by rule. Each function paints one image that repeats at its borders unless
// said otherwise.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "slipface/image/image.h"

namespace slipface::generate {

struct Texture {
    std::string name;  // file name without ".png"
    std::function<Image()> paint;
};

std::vector<Texture> stone_textures();
std::vector<Texture> ornament_textures();
std::vector<Texture> nature_textures();
std::vector<Texture> wild_textures();     // of the open air and of the mines
std::vector<Texture> surface_textures();  // their look shows the surface type
Image paint_labels();

}  // namespace slipface::generate
