// Filtered queries and queries for all hits, against worlds of one triangle each, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <type_traits>

#include "brute_force.h"
#include "every_simd_path.h"
#include "slipface/collision/filter.h"

namespace slipface {
namespace {

using scenes::Random;
using scenes::same;
using scenes::Soup;

using Filter = EverySimdPath;

struct Case {
    Soup soup;
    std::vector<CollisionWorld> singles;
    std::vector<SurfaceId> types;  // [triangle]
    std::vector<std::uint32_t> groups;
    CollisionWorld world;
};

Case random_case(Random& random) {
    Case made;
    made.soup =
        random.below(2) == 0 ? scenes::random_soup(random, 150, 2.5, 1.5) : scenes::terrain(random, 8, 0.6);
    made.world = made.soup.world();
    made.world.set_surface_rule(3, {.solid = false});
    for (std::size_t i = 0; i < made.soup.triangles.size(); ++i) {
        made.singles.push_back(made.soup.single(i));
        // Triangles of one face have one type.
        const auto type = i > 0 && made.soup.faces[i] == made.soup.faces[i - 1]
                              ? made.types.back()
                              : static_cast<SurfaceId>(random.below(4));
        made.types.push_back(type);
        made.world.set_face_surface(made.soup.faces[i], type);
        made.groups.push_back(std::uint32_t{1} << random.below(3));
    }
    return made;
}

// Of each triangle alone what `query` finds, if `filter` sees it and its type is solid.
template <class Query>
auto alone(const Case& in, const QueryFilter& filter, const Query& query) {
    std::vector<std::remove_cvref_t<decltype(*query(in.singles[0]))>> found;
    for (std::size_t i = 0; i < in.singles.size(); ++i) {
        const auto id = static_cast<TriangleId>(i);
        auto one = in.types[i] == 3 || !filter.sees(id, in.types[i]) ? std::nullopt : query(in.singles[i]);
        if (!one) continue;
        one->triangle = id;
        if constexpr (requires { one->surface; }) one->surface = in.types[i];
        found.push_back(*one);
    }
    return found;
}

template <class T>
std::optional<T> first_of(const std::vector<T>& all) {
    return all.empty() ? std::nullopt : std::optional(all.front());
}

TEST_F(Filter, AnswersAsAWorldOfWhatItSees) {
    Random random(31);
    std::size_t several = 0, pierced_several = 0, hidden = 0;
    for (int round = 0; round < 20; ++round) {
        const Case in = random_case(random);
        for (int i = 0; i < 150; ++i) {
            QueryFilter filter;
            filter.ignored[random.below(4)] = true;
            if (random.below(2) == 0) filter.groups = in.groups;
            filter.mask = static_cast<std::uint32_t>(1 + random.below(7));
            const Vec3 from = Vec3(1, 0, 1) + random.in_box(3);
            const Vec3 direction = random.direction();
            const Vec3 move = random.uniform(0.1, 8) * direction;
            const Vec3 radii(random.uniform(0.1, 0.8), random.uniform(0.1, 0.8), random.uniform(0.1, 0.8));

            auto contacts = alone(in, filter, [&](const CollisionWorld& single) {
                return sweep_ellipsoid(single, radii, from, move);
            });
            std::ranges::stable_sort(contacts, [](const Contact& a, const Contact& b) {
                return a.t != b.t ? a.t < b.t : a.feature < b.feature;
            });
            auto rays = alone(
                in, filter, [&](const CollisionWorld& single) { return cast_ray(single, from, move, 1.0); });
            std::ranges::stable_sort(rays, {}, &RayHit::t);
            auto near = alone(in, filter,
                              [&](const CollisionWorld& single) { return closest_point(single, from, 2.0); });
            std::ranges::stable_sort(near, {}, &ClosestPoint::distance);
            const auto overlaps = alone(in, filter, [&](const CollisionWorld& single) {
                Overlap one;
                return find_overlaps(single, radii, from, {&one, 1}) > 0 ? std::optional(one) : std::nullopt;
            });
            several += contacts.size() > 2;
            pierced_several += rays.size() > 1;
            hidden += first_of(contacts).has_value() &&
                      !same(first_of(contacts), sweep_ellipsoid(in.world, radii, from, move));

            for (const std::string_view path : simd_paths()) {
                SCOPED_TRACE(path);
                ASSERT_TRUE(set_simd_path(path));
                EXPECT_TRUE(same(sweep_ellipsoid(in.world, radii, from, move, filter), first_of(contacts)));
                EXPECT_TRUE(
                    same(cast_ray(in.world, from, move, 1.0, RayStops::solid, filter), first_of(rays)));
                EXPECT_TRUE(same(closest_point(in.world, from, 2.0, filter), first_of(near)));
                std::vector<Overlap> touched(in.soup.triangles.size());
                ASSERT_EQ(find_overlaps(in.world, radii, from, touched, filter), overlaps.size());
                EXPECT_EQ(overlaps_any(in.world, radii, from, filter), !overlaps.empty());
                for (std::size_t k = 0; k < overlaps.size(); ++k)
                    EXPECT_TRUE(same(touched[k], overlaps[k]));

                // All hits, and a list that is too short for them.
                for (const std::size_t room : {in.soup.triangles.size(), std::size_t{2}}) {
                    std::vector<Contact> all(room);
                    ASSERT_EQ(find_sweep_hits(in.world, radii, from, move, all, filter), contacts.size());
                    for (std::size_t k = 0; k < std::min(room, contacts.size()); ++k)
                        EXPECT_TRUE(same(std::optional(all[k]), std::optional(contacts[k]))) << k;
                    std::vector<RayHit> pierced(room);
                    ASSERT_EQ(find_ray_hits(in.world, from, move, 1.0, RayStops::solid, pierced, filter),
                              rays.size());
                    for (std::size_t k = 0; k < std::min(room, rays.size()); ++k)
                        EXPECT_TRUE(same(std::optional(pierced[k]), std::optional(rays[k]))) << k;
                }
            }
        }
    }
    EXPECT_GT(several, 100u);
    EXPECT_GT(pierced_several, 100u);
    EXPECT_GT(hidden, 100u);
}

TEST_F(Filter, NothingIsFoundForBadInput) {
    const CollisionWorld world = scenes::corner_triangle().world();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::array<Contact, 2> contacts;
    std::array<RayHit, 2> hits;
    const Vec3 down(0, -4, 0), above(1, 2, 1), ones = Vec3::Ones();
    EXPECT_EQ(find_sweep_hits(world, ones, above, down, contacts), 1u);
    EXPECT_EQ(find_sweep_hits(world, ones, above, down, {}), 1u);
    EXPECT_EQ(find_sweep_hits(world, Vec3(1, nan, 1), above, down, contacts), 0u);
    EXPECT_EQ(find_sweep_hits(world, ones, above, Vec3::Zero(), contacts), 0u);
    EXPECT_EQ(find_ray_hits(world, above, down, 1.0, RayStops::solid, hits), 1u);
    EXPECT_EQ(find_ray_hits(world, above, down, nan, RayStops::solid, hits), 0u);
    EXPECT_EQ(find_ray_hits(world, above, Vec3::Zero(), 1.0, RayStops::solid, hits), 0u);
    EXPECT_EQ(find_ray_hits(CollisionWorld{}, above, down, 1.0, RayStops::solid, hits), 0u);
}

}  // namespace
}  // namespace slipface
