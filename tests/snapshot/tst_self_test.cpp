#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "../render/test_scene.h"
#include "goldens/golden.h"
#include "slipface/render/level_renderer.h"

namespace slipface {
namespace {

// The courtyard as the goldens show levels.
const Image& courtyard() {
    static const Image image = [] {
        auto context = make_offscreen_context();
        if (!context.ok()) return Image{};
        const test::Courtyard yard = test::make_courtyard();
        LevelRenderer renderer((*context)->gl());
        renderer.set_mesh(yard.mesh, "");
        renderer.set_surface_types(preset_surface_types());
        renderer.set_face_surfaces(test::courtyard_surfaces(yard));
        Framebuffer framebuffer((*context)->gl(), 640, 360);
        framebuffer.bind();
        LevelStyle style;
        style.wireframe = true;
        renderer.draw(*named_view("iso", yard.mesh->bounds, 16.0 / 9.0), 640, 360, style);
        return framebuffer.read();
    }();
    return image;
}

TEST(SelfTest, EveryCaseBehavesForScenesAndScreens) {
    ASSERT_EQ(courtyard().width, 640);
    for (const CompareTolerance& tolerance : {scene_tolerance, ui_tolerance}) {
        int must_pass = 0, must_fail = 0;
        for (const SelfTestCase& test : self_test_cases(courtyard())) {
            const Comparison comparison = compare_images(courtyard(), test.image, tolerance);
            EXPECT_EQ(comparison.same, test.must_pass) << test.name << ": " << comparison.verdict;
            (test.must_pass ? must_pass : must_fail) += 1;
        }
        EXPECT_GE(must_pass, 3);
        EXPECT_GE(must_fail, 6);
        EXPECT_TRUE(run_self_test(courtyard(), tolerance).passed);
    }
}

// The noise is real: without a tolerance it does not pass, and it is as strong as promised.
TEST(SelfTest, NoiseIsNotNothing) {
    const CompareTolerance exact{.pixel_delta = 0,
                                 .ratio = 0.0,
                                 .minimum_pixels = 0,
                                 .strong_delta = 0,
                                 .window = 16,
                                 .window_pixels = 1};
    for (const SelfTestCase& test : self_test_cases(courtyard())) {
        if (!test.must_pass || test.name == "unchanged") continue;
        const Comparison comparison = compare_images(courtyard(), test.image, exact);
        EXPECT_FALSE(comparison.same) << test.name;
        const Comparison gate = compare_images(courtyard(), test.image, scene_tolerance);
        if (test.name.starts_with("edges")) {
            EXPECT_GT(gate.max_delta, 20);
            EXPECT_EQ(gate.densest_window, 1);
            EXPECT_GT(gate.differing, 30U);
        } else {
            EXPECT_EQ(gate.max_delta, 1);
            EXPECT_GT(comparison.differing, 200U);
        }
    }
}

// A gate that forgives everything, or nothing, is found out.
TEST(SelfTest, BrokenGatesAreNoticed) {
    CompareTolerance blind = scene_tolerance;
    blind.pixel_delta = blind.strong_delta = 255;
    EXPECT_FALSE(run_self_test(courtyard(), blind).passed);
    CompareTolerance web = scene_tolerance;  // what web tools forgive
    web.pixel_delta = web.strong_delta = 26;
    EXPECT_FALSE(run_self_test(courtyard(), web).passed);
    CompareTolerance strict = scene_tolerance;
    strict.pixel_delta = strict.minimum_pixels = 0;
    strict.ratio = 0.0;
    EXPECT_FALSE(run_self_test(courtyard(), strict).passed);
}

TEST(SelfTest, SameCasesEveryTime) {
    const auto first = self_test_cases(courtyard()), second = self_test_cases(courtyard());
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i)
        EXPECT_EQ(first[i].image, second[i].image) << first[i].name;
}

TEST(SelfTest, TinyAndFlatPicturesDoNotPass) {
    EXPECT_TRUE(self_test_cases(Image{}).empty());
    EXPECT_FALSE(run_self_test(make_image(15, 40, 1, 2, 3), scene_tolerance).passed);
    EXPECT_FALSE(run_self_test(make_image(64, 64, 120, 120, 120), scene_tolerance).passed);
    EXPECT_FALSE(self_test_cases(make_image(16, 16, 1, 2, 3)).empty());
}

}  // namespace
}  // namespace slipface
