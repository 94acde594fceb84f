#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "slipface/mesh/triangulate.h"

namespace slipface {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using Triangle = std::array<std::uint32_t, 3>;
using Polygon = std::vector<Vec3f>;

std::vector<Triangle> cut(const Polygon& polygon) {
    std::vector<Triangle> triangles;
    triangulate_polygon(polygon, triangles);
    return triangles;
}

Polygon floor_polygon(std::initializer_list<std::pair<float, float>> points) {
    Polygon polygon;
    for (const auto& [x, z] : points)
        polygon.emplace_back(x, 0.0F, z);
    return polygon;
}

Vec3 area_vector(const Polygon& polygon, const Triangle& t) {
    const Vec3 a = polygon[t[0]].cast<double>();
    return 0.5 * (polygon[t[1]].cast<double>() - a).cross(polygon[t[2]].cast<double>() - a);
}

Vec3 area_vector(const Polygon& polygon) {
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t i = 2; i < polygon.size(); ++i)
        sum += area_vector(polygon, {0, i - 1, i});
    return sum;
}

// A planar simple polygon is covered exactly when no triangle is turned over and the areas add up.
void expect_covered(const Polygon& polygon) {
    const auto triangles = cut(polygon);
    ASSERT_THAT(triangles, SizeIs(polygon.size() - 2));
    const Vec3 whole = area_vector(polygon);
    const Vec3 normal = whole.normalized();
    double sum = 0.0;
    for (const Triangle& triangle : triangles) {
        const double area = area_vector(polygon, triangle).dot(normal);
        EXPECT_GE(area, 0.0);
        sum += area;
    }
    EXPECT_NEAR(sum, whole.norm(), 1e-9 * whole.norm());
}

TEST(Triangulate, TooFewCornersGiveNothing) {
    EXPECT_THAT(cut({}), IsEmpty());
    EXPECT_THAT(cut({Vec3f(0, 0, 0)}), IsEmpty());
    EXPECT_THAT(cut({Vec3f(0, 0, 0), Vec3f(1, 0, 0)}), IsEmpty());
}

TEST(Triangulate, ConvexPolygonsBecomeAFan) {
    EXPECT_THAT(cut(floor_polygon({{0, 0}, {0, 1}, {1, 1}})), ElementsAre(Triangle{0, 1, 2}));
    EXPECT_THAT(cut(floor_polygon({{0, 0}, {0, 1}, {1, 1}, {1, 0}})),
                ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
    EXPECT_THAT(cut(floor_polygon({{1, 0}, {1, 1}, {0, 1}, {0, 0}})),
                ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
    EXPECT_THAT(cut(floor_polygon({{0, 0}, {0, 2}, {1, 3}, {2, 2}, {2, 0}})),
                ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}));
}

// An arrowhead: the diagonal 0-2 lies outside, so a fan from corner 0 would cover ground that is not there.
TEST(Triangulate, ConcaveQuadUsesTheInnerDiagonal) {
    const Polygon arrow = floor_polygon({{-1, -1}, {0, 2}, {1, -1}, {0, 0}});
    expect_covered(arrow);
    const auto triangles = cut(arrow);
    for (const Triangle& triangle : triangles) {
        EXPECT_TRUE(std::ranges::count(triangle, 1U) == 1 && std::ranges::count(triangle, 3U) == 1);
    }
}

TEST(Triangulate, ConcaveShapes) {
    expect_covered(floor_polygon({{0, 0}, {0, 3}, {1, 3}, {1, 1}, {3, 1}, {3, 0}}));                  // L
    expect_covered(floor_polygon({{0, 0}, {0, 3}, {1, 3}, {1, 1}, {2, 1}, {2, 3}, {3, 3}, {3, 0}}));  // U
    expect_covered(floor_polygon({{0, 0}, {1, 2}, {2, 0}, {3, 2}, {4, 0}, {4, 3}, {0, 3}}));          // saw
    expect_covered(
        floor_polygon({{0, 0}, {0, 1}, {0, 2}, {1, 2}, {2, 2}, {2, 1}, {2, 0}, {1, 0}}));  // midpoints
    expect_covered(floor_polygon(
        {{0, 0}, {0, 3}, {3, 3}, {3, 0}, {0, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}}));   // hole
    expect_covered(floor_polygon({{0, 0}, {0, 0}, {0, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 0}}));  // repeats
}

TEST(Triangulate, BothWindingsInAllPlanes) {
    const float shape[6][2] = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool reversed : {false, true}) {
            Polygon polygon;
            for (const auto& p : shape) {
                Vec3f corner = Vec3f::Constant(7.0F);
                corner[(axis + 1) % 3] = p[0];
                corner[(axis + 2) % 3] = p[1];
                polygon.push_back(corner);
            }
            if (reversed) std::ranges::reverse(polygon);
            expect_covered(polygon);
        }
    }
}

