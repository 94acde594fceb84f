// Calls of slipface.h that must work, and random numbers that JavaScript has, too.
#pragma once

#include <gtest/gtest.h>
#include <slipface.h>

#include <cstdint>

#define OK(call)                                    \
    do {                                            \
        slipface_error error;                       \
        ASSERT_EQ(call, SLIPFACE_OK) << error.text; \
        ASSERT_STREQ(error.text, "");               \
    } while (false)

namespace slipface::calls {

struct Dice {
    std::uint64_t state;
    double between(double low, double high) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        return low + (high - low) * (static_cast<double>(state >> 11) * 0x1.0p-53);
    }
    std::uint32_t below(int count) { return static_cast<std::uint32_t>(between(0, count)); }
};

}  // namespace slipface::calls
