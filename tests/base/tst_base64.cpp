#include <gtest/gtest.h>

#include <random>

#include "slipface/base/base64.h"

namespace slipface {
namespace {

// The examples of RFC 4648, section 10.
TEST(Base64, HasTheStandardsText) {
    EXPECT_EQ(to_base64("", Base64::padded), "");
    EXPECT_EQ(to_base64("f", Base64::padded), "Zg==");
    EXPECT_EQ(to_base64("fo", Base64::padded), "Zm8=");
    EXPECT_EQ(to_base64("foobar", Base64::padded), "Zm9vYmFy");
    EXPECT_EQ(to_base64("fo", Base64::plain), "Zm8");
    EXPECT_EQ(to_base64("\xfb\xff\xfe", Base64::plain), "+//+");
    EXPECT_EQ(to_base64("\xfb\xff\xfe", Base64::address), "-__-");
}

TEST(Base64, ComesBack) {
    std::mt19937 draw(3);
    for (std::size_t length = 0; length < 200; ++length) {
        std::string bytes(length, '\0');
        for (char& byte : bytes)
            byte = static_cast<char>(draw());
        for (const Base64 form : {Base64::plain, Base64::address})
            EXPECT_EQ(from_base64(to_base64(bytes, form), form), bytes);
    }
}

TEST(Base64, OtherCharactersAreRefused) {
    for (const char* text : {"Zg==", "Zm 8", "Zm\xc3", "Zm-_"})
        EXPECT_EQ(from_base64(text, Base64::plain), std::nullopt) << text;
    EXPECT_EQ(from_base64("Zm+/", Base64::address), std::nullopt);
}

}  // namespace
}  // namespace slipface
