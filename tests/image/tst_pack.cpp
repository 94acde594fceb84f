#include <gtest/gtest.h>

#include "slipface/image/pack.h"

namespace slipface {
namespace {

TEST(Pack, GivesTheBytesBackAtEveryEffort) {
    std::string text;
    for (int i = 0; i < 5000; ++i)
        text += static_cast<char>(i * i % 251);
    for (const std::string& bytes : {std::string(), std::string("a"), text})
        for (const int effort : {pack_fast, pack_usual, pack_smallest, -3, 99})
            EXPECT_EQ(unpack(pack(bytes, effort), bytes.size()), bytes) << effort;
    EXPECT_LE(pack(text, pack_smallest).size(), pack(text, pack_fast).size());
}

TEST(Pack, RefusesDamageAndOtherSizes) {
    const std::string packed = pack(std::string(1000, 'x'));
    EXPECT_FALSE(unpack(packed, 999).has_value());
    EXPECT_FALSE(unpack(packed, 1001).has_value());
    EXPECT_FALSE(unpack(packed, std::size_t{1} << 60).has_value());  // without asking for that memory
    EXPECT_FALSE(unpack(packed.substr(0, packed.size() - 3), 1000).has_value());
    EXPECT_FALSE(unpack("", 1).has_value());
    std::string damaged = packed;
    damaged[damaged.size() - 1] ^= 1;
    EXPECT_FALSE(unpack(damaged, 1000).has_value());
}

}  // namespace
}  // namespace slipface
