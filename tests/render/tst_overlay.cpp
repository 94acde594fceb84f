#include <glad/gl.h>

#include <cmath>
#include <limits>

#include "drawing.h"
#include "slipface/render/overlay.h"

namespace slipface {
namespace {

using test::delta;

constexpr int image_side = 200;
constexpr Color red{1, 0, 0, 1};
const Camera camera = test::map_camera(5.0);  // 20 pixels a metre; pixel (100, 100) is the origin

// A roof at y = 0 over x > 0.
class OverlayTest : public test::DrawingTest {
  protected:
    OverlayTest() : renderer_(gl()) {
        test::MeshBuilder builder;
        builder.face({{0, 0, 5}, {5, 0, 5}, {5, 0, -5}, {0, 0, -5}});
        renderer_.set_mesh(builder.build(), "");
        bare_ = draw(renderer_, camera, image_side, image_side, {});
    }
    Image with(const Overlay& overlay) {
        return draw(renderer_, camera, image_side, image_side, {}, &overlay);
    }

    // Bounding box of what changed, as pixels: left, right, top, bottom.
    std::array<int, 4> changed(const Image& image) const {
        std::array<int, 4> box{image_side, -1, image_side, -1};
        for (int y = 0; y < image_side; ++y) {
            for (int x = 0; x < image_side; ++x) {
                if (delta(bare_, image, x, y) < 8) continue;
                box = {std::min(box[0], x), std::max(box[1], x), std::min(box[2], y), std::max(box[3], y)};
            }
        }
        return box;
    }

