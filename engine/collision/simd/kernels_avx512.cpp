#if defined(__x86_64__)
#include "simd/kernel_table.h"

namespace slipface::detail {

constinit const Kernels avx512_kernels = kernel_table("avx512", 0);

}  // namespace slipface::detail

#endif
