// Capsules: what goes in comes out, and what is damaged is refused.
#include <gmock/gmock.h>

#include <random>

#include "slipface/sim/capsule.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;

std::string random_text(std::mt19937& random, std::size_t longest) {
    std::string text(std::uniform_int_distribution<std::size_t>(0, longest)(random), '\0');
    for (char& c : text)
        c = static_cast<char>(std::uniform_int_distribution<int>(0, 255)(random));
    return text;
}

Capsule random_capsule(std::mt19937& random) {
    Capsule capsule{random_text(random, 30), random() % 100000, random_text(random, 3000),
                    random_text(random, 3000)};
    std::erase(capsule.level, '\n');
    if (random() % 2 == 0) capsule.base = std::to_string(random());
    return capsule;
}

TEST(Capsule, ReadsWhatItWrites) {
    std::mt19937 random(1);
    for (int i = 0; i < 100; ++i) {
        const Capsule capsule = random_capsule(random);
        const std::string text = capsule_text(capsule);
        EXPECT_THAT(text, testing::MatchesRegex("capsule=[0-9]+\\.[A-Za-z0-9_-]*"));
        const Result<Capsule> read = parse_capsule("#" + text);
        ASSERT_TRUE(read) << read.error().text();
        EXPECT_EQ(*read, capsule);
    }
}

// A packed text has a checksum, so an altered one is noticed.
TEST(Capsule, RefusesWhatIsAlteredOrCutOff) {
    std::mt19937 random(2);
    for (int i = 0; i < 1000; ++i) {
        const Capsule capsule = random_capsule(random);
        std::string text = capsule_text(capsule);
        const std::size_t at = 8 + random() % (text.size() - 8);
        if (i % 2 == 0)
            text.resize(at);
        else
            text[at] = static_cast<char>(text[at] ^ static_cast<char>(1 + random() % 127));
        const Result<Capsule> read = parse_capsule(text);
        // Bits of the last character that no byte needs may change.
        EXPECT_TRUE(!read || (*read == capsule && at + 1 == text.size())) << i;
    }
}

TEST(Capsule, SaysWhatIsWrong) {
    const auto error = [](std::string_view text) {
        const Result<Capsule> read = parse_capsule(text);
        return read ? std::string() : read.error().text();
    };
    EXPECT_THAT(error("tape"), HasSubstr("expected text that begins with \"capsule=\""));
    EXPECT_THAT(error("capsule=abc"), HasSubstr("expected capsule=SIZE.DATA"));
    EXPECT_THAT(error("capsule=99999999999.AAAA"), HasSubstr("at most 16777216 are read"));
    EXPECT_THAT(error("capsule=10.AA!A"), HasSubstr("none of A-Z"));
    EXPECT_THAT(error("capsule=1000.AAAA"), HasSubstr("cut off or altered"));
}

}  // namespace
}  // namespace slipface::test
