// The instruction set that collision queries use. All give the same bits. The default is the widest that the
// processor supports; the environment variable SLIPFACE_SIMD (baseline, avx2 or avx512) selects another.
#pragma once

#include <string_view>
#include <vector>

namespace slipface {

// The names of those that this build and processor support, narrowest first.
std::vector<std::string_view> simd_paths();
// The one in use.
std::string_view simd_path();
// Selects one. Returns false and changes nothing if it is not available. Must not run during queries.
bool set_simd_path(std::string_view name);

}  // namespace slipface
