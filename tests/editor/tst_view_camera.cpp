#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/view/view_camera.h"

namespace slipface {
namespace {

const Vec2 viewport(1280, 720);

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-9) {
    EXPECT_LT((a - b).norm(), tolerance) << a.transpose() << " against " << b.transpose();
}

Vec2 pixel_of(const ViewCamera& view, const Vec3& point) {
    return project(view.camera(), point, viewport).head<2>();
}

TEST(ViewCamera, OrbitKeepsPivotAndDistance) {
    ViewCamera view;
    const Vec3 pivot = view.pivot;
    view.orbit({300, -120});
    expect_near(view.pivot, pivot);
    EXPECT_NEAR((view.camera().eye - pivot).norm(), view.distance, 1e-9);
}

TEST(ViewCamera, OrbitTurnsTheLevelWithTheMouse) {
    ViewCamera view;
    view.yaw = view.pitch = 0;                       // the eye on +Z
    const Vec3 before = view.pivot + Vec3(0, 0, 1);  // in front of the pivot
    const double x = pixel_of(view, before).x();
    view.orbit({10, 0});
    EXPECT_GT(pixel_of(view, before).x(), x);
    view.orbit({0, 1e9});
    EXPECT_LT(view.pitch, 1.5708);  // never over the top
    view.orbit({0, -1e9});
    EXPECT_GT(view.pitch, -1.5708);
}

TEST(ViewCamera, LookKeepsTheEye) {
    ViewCamera view;
    const Vec3 eye = view.camera().eye;
    for (int i = 0; i < 100; ++i)
        view.look({17, 5.0 * (i % 3 - 1)});
    expect_near(view.camera().eye, eye, 1e-6);
}

TEST(ViewCamera, LookRightTurnsRight) {
    ViewCamera view;
    view.yaw = view.pitch = 0;  // looking along -Z
    view.look({100, 0});
    EXPECT_GT((view.pivot - view.camera().eye).x(), 0.0);
    view.look({0, 100});
    EXPECT_LT((view.pivot - view.camera().eye).y(), 0.0);
}

TEST(ViewCamera, ThePivotFollowsAPan) {
    for (const double pitch : {-1.2, 0.0, 0.5, 1.5}) {
        ViewCamera view;
        view.pitch = pitch;
        const Vec3 grabbed = view.pivot;
        view.pan({37, -21}, viewport);
        const Vec2 moved = pixel_of(view, grabbed) - 0.5 * viewport;
        EXPECT_NEAR(moved.x(), 37, 1e-6);
        EXPECT_NEAR(moved.y(), -21, 1e-6);
    }
}

TEST(ViewCamera, ZoomNeverPassesThePivot) {
    ViewCamera view;
    const Vec3 back = view.camera().eye - view.pivot;
    for (int i = 0; i < 1000; ++i) {
        view.zoom(3);
        ASSERT_GT(view.distance, 0.0);
        ASSERT_GT((view.camera().eye - view.pivot).dot(back), 0.0);
    }
    view.zoom(-1e6);
    EXPECT_TRUE(std::isfinite(view.distance));
    EXPECT_TRUE(view.camera().eye.allFinite());
}

TEST(ViewCamera, ZoomTowardsKeepsThePointUnderTheMouse) {
    ViewCamera view;
    const Vec3 point(2, 0.5, -3);
    const Vec2 before = pixel_of(view, point);
    const double distance = (view.camera().eye - point).norm();
    for (int i = 0; i < 8; ++i)
        view.zoom_towards(1, point);
    EXPECT_LT((pixel_of(view, point) - before).norm(), 1e-6);
    EXPECT_LT((view.camera().eye - point).norm(), 0.5 * distance);
    for (int i = 0; i < 8; ++i)
        view.zoom_towards(-1, point);
    EXPECT_NEAR((view.camera().eye - point).norm(), distance, 1e-9);
}

TEST(ViewCamera, FliesWhereItLooks) {
    ViewCamera view;
    view.yaw = view.pitch = 0;
    view.fly_speed = 8;
    const Vec3 eye = view.camera().eye;
    view.fly({0, 0, 1}, 0.5);
    expect_near(view.camera().eye, eye + Vec3(0, 0, -4));
    view.fly({1, 0, -1}, 0.5);
    expect_near(view.camera().eye, eye + Vec3(4, 0, 0));
    view.fly({-1, 1, 0}, 0.5);
    expect_near(view.camera().eye, eye + Vec3(0, 4, 0));
}

TEST(ViewCamera, FramedBoundsAreSeenWhole) {
    Aabb bounds;
    bounds.add(Vec3(-40, -1, 3));
    bounds.add(Vec3(60, 12, 9));
    for (const double aspect : {0.5, 1.0, 2.5}) {
        ViewCamera view;
        const double yaw = view.yaw, pitch = view.pitch;
        view.frame(bounds, aspect);
        EXPECT_EQ(view.yaw, yaw);
        EXPECT_EQ(view.pitch, pitch);
        const Vec2 size(600 * aspect, 600);
        double reach = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 point(corner & 1 ? bounds.max.x() : bounds.min.x(),
                             corner & 2 ? bounds.max.y() : bounds.min.y(),
                             corner & 4 ? bounds.max.z() : bounds.min.z());
            const Vec3 seen = project(view.camera(), point, size);
            EXPECT_GT(seen.z(), view.camera().near_plane);
            EXPECT_LT(seen.z(), view.camera().far_plane);
            const Vec2 fraction = (seen.head<2>() - 0.5 * size).cwiseAbs().cwiseQuotient(0.5 * size);
            EXPECT_LE(fraction.maxCoeff(), 1.0 + 1e-9);
            reach = std::max(reach, fraction.maxCoeff());
        }
        EXPECT_GT(reach, 0.8);  // and not from far away
    }
}

TEST(ViewCamera, OddInputChangesNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    ViewCamera view;
    const Camera before = view.camera();
    view.orbit({nan, 0});
    view.look({0, inf});
    view.pan({1, 1}, {0, 0});
    view.pan({nan, 1}, viewport);
    view.zoom(nan);
    view.zoom_towards(1, Vec3(nan, 0, 0));
    view.fly({nan, 0, 0}, 1);
    view.fly({1, 0, 0}, inf);
    view.frame(Aabb{}, 1.6);
    view.frame({Vec3::Zero(), Vec3::Constant(inf)}, 1.6);
    view.frame({Vec3::Zero(), Vec3::Ones()}, nan);
    view.look_at(Vec3::Zero(), Vec3::Zero());
    view.look_at(Vec3(nan, 0, 0), Vec3::Zero());
    expect_near(view.camera().eye, before.eye, 1e-12);
    expect_near(view.camera().target, before.target, 1e-12);
}

TEST(ViewCamera, LooksAt) {
    ViewCamera view;
    view.look_at(Vec3(3, 4, 5), Vec3(-1, 0, 2));
    expect_near(view.camera().eye, Vec3(3, 4, 5));
    expect_near(view.camera().target, Vec3(-1, 0, 2));
    view.look_at(Vec3(0, 10, 0), Vec3::Zero());  // straight down
    expect_near(view.camera().eye, Vec3(0, 10, 0));
    EXPECT_LT(view.camera().target.norm(), 0.2);
}

TEST(ViewCamera, FramingAPointStaysUsable) {
    ViewCamera view;
    Aabb point;
    point.add(Vec3(5, 5, 5));
    view.frame(point, 1.6);
    EXPECT_GT(view.distance, 0.0);
    expect_near(view.pivot, Vec3(5, 5, 5), 0.5);
}

}  // namespace
}  // namespace slipface
