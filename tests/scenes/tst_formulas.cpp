// The formulas on the cards of the hacks: in the tick of the demo that shows the hack best their numbers are
// there, belong together, and are those of the formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "slipface/scenes/demo.h"
#include "slipface/sim/formula.h"

namespace slipface::test {
namespace {

struct Numbers {
    std::vector<FormulaNumber> all;

    bool has(std::string_view symbol) const {
        return std::any_of(all.begin(), all.end(), [&](const auto& each) { return each.symbol == symbol; });
    }
    double number(std::string_view symbol) const { return std::strtod(find(symbol)->text.c_str(), nullptr); }
    Vec3 vector(std::string_view symbol) const {
        Vec3 v = Vec3::Zero();
        EXPECT_EQ(std::sscanf(find(symbol)->text.c_str(), "(%lf, %lf, %lf)", &v.x(), &v.y(), &v.z()), 3);
        return v;
    }

  private:
    const FormulaNumber* find(std::string_view symbol) const {
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.symbol == symbol; });
        static const FormulaNumber none{"none", "(nan, nan, nan)"};
        if (found == all.end()) ADD_FAILURE() << "there is no " << symbol;
        return found == all.end() ? &none : &*found;
    }
};

Numbers numbers_of(const DemoInfo& info) {
    const Demo demo = make_demo(info);
    LevelScene level = std::move(LevelScene::build(demo.level, demo.on).value());
    const TickScene scene(level);
    TapeRun run(std::make_shared<const Tape>(demo.tape), demo.on, demo.tape.start.value_or(demo.level.spawn));
    run.advance(scene, TapeRun::max_ticks);
    const auto tick = telling_tick(run, scene, info.hack, demo.off, step_of(demo.off_tape));
    if (!tick || formula_of(info) == nullptr) return {};
    return {formula_numbers(*formula_of(info), *tick, StoryNames(demo.level))};
}

Numbers numbers_of(const char* demo) {
    return numbers_of(*find_demo(demo));
}

// Two digits of each component.
constexpr double rounding = 0.03;

TEST(Formulas, HaveNumbersInEveryDemo) {
    std::size_t touching = 0;
    for (const DemoInfo& info : demo_table()) {
        SCOPED_TRACE(info.name);
        ASSERT_NE(formula_of(info), nullptr);
        const Numbers numbers = numbers_of(info);
        for (const char* symbol : {"V", "N", "V'"})
            EXPECT_TRUE(numbers.has(symbol)) << symbol;
        if (numbers.has("N.V")) {
            ++touching;
            EXPECT_NEAR(numbers.vector("N").norm(), 1.0, rounding);
            EXPECT_NEAR(numbers.number("N.V"), numbers.vector("N").dot(numbers.vector("V")),
                        rounding * (1.0 + numbers.vector("V").norm()));
        }
    }
    // In the others nothing is touched: jumps in the air, dash, glide.
    EXPECT_GT(2 * touching, demo_table().size());
}

TEST(Formulas, AreOfSettingsThatExistAndActOnce) {
    for (const FormulaInfo& info : formula_table()) {
        SCOPED_TRACE(info.hack);
        EXPECT_TRUE(hack_row(info.hack));
        EXPECT_EQ(find_formula(info.hack), &info);
    }
}

TEST(Formulas, SayWhatTheTickDid) {
    const Numbers stood = numbers_of("static-friction");
    EXPECT_GE(stood.number("N.y"), std::cos(stood.number("max_slope") * 3.14159265 / 180.0));
    EXPECT_NEAR(stood.number("N.y"), std::cos(30 * 3.14159265 / 180.0), rounding) << "the ramp of the demo";

    const Numbers pressed = numbers_of("ground-velocity");
    const Vec3 velocity = pressed.vector("V'"), ground = pressed.vector("N");
    const double falls = (velocity.x() * ground.x() + velocity.z() * ground.z()) / ground.y();
    EXPECT_GT(falls, pressed.number("ground_speed"));
    EXPECT_NEAR(velocity.y(), -falls, 0.1);

    const Numbers ahead = numbers_of("straight-ahead");
    const Vec3 before = ahead.vector("V"), after = ahead.vector("V'");
    EXPECT_NEAR(std::atan2(after.x(), after.z()), std::atan2(before.x(), before.z()), 0.2)
        << "the heading stays";
    EXPECT_GT(after.y(), 0.0);

    const Numbers energy = numbers_of("keep-energy");
    EXPECT_NEAR(energy.vector("V'").norm(), energy.vector("V").norm(), rounding);
    EXPECT_GT(energy.number("N.V") / energy.vector("V").norm(), energy.number("keep_energy_limit"));

    const Numbers bounced = numbers_of("bounce");
    EXPECT_NEAR(bounced.number("e"), 0.8, 1e-9);
    EXPECT_NEAR(bounced.vector("V'").dot(bounced.vector("N")), -0.8 * bounced.number("N.V"),
                0.05 * -bounced.number("N.V"));

    // The lecture's first half: a slide takes all of the velocity into the plane and nothing else.
    for (const char* demo : {"one-slide", "two-slides", "three-slides", "remainder", "contact-plane"}) {
        SCOPED_TRACE(demo);
        const Numbers slid = numbers_of(demo);
        const Vec3 v = slid.vector("V"), n = slid.vector("N");
        EXPECT_LT(slid.number("N.V"), 0.0);
        EXPECT_LT((slid.vector("V'") - (v - n * n.dot(v))).norm(), rounding * (1.0 + v.norm()));
    }
    const Numbers scaled = numbers_of("bounce-scalar");
    EXPECT_NEAR(scaled.vector("V'").dot(scaled.vector("N")), -scaled.number("e") * scaled.number("N.V"),
                0.05 * -scaled.number("N.V"));
    EXPECT_GT(numbers_of("epsilon").number("skin"), 0.0);

    const Numbers held = numbers_of("sticky");
    EXPECT_TRUE(held.vector("V'").isZero(0.0));

    const Numbers out = numbers_of("push-out");
    EXPECT_NEAR((out.vector("E") + out.vector("C") - out.vector("E'")).norm(), 0.0, rounding);
    EXPECT_GT(out.vector("C").norm(), 0.01);

    const Numbers wall = numbers_of("wall-jump");
    EXPECT_NEAR(wall.vector("V'").dot(wall.vector("N")), wall.number("wall_jump_away"), rounding);
}

TEST(Formulas, AreSilentWhereTheHackDidNotAct) {
    const Demo demo = make_demo(*find_demo("straight-ahead"));
    LevelScene level = std::move(LevelScene::build(demo.level, demo.off).value());
    const TickScene scene(level);
    TapeRun run(std::make_shared<const Tape>(demo.tape), demo.off,
                demo.tape.start.value_or(demo.level.spawn));
    run.advance(scene, TapeRun::max_ticks);
    EXPECT_FALSE(telling_tick(run, scene, "straight_ahead", demo.off));
    EXPECT_TRUE(formula_numbers(*find_formula("straight_ahead"), run.trace(scene, 20), StoryNames(demo.level))
                    .empty());
}

}  // namespace
}  // namespace slipface::test
