// Which instruction set the collision queries run on. All give the same bits; the widest that the processor
// has is taken. The environment variable SLIPFACE_SIMD (baseline, avx2 or avx512) asks for another.
#pragma once

#include <string_view>
#include <vector>

namespace slipface {

// Those that this build and processor have, narrowest first.
std::vector<std::string_view> simd_paths();
std::string_view simd_path();
// False, and no change, if there is no such path here. Not while queries run.
bool set_simd_path(std::string_view name);

}  // namespace slipface
