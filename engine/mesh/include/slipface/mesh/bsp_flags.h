// The surface parameters of Quake 3, as used in map files and shaders.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/base/result.h"

namespace slipface {

// Sources: the public Quake III source, code/game/surfaceflags.h (flags and contents), q3map/shaders.c (their
// names).
struct BspParameter {
    const char* name;
    std::uint32_t surface_flag, contents_flag;  // 0: none
    const char* type;  // surface type; null: no surface type corresponds to the parameter
};

// All parameters. If a material has several, the first in this order decides.
std::span<const BspParameter> bsp_parameters();

// The surface type for the flags of a map's texture; null if no parameter gives one.
const char* bsp_surface_type(std::uint32_t surface_flags, std::uint32_t contents);

struct BspTexture {
    std::string_view name;
    const char* type;  // as of bsp_surface_type
};

// The textures of a map. Errors: no map of Quake 3, lumps that do not fit into the file. `bytes` must outlive
// the result.
Result<std::vector<BspTexture>> bsp_textures(std::string_view bytes, const std::string& location);

}  // namespace slipface
