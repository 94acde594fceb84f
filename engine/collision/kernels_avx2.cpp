#if defined(__x86_64__)
#include "kernels_impl.h"
#include "near_impl.h"
#include "wave_impl.h"

namespace slipface::detail {

const Kernels avx2_kernels{"avx2",         sweep_kernel, wave_kernel,      ray_kernel,
                           closest_kernel, near_kernel,  near_sweep_kernel};

}  // namespace slipface::detail

#endif
