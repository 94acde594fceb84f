// Two oracles that share no formula agree, and the engine's answers are those of a sphere that is larger or
// smaller by rounding.
#include <gtest/gtest.h>

#include "exact_answer.h"
#include "families.h"

namespace slipface {
namespace {

using families::Case;
using oracle::ClosedForm;
using oracle::is_answer;
using oracle::Quad;

ClosedForm closed_form(const Case& c) {
    return {c.triangle, c.radii, c.from, c.move};
}

// What the distances of the oracles may differ by. Coefficients and distances are sums of fewer than eight
// products of coordinates, each off by a few roundings of 2^-113, and the normal of a plane by as much more
// as the triangle is sharp.
double quad_rounding(const ClosedForm& closed) {
    return 8 * 0x1p-113 * closed.reach() * closed.reach() * closed.sharpness();
}

class Oracles : public testing::TestWithParam<families::Family> {};

TEST_P(Oracles, Agree) {
    scenes::Random random(3);
    int apart = 0;
    int touches = 0;
    for (int i = 0; i < 400; ++i) {
        const Case c = GetParam().make(random);
        const oracle::Sweep search(c.triangle, c.radii, c.from, c.move);
        const ClosedForm closed = closed_form(c);
        const double rounding = quad_rounding(closed);
        // The distance: along a needle's plane the nearest point itself is known less well, and matters less.
        for (const Quad t : {Quad(0), Quad(random.uniform(0, 1))}) {
            const Quad difference = oracle::length(search.gap(t)) - oracle::length(closed.gap(t));
            ASSERT_LE(std::abs(static_cast<double>(difference)), rounding) << i;
        }
        if (search.clearance(0) <= 0) continue;
        ++apart;
        const Quad lowest = search.nearest_time();
        const double clearance = search.clearance(lowest);
        const Quad t = closed.first_touch();
        // Nearer to a graze than this, either answer is right; no case is.
        ASSERT_GT(std::abs(clearance), rounding) << i;
        ASSERT_EQ(clearance < 0, t <= 1) << i;
        if (clearance >= 0) continue;
        ++touches;
        const Quad found = search.first_touch(lowest);
        const auto error = static_cast<double>(found > t ? found - t : t - found);
        // The last bracket of the search, and the time in which the distance changes by its rounding.
        ASSERT_LE(error, 0x1p-90 - rounding / static_cast<double>(search.slope(found))) << i;
        ASSERT_LE(error, 1e-25) << i;
    }
    // A family that hardly ever touches would test nothing; short moves do so least.
    EXPECT_GE(touches, apart / 40);
}

TEST_P(Oracles, EngineAnswersWithinRounding) {
    scenes::Random random(4);
    int hits = 0;
    int corners = 0;  // that answer for a place beside them
    for (int i = 0; i < 2000; ++i) {
        const Case c = GetParam().make(random);
        const ClosedForm closed = closed_form(c);
        const double rounding = oracle::engine_rounding(closed.reach());
        scenes::Soup soup;
        soup.add(c.triangle[0], c.triangle[1], c.triangle[2]);
        const auto contact = sweep_ellipsoid(soup.world(), c.radii, c.from, c.move);
        hits += contact.has_value();
        const oracle::QuadVec away = closed.gap(0);
        const auto distance = static_cast<double>(oracle::length(away));
        if (distance > 1 + rounding) {
            ASSERT_TRUE(is_answer(closed, contact, rounding)) << i;
            if (!contact) continue;
            const double error = oracle::normal_error(closed, c.radii, contact->normal, contact->t);
            if (error <= rounding) continue;
            // A place e beside a corner is nearer than the corner by e^2 / 2 only: below rounding the
            // corner may answer.
            ++corners;
            ASSERT_EQ(contact->feature, Feature::vertex) << i;
            ASSERT_LE(error, std::sqrt(4 * rounding)) << i;
        } else {
            // No start is so near to a touch that it could count as either.
            ASSERT_LT(distance, 1 - rounding) << i;
            // Along the triangle, as in its plane, rounding says whether the move leads in.
            const auto outward = static_cast<double>(dot(away, closed.move()) / length(closed.move()));
            if (std::abs(outward) > rounding) {
                ASSERT_EQ(contact.has_value(), outward < 0) << i;
            }
            if (!contact) continue;
            ASSERT_EQ(contact->t, 0) << i;
            // A centre within rounding of the triangle has no direction from it.
            if (distance > 1e-9) {
                ASSERT_LE(oracle::normal_error(closed, c.radii, contact->normal, 0) * distance, rounding)
                    << i;
            }
        }
    }
    EXPECT_GT(hits, 500);
    EXPECT_LE(corners, 1);
}

INSTANTIATE_TEST_SUITE_P(Families, Oracles, testing::ValuesIn(families::all), families::test_name);

const oracle::Triangle corner{Vec3(0, 0, 0), Vec3(0, 0, 4), Vec3(4, 0, 0)};

// Each feature where a line of geometry says so.
TEST(ClosedFormOracle, KnowsEachFeature) {
    const auto time = [](const Vec3& from, const Vec3& move) {
        return static_cast<double>(closed_form({corner, Vec3::Constant(0.5), from, move}).first_touch());
    };
    EXPECT_EQ(time({1, 3, 1}, {0, -5, 0}), 0.5);  // plane: 2.5 of 5
    EXPECT_EQ(time({1, -3, 1}, {0, 5, 0}), 0.5);  // from below
    // The edge on the z axis from 0.3 above and 2 before: at x = -0.4.
    EXPECT_NEAR(time({-2, 0.3, 1.5}, {4, 0, 0}), 0.4, 1e-15);
    EXPECT_EQ(time({-2.5, 0, 0}, {4, 0, 0}), 0.5);            // head-on to a corner: 2 of 4
    EXPECT_EQ(time({-2.5, 0, -0.625}, {4, 0, 0}), HUGE_VAL);  // beside it
    EXPECT_EQ(time({1, 3, 1}, {0, 5, 0}), HUGE_VAL);          // away
    EXPECT_EQ(time({1, 3, 1}, {0, -1, 0}), 2.5);              // after the move's end
}

// An answer off by more than the margin is seen, in a blow and in a graze.
TEST(ClosedFormOracle, SeesWrongAnswers) {
    const ClosedForm fall = closed_form({corner, Vec3::Constant(0.5), {1, 3, 1}, {0, -5, 0}});
    Contact contact;
    contact.t = 0.5;
    EXPECT_TRUE(is_answer(fall, contact, 1e-14));
    EXPECT_FALSE(is_answer(fall, std::nullopt, 1e-14));
    for (const double late : {-1e-14, 1e-14}) {  // 5e-14 m, 1e-13 radii
        contact.t = 0.5 + late;
        EXPECT_FALSE(is_answer(fall, contact, 1e-14));
        EXPECT_TRUE(is_answer(fall, contact, 2e-13));
    }
    // A hair's breadth of 2^-40 radii below the edge's reach: missed only within that margin.
    const ClosedForm graze = closed_form({corner, Vec3::Constant(0.5), {-0.5 + 0x1p-41, 3, 1.5}, {0, -6, 0}});
    EXPECT_FALSE(is_answer(graze, std::nullopt, 0x1p-41));
    EXPECT_TRUE(is_answer(graze, std::nullopt, 0x1p-39));
    // The same for an answer that reports a touch where nothing is touched.
    const ClosedForm beside =
        closed_form({corner, Vec3::Constant(0.5), {-0.5 - 0x1p-41, 3, 1.5}, {0, -6, 0}});
    contact.t = 0.5;
    EXPECT_TRUE(is_answer(beside, std::nullopt, 0x1p-41));
    EXPECT_FALSE(is_answer(beside, contact, 0x1p-41));
    EXPECT_TRUE(is_answer(beside, contact, 0x1p-39));
}

}  // namespace
}  // namespace slipface