// Stars have every other corner reflex; in a tilted plane, of random radii, with 4 to 200 corners.
TEST(Triangulate, RandomStarsAreCovered) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> radius(0.2, 5.0);
    const Vec3 u = Vec3(1, 2, -0.5).normalized();
    const Vec3 v = u.unitOrthogonal();
    for (int round = 0; round < 300; ++round) {
        const int count = 4 + static_cast<int>(random() % 197);
        Polygon polygon;
        for (int i = 0; i < count; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / count;
            polygon.push_back((radius(random) * (std::cos(angle) * u + std::sin(angle) * v)).cast<float>());
        }
        const auto triangles = cut(polygon);
        ASSERT_THAT(triangles, SizeIs(polygon.size() - 2));
        const Vec3 whole = area_vector(polygon);
        double sum = 0.0;
        // Rounded to float the corners leave their plane by up to 1e-6 m, which may turn a sliver over.
        for (const Triangle& triangle : triangles)
            sum += std::abs(area_vector(polygon, triangle).dot(whole.normalized()));
        EXPECT_NEAR(sum, whole.norm(), 1e-5 * whole.norm()) << count;
    }
}

// Ten thousand kilometres away the same shape, on coordinates that floats hold exactly, is cut in the same
// way.
TEST(Triangulate, TranslationDoesNotMatter) {
    const Polygon here = floor_polygon({{0, 0}, {0, 30}, {10, 30}, {12, 10}, {30, 10}, {30, 0}, {15, 5}});
    Polygon there = here;
    for (Vec3f& corner : there)
        corner += Vec3f(8388608.0F, 4194304.0F, -8388608.0F);
    EXPECT_EQ(cut(here), cut(there));
    EXPECT_EQ(there[0] - Vec3f(8388608.0F, 4194304.0F, -8388608.0F), here[0]);
}

TEST(Triangulate, WhatIsNotSimpleIsCutAllTheSame) {
    const Polygon shapes[] = {
        floor_polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}}),                          // bow tie, no area
        floor_polygon({{0, 0}, {3, 3}, {3, 0}, {0, 1}}),                          // bow tie, some area
        floor_polygon({{0, 0}, {1, 0}, {2, 0}, {3, 0}}),                          // on a line
        floor_polygon({{5, 5}, {5, 5}, {5, 5}, {5, 5}, {5, 5}}),                  // a point
        floor_polygon({{0, 0}, {0, 4}, {2, 1}, {-2, 1}, {0, 5}, {4, 4}}),         // crosses itself
        floor_polygon({{0, 0}, {0, 2}, {2, 2}, {2, 0}, {0, 0}, {0, 2}, {2, 2}}),  // round more than once
        {Vec3f(0, 0, 0), Vec3f(1, 5, 0), Vec3f(1, 0, 1), Vec3f(0, 5, 1)},         // bent
        {Vec3f(0, 0, 0), Vec3f(1e-38F, 0, 0), Vec3f(1e-38F, 0, 1e-38F), Vec3f(0, 0, 1e-38F)},
    };
    for (const Polygon& polygon : shapes) {
        const auto triangles = cut(polygon);
        ASSERT_THAT(triangles, SizeIs(polygon.size() - 2));
        for (const Triangle& t : triangles) {
            EXPECT_TRUE(t[0] < polygon.size() && t[1] < polygon.size() && t[2] < polygon.size());
            EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
        }
    }
}

TEST(Triangulate, RandomCornersNeverFail) {
    std::mt19937 random(6);
    for (int round = 0; round < 500; ++round) {
        Polygon polygon(3 + random() % 60);
        // Few values: many repeated corners, spikes and crossings.
        for (Vec3f& p : polygon)
            p = Vec3f(static_cast<float>(random() % 5), static_cast<float>(random() % 2),
                      static_cast<float>(random() % 5));
        const auto triangles = cut(polygon);
        ASSERT_THAT(triangles, SizeIs(polygon.size() - 2));
        std::vector<int> used(polygon.size(), 0);
        for (const Triangle& t : triangles) {
            for (const std::uint32_t corner : t)
                used[corner] = 1;
        }
        EXPECT_THAT(used, testing::Each(1)) << "every corner belongs to a triangle";
    }
}

// A comb has the most ears that other corners block: the limit must still take a moment only, and beyond it
// be a fan.
TEST(Triangulate, TheLargestClippedPolygonTakesAMoment) {
    Polygon comb;
    const auto teeth = static_cast<int>(max_clipped_corners / 2 - 1);
    for (int i = 0; i < teeth; ++i) {
        comb.emplace_back(static_cast<float>(i), 0.0F, 1.0F);
        comb.emplace_back(static_cast<float>(i) + 0.5F, 0.0F, 100.0F);
    }
    comb.emplace_back(static_cast<float>(teeth), 0.0F, 0.0F);
    comb.emplace_back(0.0F, 0.0F, 0.0F);
    const auto start = std::chrono::steady_clock::now();
    expect_covered(comb);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5.0);

    comb.resize(max_clipped_corners + 1, Vec3f(-1, 0, 0));
    EXPECT_EQ(cut(comb)[1], (Triangle{0, 2, 3}));
}

}  // namespace
}  // namespace slipface
