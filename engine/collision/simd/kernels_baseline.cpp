#include "simd/kernel_table.h"

namespace slipface::detail {

constinit const Kernels baseline_kernels = kernel_table("baseline");

}  // namespace slipface::detail
