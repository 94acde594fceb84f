#include "kernels_impl.h"
#include "near_impl.h"
#include "wave_impl.h"

namespace slipface::detail {

const Kernels baseline_kernels{"baseline",     sweep_kernel, wave_kernel,      ray_kernel,
                               closest_kernel, near_kernel,  near_sweep_kernel};

}  // namespace slipface::detail
