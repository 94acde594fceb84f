// All kernels of one instruction set; included by the file that is compiled for it.
#pragma once

#include "queries/near_impl.h"
#include "queries/ray_triangle_impl.h"
#include "queries/sphere_triangle_impl.h"
#include "queries/wave_impl.h"
#include "simd/kernels_impl.h"

namespace slipface::detail {
namespace {

constexpr Kernels kernel_table(const char* name, std::size_t wave_worth) {
    return {.name = name,
            .wave_worth = wave_worth,
            .prepare_sweep = prepare_sweep_kernel,
            .sweep = sweep_kernel,
            .wave = wave_kernel,
            .ray = ray_kernel,
            .closest = closest_kernel,
            .near = near_kernel,
            .near_sweep = near_sweep_kernel,
            .near_rest = near_rest_kernel,
            .near_highest = near_highest_kernel,
            .near_ray = near_ray_kernel,
            .sweep_triangle = sweep_triangle_kernel,
            .nearest_part = nearest_part_kernel,
            .is_behind = is_behind_kernel,
            .passes_one_sided = passes_one_sided_kernel,
            .touch_of_hit = touch_of_hit_kernel,
            .touch_of_nearest = touch_of_nearest_kernel,
            .ray_triangle = ray_triangle_kernel};
}

}  // namespace
}  // namespace slipface::detail
