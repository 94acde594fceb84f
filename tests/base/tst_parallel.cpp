#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <vector>

#include "slipface/base/parallel.h"

namespace slipface {
namespace {

TEST(ParallelFor, CoversEveryIndexOnce) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{100'000}}) {
        for (const std::size_t grain :
             {std::size_t{0}, std::size_t{1}, std::size_t{64}, std::size_t{1'000'000}}) {
            if (count == 100'000 && grain <= 1)
                continue;  // a hundred thousand ranges of one prove nothing more
            std::vector<int> visits(count, 0);
            parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
                ASSERT_LT(begin, end);
                for (std::size_t i = begin; i < end; ++i)
                    ++visits[i];
            });
            EXPECT_EQ(visits, std::vector<int>(count, 1)) << count << " in grains of " << grain;
        }
    }
}

TEST(ParallelFor, Nests) {
    std::atomic<int> calls{0};
    parallel_for(64, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            parallel_for(64, 1, [&](std::size_t b, std::size_t e) { calls += static_cast<int>(e - b); });
        }
    });
    EXPECT_EQ(calls, 64 * 64);
}

}  // namespace
}  // namespace slipface
