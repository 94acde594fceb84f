#include <gtest/gtest.h>

#include <random>

#include "slipface/base/bytes.h"

namespace slipface {
namespace {

TEST(Bytes, ReadWhatWasWrittenAndNothingOfWhatIsCutOff) {
    std::mt19937 random(20);
    for (int round = 0; round < 200; ++round) {
        const std::uint64_t number = random();
        const std::string text(random() % 20, 'x');
        const std::vector<float> list(random() % 20, 0.5f);
        ByteWriter<std::uint32_t> to;
        to.put(number);
        to.put_text(text);
        to.put_list(list);
        ByteReader<std::uint32_t> from(to.bytes);
        EXPECT_EQ(from.get<std::uint64_t>(), number);
        EXPECT_EQ(from.get_text(), text);
        EXPECT_EQ(from.get_list<float>(), list);
        EXPECT_TRUE(from.ok && from.at_end());
        EXPECT_EQ(from.at(), to.bytes.size());

        ByteReader<std::uint32_t> cut(std::string_view(to.bytes).substr(0, random() % to.bytes.size()));
        cut.get<std::uint64_t>();
        cut.get_text();
        EXPECT_TRUE(cut.get_list<float>().empty());
        EXPECT_FALSE(cut.ok);
        EXPECT_EQ(cut.get<std::uint64_t>(), 0u);
    }
}

TEST(Bytes, ACountThatNoBytesFollowAllocatesNothing) {
    ByteWriter<std::uint64_t> to;
    to.put(~std::uint64_t{0});
    ByteReader<std::uint64_t> from(to.bytes);
    EXPECT_TRUE(from.get_list<double>().empty());
    EXPECT_FALSE(from.ok);
}

}  // namespace
}  // namespace slipface
