#include <gtest/gtest.h>

#include <random>
#include <string>

#include "slipface/world/screens.h"

namespace slipface {
namespace {

class NoGraphics final : public Graphics {
  public:
    void draw_level(const Level&, double) override {}
    void draw_ellipsoid(const Vec3&, const Vec3&) override {}
};

// Writes down what happens to it, and lives as a number in `alive`.
class Scribe : public Screen {
  public:
    Scribe(std::string name, std::string& log, int& alive, bool shows_below = false)
        : name_(std::move(name)), log_(log), alive_(alive), shows_below_(shows_below) {
        ++alive_;
    }
    ~Scribe() override { --alive_; }
    void on_tick(double) override { log_ += name_ + ".tick "; }
    void on_draw(Graphics&) override { log_ += name_ + ".draw "; }
    void on_show() override { log_ += name_ + ".show "; }
    void on_input(const ScreenInput& input) override {
        log_ += name_ + ".key" + std::to_string(input.key) + " ";
        if (input.key == 1) screens().push(std::make_unique<Scribe>("pause", log_, alive_, true));
        if (input.key == 2) screens().pop();
        if (input.key == 3) screens().replace(std::make_unique<Scribe>("end", log_, alive_));
        log_ += std::to_string(alive_) + " ";  // nothing happened yet to this one
    }
    bool shows_below() const override { return shows_below_; }

  private:
    std::string name_;
    std::string& log_;
    int& alive_;
    bool shows_below_;
};

TEST(Screens, TheTopOneTicksAndAPauseShowsTheGame) {
    std::string log;
    int alive = 0;
    NoGraphics graphics;
    {
        Screens screens;
        screens.push(std::make_unique<Scribe>("title", log, alive));
        screens.push(std::make_unique<Scribe>("play", log, alive));
        screens.tick(0.1);
        screens.draw(graphics);
        EXPECT_EQ(log, "title.show play.show play.tick play.draw ");
        log.clear();
        screens.input({1});
        screens.tick(0.1);
        screens.draw(graphics);
        EXPECT_EQ(log, "play.key1 3 pause.show pause.tick play.draw pause.draw ");
        log.clear();
        screens.input({2});
        EXPECT_EQ(log, "pause.key2 3 play.show ");
        log.clear();
        screens.input({3});
        screens.draw(graphics);
        EXPECT_EQ(log, "play.key3 3 end.show end.draw ");
        EXPECT_EQ(screens.count(), 2U);
        screens.clear();
        screens.pop();
        EXPECT_TRUE(screens.empty());
        screens.tick(0.1);
        screens.draw(graphics);
    }
    EXPECT_EQ(alive, 0);
}

// A stack of numbers must agree with it, whatever is asked for, from outside and from inside.
TEST(Screens, AnyOrderOfChangesKeepsTheStack) {
    std::mt19937 draw(7);
    for (int round = 0; round < 200; ++round) {
        std::string log;
        int alive = 0;
        Screens screens;
        int expected = 0;
        for (int i = 0; i < 40; ++i) {
            const auto what = draw() % 5;
            if (what == 0) screens.push(std::make_unique<Scribe>("s", log, alive)), ++expected;
            if (what == 1) screens.pop(), expected -= expected > 0 ? 1 : 0;
            if (what == 2) screens.input({1}), expected += expected > 0 ? 1 : 0;
            if (what == 3) screens.input({2}), expected -= expected > 0 ? 1 : 0;
            if (what == 4)
                screens.replace(std::make_unique<Scribe>("s", log, alive)), expected += expected == 0 ? 1 : 0;
            ASSERT_EQ(screens.count(), static_cast<std::size_t>(expected));
            ASSERT_EQ(alive, expected);
        }
    }
}

}  // namespace
}  // namespace slipface
