#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "slipface/base/key_sort.h"

namespace slipface {
namespace {

// `spread`: keys are multiples of it up to 2^64, so that 2^63 leaves two and 1 leaves hashes.
std::vector<KeyedIndex> shuffled(std::size_t count, std::uint64_t spread) {
    std::mt19937_64 random(count);
    std::vector<KeyedIndex> entries(count);
    for (std::size_t i = 0; i < count; ++i)
        entries[i] = {random() / spread * spread, static_cast<std::uint32_t>(i)};
    std::shuffle(entries.begin(), entries.end(), random);
    return entries;
}

TEST(KeySort, SortsAsAComparisonDoes) {
    for (const std::size_t count : {0U, 1U, 2U, 1000U, 16384U, 100000U}) {
        for (const std::uint64_t spread : {1ULL, 1ULL << 40, 1ULL << 58, 1ULL << 63}) {
            std::vector<KeyedIndex> entries = shuffled(count, spread);
            std::vector<KeyedIndex> expected = entries;
            std::sort(expected.begin(), expected.end(), [](const KeyedIndex& a, const KeyedIndex& b) {
                return a.key != b.key ? a.key < b.key : a.index < b.index;
            });
            sort_by_key(entries);
            ASSERT_EQ(entries.size(), expected.size());
            for (std::size_t i = 0; i < count; ++i) {
                ASSERT_EQ(entries[i].key, expected[i].key) << i;
                ASSERT_EQ(entries[i].index, expected[i].index) << i;
            }
        }
    }
}

// All in one heap: the first bits say nothing.
TEST(KeySort, SortsKeysThatShareTheirFirstBits) {
    std::vector<KeyedIndex> entries = shuffled(50000, 1);
    for (KeyedIndex& entry : entries)
        entry.key >>= 20;
    sort_by_key(entries);
    EXPECT_TRUE(std::is_sorted(entries.begin(), entries.end(),
                               [](const KeyedIndex& a, const KeyedIndex& b) { return a.key < b.key; }));
}

}  // namespace
}  // namespace slipface
