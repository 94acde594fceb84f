#include <dlfcn.h>
#include <glad/gl.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "drawing.h"

namespace slipface {
namespace {

Image courtyard_image(OffscreenContext& context) {
    const test::Courtyard yard = test::make_courtyard();
    LevelRenderer renderer(context.gl());
    renderer.set_mesh(yard.mesh, "");
    renderer.set_surface_types(preset_surface_types());
    renderer.set_face_surfaces(test::courtyard_surfaces(yard));
    Framebuffer framebuffer(context.gl(), 320, 180);
    framebuffer.bind();
    LevelStyle style;
    style.wireframe = true;
    renderer.draw(*named_view("iso", yard.mesh->bounds, 16.0 / 9.0), 320, 180, style);
    return framebuffer.read();
}

// OSMesa where the system has it, which must then work, and else EGL.
TEST(OffscreenContext, GivesModernGl) {
    void* const osmesa = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    const auto context = make_offscreen_context();
    ASSERT_TRUE(context.ok()) << context.error().text();
    EXPECT_EQ((*context)->backend_name(), osmesa ? "OSMesa" : "EGL surfaceless");
    EXPECT_NE((*context)->renderer().find("llvmpipe"), std::string::npos) << (*context)->renderer();
    EXPECT_FALSE((*context)->version().empty());
    EXPECT_TRUE((*context)->warnings().empty());
    EXPECT_EQ(make_offscreen_context(OffscreenBackend::osmesa).ok(), osmesa != nullptr);
}

TEST(OffscreenContext, TwoInSequenceDrawTheSameBytes) {
    Image images[2];
    for (Image& image : images) {
        auto context = make_offscreen_context();
        ASSERT_TRUE(context.ok()) << context.error().text();
        image = courtyard_image(**context);
    }
    EXPECT_EQ(images[0], images[1]);
}

// Objects of one context are invisible in the other, and making the first current again brings it back.
TEST(OffscreenContext, TwoAtOnceTakeTurns) {
    auto first = make_offscreen_context();
    ASSERT_TRUE(first.ok());
    const Image before = courtyard_image(**first);
    auto second = make_offscreen_context();
    ASSERT_TRUE(second.ok());
    EXPECT_EQ(courtyard_image(**second), before);
    ASSERT_TRUE((*first)->make_current());
    EXPECT_EQ(courtyard_image(**first), before);
}

TEST(OffscreenContext, TableNeedsAContext) {
    const auto none = load_gl_table(nullptr);
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().location, "OpenGL");
    const auto deaf = load_gl_table([](const char*) -> GlProc { return nullptr; });
    EXPECT_FALSE(deaf.ok());
}

// EGL and OSMesa share Mesa's dispatch, so EGL has a process of its own: the death test's child.
using EglDeathTest = testing::Test;

TEST(EglDeathTest, DrawsInItsOwnProcess) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        {
            auto context = make_offscreen_context(OffscreenBackend::egl);
            if (!context.ok()) {
                std::fprintf(stderr, "%s\n", context.error().text().c_str());
                std::exit(context.error().message.find("Debian package") != std::string::npos ? 0 : 1);
            }
            const Image image = courtyard_image(**context);
            int brightest = 0;
            for (const std::uint8_t value : image.rgba)
                brightest = std::max<int>(brightest, value == 255 ? 0 : value);
            std::exit((*context)->backend_name() == "EGL surfaceless" && brightest > 120 ? 0 : 2);
        },
        testing::ExitedWithCode(0), "");
}

// Mesa's software renderer crashes with 512-bit vectors; the variable is unset, and the user is informed.
TEST(EglDeathTest, UnsafeVectorWidthIsRefused) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        {
            setenv("LP_NATIVE_VECTOR_WIDTH", "512", 1);
            auto context = make_offscreen_context();
            const bool explained = context.ok() && (*context)->warnings().size() == 1 &&
                                   (*context)->warnings()[0].location == "LP_NATIVE_VECTOR_WIDTH";
            const bool drawn = explained && courtyard_image(**context).width == 320;
            std::exit(drawn && std::getenv("LP_NATIVE_VECTOR_WIDTH") == nullptr ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
}

TEST(EglDeathTest, SafeVectorWidthIsKept) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        {
            setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
            auto context = make_offscreen_context();
            const bool quiet = context.ok() && (*context)->warnings().empty();
            std::exit(quiet && std::getenv("LP_NATIVE_VECTOR_WIDTH") != nullptr ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
}

class FramebufferTest : public test::DrawingTest {};

TEST_F(FramebufferTest, SizesAreKeptOrClamped) {
    struct Case {
        int width, height, expected_width, expected_height;
    };
    for (const Case& c : {Case{1, 1, 1, 1}, Case{17, 9, 17, 9}, Case{0, -5, 1, 1},
                          Case{1000000, 1, max_framebuffer_side, 1}}) {
        Framebuffer framebuffer(gl(), c.width, c.height);
        EXPECT_EQ(framebuffer.width(), c.expected_width);
        EXPECT_EQ(framebuffer.height(), c.expected_height);
        const Image image = framebuffer.read();
        EXPECT_EQ(image.width, c.expected_width);
        EXPECT_EQ(image.rgba.size(), 4 * image.pixel_count());
    }
}

// GL counts rows from the bottom, Image from the top; alpha is 255 whatever was drawn.
TEST_F(FramebufferTest, RowsFromTheTopAndOpaque) {
    Framebuffer framebuffer(gl(), 8, 6);
    framebuffer.bind();
    gl()->ClearColor(1, 0, 0, 0);
    gl()->Clear(GL_COLOR_BUFFER_BIT);
    gl()->Enable(GL_SCISSOR_TEST);
    gl()->Scissor(0, 0, 8, 2);
    gl()->ClearColor(0, 0, 1, 0.5f);
    gl()->Clear(GL_COLOR_BUFFER_BIT);
    gl()->Disable(GL_SCISSOR_TEST);
    const Image image = framebuffer.read();
    for (int y = 0; y < 6; ++y) {
        EXPECT_EQ(image.pixel(3, y)[0], y < 4 ? 255 : 0) << y;
        EXPECT_EQ(image.pixel(3, y)[2], y < 4 ? 0 : 255) << y;
        EXPECT_EQ(image.pixel(3, y)[3], 255);
    }
}

TEST_F(FramebufferTest, HasFourSamples) {
    Framebuffer framebuffer(gl(), 16, 16);
    framebuffer.bind();
    GLint samples = 0;
    gl()->GetIntegerv(GL_SAMPLES, &samples);
    EXPECT_EQ(samples, 4);
    EXPECT_EQ(gl()->CheckFramebufferStatus(GL_FRAMEBUFFER), static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
}

}  // namespace
}  // namespace slipface
