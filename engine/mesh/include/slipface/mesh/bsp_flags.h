// Quake 3's surface parameters, as map files and shaders have them.
#pragma once

#include <cstdint>
#include <span>

namespace slipface {

// Sources: the public Quake III source, code/game/surfaceflags.h (flags and contents), q3map/shaders.c (their
// names).
struct BspParameter {
    const char* name;
    std::uint32_t surface_flag, contents_flag;  // 0: none
    const char* type;                           // null: known, but no surface type corresponds to it
};

// The first that a material has decides.
std::span<const BspParameter> bsp_parameters();

// The name of the surface type for the flags of a map's texture; null: none in particular.
const char* bsp_surface_type(std::uint32_t surface_flags, std::uint32_t contents);

}  // namespace slipface
