#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "goldens/drawer.h"
#include "goldens/golden.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

std::string numbers(const std::string& mesa, const std::string& interface = "", const char* widgets = "{}") {
    return fmt::format(
        R"({{"version": 2, "widgets": {}, "renderer": {{"version": "4.5 (Core Profile) {}"{}}}}})", widgets,
        mesa, interface.empty() ? "" : ", \"interface\": \"" + interface + "\"");
}

Image picture(int added = 0) {
    Image image = make_image(128, 96, 0, 0, 0);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int i = 0; i < 3; ++i)
                image.pixel(x, y)[i] =
                    static_cast<std::uint8_t>(60 + x + (i == 2 && x / 7 % 2 ? 50 : 0) + added);
    return image;
}

// As another Mesa draws: textures up to 5 levels otherwise, and a line on the next pixel.
Image drawn_otherwise() {
    Image image = picture(3);
    for (int y = 0; y < image.height; ++y)
        for (int i = 0; i < 3; ++i)
            image.pixel(40, y)[i] = static_cast<std::uint8_t>(image.pixel(40, y)[i] + (y % 2 ? 40 : -40));
    return image;
}

Image with_changed_face() {
    Image image = picture();
    for (int y = 20; y < 40; ++y)
        for (int x = 20; x < 40; ++x)
            image.pixel(x, y)[1] = 220;
    return image;
}

class DrawerTest : public testing::Test {
  protected:
    void SetUp() override {
        root_ = fs::path(testing::TempDir()) /
                fmt::format("slipface_drawer_{}_{}", ::getpid(),
                            testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(root_);
        ASSERT_TRUE(approve_golden(root_, snapshot_, {picture(), numbers("Mesa 22.3.6")}));
    }
    void TearDown() override {
        fs::remove_all(root_);
        fs::remove_all(out_folder());
    }
    // Beside the goldens: what lies among them counts as one.
    fs::path out_folder() const { return fs::path(root_.string() + "_out"); }

    GoldenResult check(const Image& image, const std::string& text) const {
        return check_golden(root_, snapshot_, {image, text}, out_folder());
    }

    Snapshot snapshot_{"scenes/a", scene_tolerance, {}};
    fs::path root_;
};

TEST(Drawer, IsMesaWithoutItsThirdNumberAndTheInterface) {
    EXPECT_EQ(drawn_by(numbers("Mesa 22.3.6")), "Mesa 22.3");
    EXPECT_EQ(drawn_by(numbers("Mesa 25.0.7-2+deb13u1")), "Mesa 25.0");
    EXPECT_EQ(drawn_by(numbers("Mesa 26.1.6-1", "Dear ImGui 1.92.2b, letters 01")),
              "Mesa 26.1, Dear ImGui 1.92.2b, letters 01");
    EXPECT_EQ(drawn_by("{}"), "");
    EXPECT_EQ(drawn_by("no JSON"), "");
    EXPECT_EQ(drawers_folder("Mesa 26.1, Dear ImGui 1.92.2b, letters 01"),
              fs::path("renderers/mesa-26.1-dear-imgui-1.92.2b-letters-01"));
    EXPECT_EQ(drawers_folder("../../etc"), fs::path("renderers/..-..-etc"));
}

TEST_F(DrawerTest, TheGoldensOwnLibrariesAreHeldToEveryPixel) {
    EXPECT_EQ(check(picture(), numbers("Mesa 22.3.7")).state, GoldenState::same);
    EXPECT_EQ(check(drawn_otherwise(), numbers("Mesa 22.3.7")).state, GoldenState::different);
}

TEST_F(DrawerTest, OtherLibrariesMayDrawOtherwiseButShowTheSame) {
    const GoldenResult result = check(drawn_otherwise(), numbers("Mesa 26.1.6"));
    EXPECT_EQ(result.state, GoldenState::same) << result.message;
    EXPECT_EQ(result.matched, "the golden, drawn by Mesa 22.3, coarsely");
    const GoldenResult changed = check(with_changed_face(), numbers("Mesa 26.1.6"));
    EXPECT_EQ(changed.state, GoldenState::different);
    EXPECT_TRUE(changed.matched.empty());
    EXPECT_EQ(check(picture(9), numbers("Mesa 26.1.6")).state, GoldenState::different);
    EXPECT_TRUE(check(picture(), numbers("Mesa 26.1.6")).matched.empty());  // exactly the golden
}

TEST_F(DrawerTest, AWidgetThatIsGoneIsNoMatterOfPixels) {
    const auto with = [](const char* mesa, const char* widgets) { return numbers(mesa, "ImGui", widgets); };
    ASSERT_TRUE(approve_golden(root_, snapshot_,
                               {picture(), with("Mesa 22.3.6", R"({"A": [0,0,9,9], "B": [9,0,9,9]})")},
                               {.force = true}));
    const Image seen = drawn_otherwise();
    EXPECT_EQ(check(seen, with("Mesa 26.1.6", R"({"A": [0,1,9,9], "B": [9,0,8,9]})")).state,
              GoldenState::same);
    EXPECT_EQ(check(seen, with("Mesa 26.1.6", R"({"A": [0,0,9,9]})")).state, GoldenState::different);
    EXPECT_EQ(check(seen, with("Mesa 26.1.6", R"({"A": [0,0,9,9], "B": [9,0,9,9], "C": [0,9,1,1]})")).state,
              GoldenState::different);
}

// After `approve --here` these libraries are held to every pixel, too, and the golden is as it was.
TEST_F(DrawerTest, ImagesForOneDrawer) {
    const std::string here = numbers("Mesa 26.1.6");
    const auto written = approve_golden(root_, snapshot_, {drawn_otherwise(), here}, {.here = true});
    ASSERT_TRUE(written);
    EXPECT_EQ(*written, std::vector<std::string>{"renderers/mesa-26.1/scenes/a.png"});
    const GoldenResult result = check(drawn_otherwise(), here);
    EXPECT_EQ(result.state, GoldenState::same);
    EXPECT_EQ(result.matched, "renderers/mesa-26.1/scenes/a");
    Image dot = drawn_otherwise();
    for (int x = 60; x < 70; ++x)
        dot.pixel(x, 60)[0] ^= 32;
    EXPECT_EQ(check(dot, here).state, GoldenState::different);
    EXPECT_EQ(check(dot, numbers("Mesa 26.2.0")).state,
              GoldenState::same);  // of that only the golden is known
    EXPECT_EQ(check(drawn_otherwise(), numbers("Mesa 22.3.6")).state, GoldenState::different);
    EXPECT_TRUE(orphan_goldens(root_, {"scenes/a"}).empty());
    EXPECT_EQ(orphan_goldens(root_, {}).size(), 2u);
    // Nothing to write: what is there fits.
    EXPECT_TRUE(approve_golden(root_, snapshot_, {drawn_otherwise(), here}, {.here = true})->empty());
    EXPECT_TRUE(
        approve_golden(root_, snapshot_, {picture(), numbers("Mesa 25.0.7")}, {.here = true})->empty());
}

}  // namespace
}  // namespace slipface
