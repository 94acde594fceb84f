#include <gtest/gtest.h>

#include "slipface/base/hash.h"

namespace slipface {
namespace {

TEST(Hasher, ANumberHashesAsItsBytes) {
    for (const std::uint64_t value :
         {std::uint64_t{0}, std::uint64_t{7}, std::uint64_t{0x1200}, std::uint64_t{0xab00cd0000ULL},
          std::uint64_t{0x0100000000000000ULL}, ~std::uint64_t{0}}) {
        Hasher number, bytes;
        number.u64(value);
        for (int i = 0; i < 8; ++i) {
            const auto byte = static_cast<unsigned char>(value >> (8 * i));
            bytes.bytes(&byte, 1);
        }
        EXPECT_EQ(number.value(), bytes.value()) << value;
    }
}

// Published FNV-1a test vectors, 64 bit.
TEST(Hasher, MatchesTheReferenceVectors) {
    EXPECT_EQ(Hasher{}.value(), 0xcbf29ce484222325ULL);
    Hasher a;
    a.text("a");
    EXPECT_EQ(a.value(), 0xaf63dc4c8601ec8cULL);
    Hasher foobar;
    foobar.text("foobar");
    EXPECT_EQ(foobar.value(), 0x85944171f73967e8ULL);
}

TEST(Hasher, ZeroAndMinusZeroAreOneNumber) {
    Hasher plus;
    Hasher minus;
    Hasher other;
    plus.f64(0.0);
    minus.f64(-0.0);
    other.f64(5e-324);
    EXPECT_EQ(plus.value(), minus.value());
    EXPECT_NE(plus.value(), other.value());
}

}  // namespace
}  // namespace slipface
