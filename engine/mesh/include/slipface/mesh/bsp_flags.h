// The surface parameters of Quake 3, as used in map files and shaders.
#pragma once

#include <cstdint>
#include <span>

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

}  // namespace slipface
