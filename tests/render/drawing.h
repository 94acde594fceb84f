// One off-screen context for all cases of a test suite, and shorthand for drawing and looking at pixels.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "slipface/image/compare.h"
#include "slipface/render/level_renderer.h"
#include "slipface/render/overlay.h"
#include "test_scene.h"

namespace slipface::test {

class DrawingTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        auto context = make_offscreen_context();
        ASSERT_TRUE(context.ok()) << context.error().text();
        context_ = std::move(*context);
    }
    static void TearDownTestSuite() { context_.reset(); }

    static const GlTable& gl() { return context_->gl(); }

    static Image draw(LevelRenderer& renderer, const Camera& camera, int width, int height,
                      const LevelStyle& style, const Overlay* overlay = nullptr) {
        Framebuffer framebuffer(gl(), width, height);
        framebuffer.bind();
        renderer.draw(camera, width, height, style);
        if (overlay != nullptr) {
            OverlayRenderer overlay_renderer(gl());
            EXPECT_TRUE(overlay_renderer.status().ok());
            overlay_renderer.draw(*overlay, camera, width, height);
        }
        return framebuffer.read();
    }

    static std::unique_ptr<OffscreenContext> context_;
};

inline std::unique_ptr<OffscreenContext> DrawingTest::context_;

// Looks straight down on the square from (-half, -half) to (half, half) of the XZ plane.
inline Camera map_camera(double half) {
    Camera camera;
    camera.orthographic = true;
    camera.eye = {0, 50, 0};
    camera.target = Vec3::Zero();
    camera.ortho_height = 2.0 * half;
    camera.near_plane = 1.0;
    camera.far_plane = 100.0;
    return camera;
}

inline int delta(const Image& a, const Image& b, int x, int y) {
    int largest = 0;
    for (int channel = 0; channel < 4; ++channel) {
        largest = std::max(largest, std::abs(a.pixel(x, y)[channel] - b.pixel(x, y)[channel]));
    }
    return largest;
}

inline std::size_t differing_pixels(const Image& a, const Image& b) {
    std::size_t count = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x)
            count += delta(a, b, x, y) > 0 ? 1U : 0U;
    }
    return count;
}

}  // namespace slipface::test
