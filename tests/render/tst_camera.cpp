#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "slipface/view/camera.h"

namespace slipface {
namespace {

const Vec2 viewport(800, 600);
constexpr double degree = std::numbers::pi / 180.0;

Camera sample_camera(int index) {
    Camera camera;
    camera.eye = {3.0, 4.0 - index, 7.0};
    camera.target = {-1.0, 0.5, 2.0};
    if (index == 1) camera.orthographic = true;
    if (index == 2) camera.eye = camera.target + Vec3(0, 9, 0);
    if (index == 3) {
        camera.eye = camera.target - Vec3(0, 9, 0);
        camera.orthographic = true;
    }
    return camera;
}

// A point on the ray through a pixel is seen at that pixel, at the depth that the ray's length gives it.
TEST(Camera, ProjectUndoesPixelRay) {
    for (int index = 0; index < 4; ++index) {
        const Camera camera = sample_camera(index);
        for (const Vec2& pixel : {Vec2(0, 0), Vec2(800, 600), Vec2(400, 300), Vec2(12.5, 590.25)}) {
            const Ray ray = pixel_ray(camera, pixel, viewport);
            EXPECT_NEAR(ray.direction.norm(), 1.0, 1e-12);
            const Vec3 seen = project(camera, ray.origin + 5.0 * ray.direction, viewport);
            EXPECT_NEAR(seen.x(), pixel.x(), 1e-9) << index;
            EXPECT_NEAR(seen.y(), pixel.y(), 1e-9) << index;
            EXPECT_GT(seen.z(), 0.0);
        }
    }
}

// project() is what the GPU does with the two matrices: clip space divided by w, y turned down.
TEST(Camera, ProjectAgreesWithMatrices) {
    for (int index = 0; index < 4; ++index) {
        const Camera camera = sample_camera(index);
        const Vec3 point(-0.5, 0.25, 1.0);
        const Eigen::Vector4d clip =
            clip_from_view(camera, 800.0 / 600.0) * view_from_world(camera) * point.homogeneous();
        const Vec3 seen = project(camera, point, viewport);
        EXPECT_NEAR(seen.x(), 400.0 * (clip.x() / clip.w() + 1.0), 1e-9);
        EXPECT_NEAR(seen.y(), 300.0 * (1.0 - clip.y() / clip.w()), 1e-9);
        EXPECT_LT(std::abs(clip.z() / clip.w()), 1.0);
    }
}

TEST(Camera, DepthRangeMapsToMinusOneAndOne) {
    for (const bool orthographic : {false, true}) {
        Camera camera;
        camera.orthographic = orthographic;
        camera.near_plane = 0.5;
        camera.far_plane = 40.0;
        const Mat4 clip = clip_from_view(camera, 1.0);
        for (const auto& [depth, expected] : {std::pair(0.5, -1.0), std::pair(40.0, 1.0)}) {
            const Eigen::Vector4d p = clip * Eigen::Vector4d(0, 0, -depth, 1);
            EXPECT_NEAR(p.z() / p.w(), expected, 1e-9);
        }
    }
}

TEST(Camera, BehindTheEyeHasNoPositiveDepth) {
    Camera camera;
    camera.eye = {0, 0, 5};
    EXPECT_LT(project(camera, {0, 0, 6}, viewport).z(), 0.0);
}

// Seen from straight above, -Z is up and +X is right, as on a map.
TEST(Camera, TopViewIsAMap) {
    const Aabb box{{-4, 0, -2}, {4, 1, 2}};
    const Camera camera = *named_view("top", box, 800.0 / 600.0);
    const Vec3 middle = project(camera, {0, 0, 0}, viewport);
    EXPECT_LT(project(camera, {0, 0, -1}, viewport).y(), middle.y());
    EXPECT_GT(project(camera, {1, 0, 0}, viewport).x(), middle.x());
}

// All corners are inside the picture, and the nearest of them leaves at most a tenth of half the picture
// empty, so that the framing is neither cut nor loose.
TEST(Camera, FramedBoundsFillThePicture) {
    const Aabb box{{10, -3, 5}, {34, 1, 23}};
    for (const char* name : {"iso", "iso-back", "top", "bottom", "front", "back", "left", "right"}) {
        for (const double aspect : {0.5, 1.0, 16.0 / 9.0}) {
            const Vec2 size(600.0 * aspect, 600.0);
            const Camera camera = *named_view(name, box, aspect);
            double reach = 0.0;
            for (int i = 0; i < 8; ++i) {
                const Vec3 corner((i & 1) != 0 ? box.max.x() : box.min.x(),
                                  (i & 2) != 0 ? box.max.y() : box.min.y(),
                                  (i & 4) != 0 ? box.max.z() : box.min.z());
                const Vec3 seen = project(camera, corner, size);
                EXPECT_GT(seen.z(), camera.near_plane);
                EXPECT_LT(seen.z(), camera.far_plane);
                reach = std::max({reach, std::abs(seen.x() / size.x() - 0.5) * 2.0,
                                  std::abs(seen.y() / size.y() - 0.5) * 2.0});
            }
            EXPECT_LE(reach, 1.0) << name;
            EXPECT_GE(reach, 0.9) << name;
        }
    }
}

TEST(Camera, FramesNothingAndPoints) {
    const Aabb point{Vec3(5, 6, 7), Vec3(5, 6, 7)};
    for (const Aabb& box : {Aabb{}, point}) {
        const Camera camera = frame_bounds(box, 0.3, 0.2, 60 * degree, 1.5);
        EXPECT_TRUE(camera.eye.allFinite());
        EXPECT_GT((camera.eye - camera.target).norm(), 0.1);
        EXPECT_GT(camera.near_plane, 0.0);
    }
    const Camera camera = frame_bounds(point, 0.3, 0.2, 60 * degree, 1.5);
    const Vec3 seen = project(camera, {5, 6, 7}, viewport);
    EXPECT_NEAR(seen.x(), 400, 100);
    EXPECT_NEAR(seen.y(), 300, 100);
}

// Yaw 0 stands at +Z and looks along -Z; a positive pitch stands above.
TEST(Camera, YawAndPitch) {
    const Aabb box{-Vec3::Ones(), Vec3::Ones()};
    const Vec3 ahead = frame_bounds(box, 0.0, 0.0, 60 * degree, 1.0).eye;
    EXPECT_GT(ahead.z(), 1.0);
    EXPECT_NEAR(ahead.x(), 0.0, 1e-9);
    EXPECT_GT(frame_bounds(box, 90 * degree, 0.0, 60 * degree, 1.0).eye.x(), 1.0);
    EXPECT_GT(frame_bounds(box, 0.0, 45 * degree, 60 * degree, 1.0).eye.y(), 1.0);
}

TEST(Camera, UnknownViewHasNoCamera) {
    EXPECT_FALSE(named_view("sideways", {}, 1.0).has_value());
}

// A camera whose eye is its target looks along -Z instead of nowhere.
TEST(Camera, EyeOnTargetStaysFinite) {
    Camera camera;
    camera.eye = camera.target = {1, 2, 3};
    EXPECT_TRUE(view_from_world(camera).allFinite());
    EXPECT_TRUE(pixel_ray(camera, {3, 4}, viewport)
                    .direction.isApprox(pixel_ray(camera, {3, 4}, viewport).direction));
    EXPECT_GT(project(camera, {1, 2, 0}, viewport).z(), 0.0);
}

}  // namespace
}  // namespace slipface
