#include "simd/kernel_table.h"

namespace slipface::detail {

constinit const Kernels baseline_kernels = kernel_table("baseline", std::size_t{6} << 20U);

}  // namespace slipface::detail