    LevelRenderer renderer_;
    Image bare_;
};

TEST_F(OverlayTest, EmptyChangesNothing) {
    EXPECT_EQ(with({}), bare_);
}

// A line of 4 pixels along X at z = 0, from x = -4 to 4: pixel columns 20 to 180, rows 98 to 101.
TEST_F(OverlayTest, LineHasItsPositionAndWidth) {
    Overlay overlay;
    overlay.line({-4, 1, 0}, {4, 1, 0}, red, 4.0f);
    const Image image = with(overlay);
    for (const int x : {25, 100, 175}) {
        int rows = 0;
        for (int y = 90; y < 110; ++y)
            rows += delta(bare_, image, x, y) > 60 ? 1 : 0;
        EXPECT_EQ(rows, 4) << x;
        EXPECT_EQ(image.pixel(x, 100)[0], 255);
        EXPECT_EQ(image.pixel(x, 100)[1], 0);
    }
    const auto box = changed(image);
    EXPECT_NEAR(box[0], 20 - 2, 1);
    EXPECT_NEAR(box[1], 180 + 1, 1);
}

// Below the roof a line is faint, but there; on top of everything it is not covered.
TEST_F(OverlayTest, HiddenPartsAreFaintUnlessOnTop) {
    for (const bool on_top : {false, true}) {
        Overlay overlay;
        overlay.line({-4, -2, 0}, {4, -2, 0}, red, 4.0f, on_top);
        const Image image = with(overlay);
        EXPECT_EQ(image.pixel(60, 100)[0], 255);
        EXPECT_EQ(image.pixel(60, 100)[1], 0);
        const int change = delta(bare_, image, 140, 100);
        if (on_top) {
            EXPECT_EQ(image.pixel(140, 100)[1], 0);
        } else {
            EXPECT_GT(change, 5);
            EXPECT_LT(change, 50);
        }
    }
}

// A line that lies exactly in a face is in front of it, along its whole length and for a slanted view too.
TEST_F(OverlayTest, LineInAFaceIsSeen) {
    Overlay overlay;
    overlay.line({1, 0, 0}, {4, 0, 0}, red, 2.0f);
    Camera slanted;
    slanted.eye = {2.5, 1.5, 6};
    slanted.target = {2.5, 0, 0};
    const Image image = draw(renderer_, slanted, image_side, image_side, {}, &overlay);
    for (const double x : {1.2, 2.0, 3.0, 3.8}) {
        const Vec3 at = project(slanted, {x, 0, 0}, Vec2(image_side, image_side));
        EXPECT_GT(image.pixel(static_cast<int>(at.x()), static_cast<int>(at.y()))[0], 230) << x;
    }
}

// A line from behind the eye is cut at the near plane: it appears, and only on the side where it goes.
TEST_F(OverlayTest, LineThroughTheEyePlaneIsClipped) {
    Camera ahead;
    ahead.eye = {-3, 1, 5};
    ahead.target = {-3, 1, 0};
    Overlay overlay;
    overlay.line({-2, 1, 50}, {-2, 1, -50}, red, 3.0f, true);
    const Image bare = draw(renderer_, ahead, image_side, image_side, {});
    const Image image = draw(renderer_, ahead, image_side, image_side, {}, &overlay);
    std::size_t left = 0, right = 0;
    for (int y = 0; y < image_side; ++y) {
        for (int x = 0; x < image_side; ++x)
            (x < 98 ? left : right) += delta(bare, image, x, y) > 30 ? 1U : 0U;
    }
    EXPECT_EQ(left, 0U);
    EXPECT_GT(right, 100U);
    Overlay behind;
    behind.line({-2, 1, 50}, {-4, 1, 20}, red, 3.0f, true);
    EXPECT_EQ(draw(renderer_, ahead, image_side, image_side, {}, &behind), bare);
}

// Seen along an axis an ellipsoid of radii 1, 2, 3 is an ellipse of 1 x 3 metres about its centre.
TEST_F(OverlayTest, EllipsoidHasItsExtent) {
    Overlay overlay;
    overlay.ellipsoid({-2, 2, 1}, {1, 2, 3}, {0, 1, 0, 0.4f}, {1, 1, 1, 1});
    const auto box = changed(with(overlay));
    EXPECT_NEAR(box[0], 100 - 60, 2);
    EXPECT_NEAR(box[1], 100 - 20, 2);
    EXPECT_NEAR(box[2], 120 - 60, 2);
    EXPECT_NEAR(box[3], 120 + 60, 2);
}

// With perspective the silhouette is the outline of the filled body: no filled pixel lies outside of it.
TEST_F(OverlayTest, SilhouetteHugsTheBody) {
    Camera near_camera;
    near_camera.eye = {-2, 1.5, 4};
    near_camera.target = {-2.4, 0.5, 0};
    const Vec3 centre(-2.6, 0.6, 1.0), radii(0.4, 0.9, 0.5);
    Overlay body, outline;
    body.ellipsoid(centre, radii, {0, 1, 0, 1}, {0, 0, 0, 0});
    outline.ellipsoid(centre, radii, {0, 0, 0, 0}, red);
    const Image bare = draw(renderer_, near_camera, image_side, image_side, {});
    const Image filled = draw(renderer_, near_camera, image_side, image_side, {}, &body);
    const Image lined = draw(renderer_, near_camera, image_side, image_side, {}, &outline);
    for (int y = 0; y < image_side; ++y) {
        int body_left = image_side, body_right = -1, line_left = image_side, line_right = -1;
        for (int x = 0; x < image_side; ++x) {
            if (delta(bare, filled, x, y) > 60) {
                body_left = std::min(body_left, x);
                body_right = std::max(body_right, x);
            }
            if (delta(bare, lined, x, y) > 60) {
                line_left = std::min(line_left, x);
                line_right = std::max(line_right, x);
            }
        }
        if (body_right - body_left < 20) continue;
        EXPECT_NEAR(body_left, line_left, 2) << y;
        EXPECT_NEAR(body_right, line_right, 2) << y;
    }
}

TEST_F(OverlayTest, DiscAndTriangleCoverTheirPlace) {
    Overlay overlay;
    overlay.disc({-2, 1, 0}, {0, 3, 0}, 1.5, {0, 0, 1, 1}, {0, 0, 0, 0});
    EXPECT_EQ(overlay.triangles.size(), 48U);
    const Image image = with(overlay);
    EXPECT_EQ(image.pixel(60, 100)[2], 255);
    const auto box = changed(image);
    EXPECT_NEAR(box[1] - box[0], 60, 2);
    EXPECT_NEAR(box[3] - box[2], 60, 2);
}

// An arrow is broader near its point than at its tail.
TEST_F(OverlayTest, ArrowHasAHead) {
    Overlay overlay;
    overlay.arrow({-4, 1, 0}, {-1, 1, 0}, red, 2.0f);
    const Image image = with(overlay);
    const auto thickness = [&](int x) {
        int rows = 0;
        for (int y = 80; y < 120; ++y)
            rows += delta(bare_, image, x, y) > 60 ? 1 : 0;
        return rows;
    };
    EXPECT_LE(thickness(30), 3);
    EXPECT_GE(thickness(70), 6);
    EXPECT_EQ(thickness(84), 0);
}

TEST_F(OverlayTest, CrossHasThreeArms) {
    Overlay overlay;
    overlay.cross({1, 2, 3}, 0.5, red);
    ASSERT_EQ(overlay.lines.size(), 3U);
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 arm =
            overlay.lines[static_cast<std::size_t>(axis)].b - overlay.lines[static_cast<std::size_t>(axis)].a;
        EXPECT_DOUBLE_EQ(arm[axis], 0.5);
        EXPECT_DOUBLE_EQ(arm.norm(), 0.5);
    }
}

TEST_F(OverlayTest, NonsenseIsLeftOut) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    Overlay overlay;
    overlay.line({nan, 0, 0}, {1, 0, 0}, red);
    overlay.line({0, 0, 0}, {inf, 0, 0}, red);
    overlay.line({0, 0, 0}, {1, 0, 0}, red, -3.0f);
    overlay.ellipsoid({nan, 0, 0}, {1, 1, 1}, red, red);
    overlay.ellipsoid({0, 0, 0}, {1, 0, 1}, red, red);
    overlay.ellipsoid({0, 0, 0}, {1, -1, 1}, red, red);
    overlay.triangle({nan, 0, 0}, {1, 0, 0}, {0, 0, 1}, red);
    overlay.disc({0, 0, 0}, {0, 0, 0}, 1, red, red);
    overlay.disc({0, 0, 0}, {nan, 0, 0}, 1, red, red);
    EXPECT_EQ(with(overlay), bare_);
    EXPECT_EQ(gl()->GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

// The eye inside an ellipsoid sees its great circles, and nothing breaks.
TEST_F(OverlayTest, EyeInsideAnEllipsoid) {
    Camera inside;
    inside.eye = {-2, 1, 0};
    inside.target = {-2, 1, -1};
    Overlay overlay;
    overlay.ellipsoid(inside.eye, {1, 1, 1}, {0, 1, 0, 0.5f}, red);
    const Image bare = draw(renderer_, inside, image_side, image_side, {});
    const Image image = draw(renderer_, inside, image_side, image_side, {}, &overlay);
    EXPECT_GT(test::differing_pixels(bare, image), 50U);
}

TEST_F(OverlayTest, SameBytesTwice) {
    Overlay overlay;
    for (int i = 0; i < 20; ++i) {
        overlay.ellipsoid({-4.0 + 0.3 * i, 0.5, std::sin(i)}, {0.4, 0.9, 0.4}, {0.2f, 0.5f, 1, 0.3f}, red);
        overlay.arrow({-4.0 + 0.3 * i, 0, 0}, {-3.0 + 0.3 * i, 1, 1}, red, 2.0f, false);
    }
    EXPECT_EQ(with(overlay), with(overlay));
}

}  // namespace
}  // namespace slipface
