#include <gtest/gtest.h>

#include "slipface/base/hash.h"

namespace slipface {
namespace {

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
