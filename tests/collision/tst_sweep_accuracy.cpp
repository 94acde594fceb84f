// The engine's narrow phase against the 113-bit oracle, family by family.
#include <gtest/gtest.h>

#include "families.h"

namespace slipface {
namespace {

class SweepAccuracy : public testing::TestWithParam<families::Family> {};

TEST_P(SweepAccuracy, StaysWithinItsBounds) {
    const families::Worst worst = families::run(GetParam(), 1000, 2);
    // A family that hardly ever touches, or always does, would test nothing.
    EXPECT_GT(worst.hits, worst.queries / 4);
    EXPECT_LT(worst.missed_depth, 1e-9);
    EXPECT_LT(worst.false_gap, 1e-9);
    EXPECT_LT(worst.path_error, 1e-6);
    EXPECT_LT(worst.touch_error, 1e-9);
    EXPECT_LT(worst.normal_error, 1e-5);
    EXPECT_LT(worst.point_error, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Families, SweepAccuracy, testing::ValuesIn(families::all), families::test_name);

// The comparison itself: an answer that is off by what the bounds forbid must be seen.
TEST(SweepAccuracyCheck, SeesWrongAnswers) {
    const families::Case fall{
        {Vec3(-4, 0, -4), Vec3(-4, 0, 4), Vec3(4, 0, 0)}, Vec3::Constant(0.5), {0, 3, 0}, {0, -5, 0}};
    scenes::Soup soup;
    soup.add(fall.triangle[0], fall.triangle[1], fall.triangle[2]);
    const auto right = sweep_ellipsoid(soup.world(), fall.radii, fall.from, fall.move);
    ASSERT_TRUE(right);
    const auto worst_of = [&](const families::Case& c, const std::optional<Contact>& contact) {
        families::Worst worst;
        families::compare(c, contact, worst);
        return worst;
    };
    EXPECT_LT(worst_of(fall, right).path_error, 1e-14);
    EXPECT_NEAR(worst_of(fall, std::nullopt).missed_depth, 1.0, 1e-12);
    Contact late = *right;
    late.t += 1e-4;
    EXPECT_NEAR(worst_of(fall, late).path_error, 5e-4, 1e-12);
    EXPECT_NEAR(worst_of(fall, late).touch_error, 1e-3, 1e-12);
    Contact turned = *right;
    turned.normal = Vec3(1e-3, 1, 0).normalized();
    EXPECT_NEAR(worst_of(fall, turned).normal_error, 1e-3, 1e-6);
    families::Case high = fall;
    high.from.y() = 9;  // ends 4 above the plane: 7 radii clear
    EXPECT_NEAR(worst_of(high, right).false_gap, 7.0, 1e-12);
}

}  // namespace
}  // namespace slipface
