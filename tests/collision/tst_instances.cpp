// Instances of meshes answer as the same triangles without them, bit for bit, on every instruction set.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "brute_force.h"
#include "every_simd_path.h"
#include "instanced.h"
#include "slipface/collision/filter.h"
#include "slipface/collision/neighbourhood.h"

namespace slipface {
namespace {

using scenes::Instanced;
using scenes::Random;
using scenes::same;
using scenes::Soup;

using Instances = EverySimdPath;

Soup quads(Random& random) {
    Soup soup;
    for (int i = 0; i < 20; ++i) {
        const Vec3 at = random.in_box(1), u = random.in_box(1), v = random.in_box(1);
        soup.add_quad(at, at + u, at + u + v, at + v);
    }
    return soup;
}

// How the instances of a round stand: in the open, on a grid that makes their faces meet, far away.
Placement random_placement(Random& random, int kind) {
    if (kind == 1) {
        constexpr double quarter = 1.5707963267948966;
        const auto step = [&] { return static_cast<double>(random.below(5)) - 2.0; };
        const auto turn = [&] { return quarter * static_cast<double>(random.below(4)); };
        const double side = random.below(2) == 0 ? 1.0 : -1.0;
        return placement({step(), step(), step()}, {turn(), turn(), turn()}, {side, 1, 2});
    }
    const Vec3 away = kind == 2 ? Vec3(70000, -30000, 20000) : Vec3(0, 0, 0);
    return placement(away + random.in_box(4), random.in_box(7), scenes::random_scale(random, 5));
}

struct Pair {
    Instanced scene;
    CollisionWorld shared, flat;
    Vec3 middle;
};

Pair random_pair(Random& random, int kind) {
    std::vector<Soup> meshes{scenes::random_soup(random, 40, 0.6, 0.5), quads(random),
                             scenes::terrain(random, 5, 0.5), scenes::random_soup(random, 1, 0.2, 0.5)};
    Soup ground = random.below(3) == 0 ? Soup() : scenes::terrain(random, 6, 1.0);
    Instanced scene(std::move(ground), meshes);
    const std::size_t count = 1 + random.below(40);
    for (std::size_t i = 0; i < count; ++i)
        scene.add(random.below(meshes.size()), random_placement(random, kind));
    Pair pair{std::move(scene), {}, {}, kind == 2 ? Vec3(70000, -30000, 20000) : Vec3(0, 0, 0)};
    pair.shared = pair.scene.world();
    pair.flat = pair.scene.flat().world();
    std::vector<SurfaceId> types(pair.scene.faces());
    for (SurfaceId& type : types)
        type = static_cast<SurfaceId>(random.below(4));
    for (CollisionWorld* world : {&pair.shared, &pair.flat}) {
        world->set_surface_rule(2, {.solid = true, .one_sided = true});
        world->set_surface_rule(3, {.solid = false});
    }
    pair.shared.set_face_surfaces(types);
    for (FaceId face = 0; face < types.size(); ++face)
        pair.flat.set_face_surface(face, types[face]);
    return pair;
}

template <class T>
bool same_list(const std::vector<T>& a, std::size_t na, const std::vector<T>& b, std::size_t nb) {
    if (na != nb) return false;
    for (std::size_t i = 0; i < std::min(na, a.size()); ++i)
        if (!same(std::optional(a[i]), std::optional(b[i]))) return false;
    return true;
}

TEST_F(Instances, AnswerAsTheirTriangles) {
    Random random(71);
    std::size_t hits = 0, pierced = 0, near_hits = 0, overlapped = 0, crowds = 0, everything = 0;
    for (int round = 0; round < 60; ++round) {
        SCOPED_TRACE(round);
        const Pair pair = random_pair(random, round % 3);
        ASSERT_EQ(pair.shared.triangle_count(), pair.flat.triangle_count());
        EXPECT_EQ(pair.shared.bounds().min, pair.flat.bounds().min);
        EXPECT_EQ(pair.shared.bounds().max, pair.flat.bounds().max);
        for (TriangleId t = 0; t < pair.flat.triangle_count(); ++t) {
            ASSERT_EQ(pair.shared.triangle(t), pair.flat.triangle(t)) << t;
            ASSERT_EQ(pair.shared.triangle_face(t), pair.flat.triangle_face(t)) << t;
            ASSERT_EQ(pair.shared.triangle_normal(t), pair.flat.triangle_normal(t)) << t;
        }
        for (int i = 0; i < 60; ++i) {
            const Vec3 from = pair.middle + random.in_box(6);
            const Vec3 move = random.uniform(0.01, 8) * random.direction();
            const Vec3 radii(random.uniform(0.05, 1), random.uniform(0.05, 1.5), random.uniform(0.05, 1));
            QueryFilter filter;
            filter.ignored[random.below(4)] = true;
            for (const std::string_view path : simd_paths()) {
                ASSERT_TRUE(set_simd_path(path));
                SCOPED_TRACE(path);
                const auto contact = sweep_ellipsoid(pair.flat, radii, from, move);
                hits += contact.has_value();
                ASSERT_TRUE(same(sweep_ellipsoid(pair.shared, radii, from, move), contact));
                ASSERT_TRUE(same(sweep_ellipsoid(pair.shared, radii, from, move, filter),
                                 sweep_ellipsoid(pair.flat, radii, from, move, filter)));
                const auto hit = cast_ray(pair.flat, from, move, 3.0, RayStops::as_movement);
                pierced += hit.has_value();
                ASSERT_TRUE(same(cast_ray(pair.shared, from, move, 3.0, RayStops::as_movement), hit));
                const double reach = random.below(2) == 0 ? 100.0 : random.uniform(0, 2);
                ASSERT_TRUE(
                    same(closest_point(pair.shared, from, reach), closest_point(pair.flat, from, reach)));

                std::vector<Overlap> a(8), b(8);
                const std::size_t nb = find_overlaps(pair.flat, radii, from, b);
                overlapped += nb;
                ASSERT_EQ(find_overlaps(pair.shared, radii, from, a), nb);
                for (std::size_t k = 0; k < std::min(nb, b.size()); ++k)
                    ASSERT_TRUE(same(a[k], b[k]));
                ASSERT_EQ(overlaps_any(pair.shared, radii, from), nb > 0);

                std::vector<Contact> ca(6), cb(6);
                ASSERT_TRUE(same_list(ca, find_sweep_hits(pair.shared, radii, from, move, ca, filter), cb,
                                      find_sweep_hits(pair.flat, radii, from, move, cb, filter)));
                std::vector<RayHit> ra(6), rb(6);
                ASSERT_TRUE(
                    same_list(ra, find_ray_hits(pair.shared, from, move, 2.0, RayStops::solid, ra, filter),
                              rb, find_ray_hits(pair.flat, from, move, 2.0, RayStops::solid, rb, filter)));

                const Neighbourhood near(pair.shared, radii, from, Vec3::Constant(0.3));
                const Vec3 little = 0.2 * random.direction();
                near_hits += near.holds(radii, from, little);
                ASSERT_TRUE(same(sweep_ellipsoid(near, radii, from, little),
                                 sweep_ellipsoid(pair.flat, radii, from, little)));
            }
        }
        Aabb box;
        box.add(pair.middle + random.in_box(3));
        box.add(pair.middle + random.in_box(3));
        EXPECT_EQ(pair.shared.triangles_in(box), pair.flat.triangles_in(box));
        const std::size_t all = pair.flat.triangle_count(), crowd = pair.shared.crowd_in(box);
        EXPECT_GE(crowd, find_overlaps(pair.shared, 0.5 * box.size(), box.centre(), {}));
        EXPECT_LE(crowd, all);
        crowds += crowd;
        everything += all;
    }
    const std::size_t paths = simd_paths().size();
    EXPECT_GT(hits, 1000 * paths);
    EXPECT_GT(pierced, 500 * paths);
    EXPECT_GT(near_hits, 300 * paths);
    EXPECT_GT(overlapped, 2000 * paths);
    EXPECT_LT(crowds, everything / 2);
}

TEST(InstancesTogether, SweepInBatches) {
    Random random(72);
    for (int round = 0; round < 12; ++round) {  // with and without a soup
        const Pair pair = random_pair(random, round % 3);
        std::vector<Sweep> sweeps;
        for (int i = 0; i < 400; ++i)
            sweeps.push_back({Vec3(0.4, 0.9, 0.4), pair.middle + random.in_box(6), 5 * random.direction()});
        std::vector<std::optional<Contact>> a(sweeps.size()), b(sweeps.size());
        sweep_ellipsoids(pair.shared, sweeps, a);
        sweep_ellipsoids(pair.flat, sweeps, b);
        for (std::size_t i = 0; i < sweeps.size(); ++i)
            ASSERT_TRUE(same(a[i], b[i])) << i;
    }
}

// Replacing the instances gives the world that is built with them.
TEST(InstancesTogether, CanBeReplaced) {
    Random random(76);
    const std::vector<Soup> soups{scenes::dense(quads(random)),
                                  scenes::dense(scenes::terrain(random, 5, 0.5))};
    std::vector<std::shared_ptr<const CollisionMesh>> meshes;
    for (const Soup& soup : soups)
        meshes.push_back(scenes::shared_mesh(soup));
    const Soup ground = scenes::dense(scenes::terrain(random, 6, 1.0));
    CollisionWorld world = std::move(CollisionWorld::build(ground.view()).value());
    std::vector<Instance> list;
    const auto random_one = [&] {
        Instance one{meshes[random.below(2)], random_placement(random, 0), 0, nullptr};
        auto types = std::make_shared<std::vector<SurfaceId>>(one.mesh->face_count());
        for (SurfaceId& type : *types)
            type = static_cast<SurfaceId>(random.below(4));
        if (random.below(2) == 0) one.surfaces = types;
        return one;
    };
    std::size_t hits = 0;
    for (int round = 0; round < 60; ++round) {
        SCOPED_TRACE(round);
        const auto any = [&] {
            return list.begin() + static_cast<std::ptrdiff_t>(random.below(list.size()));
        };
        for (std::size_t change = 1 + random.below(3); change > 0; --change) {
            const std::size_t kind = list.empty() ? 0 : random.below(5);
            if (kind <= 1) list.insert(list.empty() ? list.end() : any(), random_one());
            if (kind == 2) list.erase(any());
            if (kind == 3) *any() = random_one();
            if (kind == 4) std::swap(*any(), list.front());
        }
        if (round % 20 == 19) list.clear();
        FaceId face = ground.faces.back() + 1;
        for (Instance& one : list) {
            one.first_face = face;
            face += static_cast<FaceId>(one.mesh->face_count());
        }
        ASSERT_TRUE(world.set_instances(list).ok());
        const CollisionWorld fresh = std::move(CollisionWorld::build(ground.view(), list).value());
        ASSERT_EQ(world.triangle_count(), fresh.triangle_count());
        ASSERT_EQ(world.bounds().min, fresh.bounds().min);
        ASSERT_EQ(world.bounds().max, fresh.bounds().max);
        for (TriangleId t = 0; t < fresh.triangle_count(); ++t) {
            ASSERT_EQ(world.triangle(t), fresh.triangle(t));
            ASSERT_EQ(world.triangle_face(t), fresh.triangle_face(t));
        }
        for (FaceId f = 0; f < face; ++f)
            ASSERT_EQ(world.face_surface(f), fresh.face_surface(f));
        for (int i = 0; i < 100; ++i) {
            const Vec3 from = random.in_box(6), move = 4 * random.direction();
            const auto hit = sweep_ellipsoid(fresh, {0.4, 0.9, 0.4}, from, move);
            hits += hit.has_value();
            ASSERT_TRUE(same(sweep_ellipsoid(world, {0.4, 0.9, 0.4}, from, move), hit));
        }
        // A list that cannot be taken changes nothing.
        std::vector<Instance> bad = list;
        bad.push_back({nullptr, {}, face, nullptr});
        EXPECT_FALSE(world.set_instances(bad).ok());
        bad.back() = {meshes[0], {}, face, std::make_shared<std::vector<SurfaceId>>(3)};
        EXPECT_FALSE(world.set_instances(bad).ok());
        ASSERT_EQ(world.triangle_count(), fresh.triangle_count());
    }
    EXPECT_GT(hits, 1000U);
}

// A query that floats cannot hold, or a world.
TEST(InstancesTogether, AnswerBeyondFloats) {
    Random random(73);
    Instanced scene({}, {quads(random)});
    scene.add(0, placement({1e16, 0, 0}, {1, 2, 3}, {1e3, 1e3, -1e3}));
    scene.add(0, placement({0, 0, 0}, {1, 2, 3}, {1, 1, 1}));
    const CollisionWorld shared = scene.world(), flat = scene.flat().world();
    for (int i = 0; i < 200; ++i) {
        const Vec3 from = random.in_box(3), move = 1e16 * random.direction();
        EXPECT_TRUE(same(sweep_ellipsoid(shared, {1, 1, 1}, from, move),
                         sweep_ellipsoid(flat, {1, 1, 1}, from, move)));
        EXPECT_TRUE(same(cast_ray(shared, from, move), cast_ray(flat, from, move)));
        EXPECT_TRUE(same(closest_point(shared, from), closest_point(flat, from)));
    }
}

TEST(InstancesTogether, ShareMeshesAndTypes) {
    Random random(74);
    const Soup mesh = scenes::terrain(random, 20, 0.5);
    Instanced scene({}, {mesh});
    for (int i = 0; i < 1000; ++i)
        scene.add(0, placement(random.in_box(500), random.in_box(3), {1, 1, 1}));
    CollisionWorld world = scene.world();
    const std::size_t one = mesh.world().statistics().bytes;
    EXPECT_LT(world.statistics().bytes, 2 * one + 1000 * 600);
    std::vector<SurfaceId> types(scene.faces(), 1);
    world.set_face_surfaces(types);
    EXPECT_LT(world.statistics().bytes, 2 * one + 1000 * 600);
    // Of one of them alone.
    const FaceId face = scene.faces() - 1;
    world.set_face_surface(face, 2);
    EXPECT_EQ(world.face_surface(face), 2);
    EXPECT_EQ(world.face_surface(face - scene.faces() / 1000), 1);
    EXPECT_EQ(world.face_surface(scene.faces()), default_surface);
}

TEST(InstancesTogether, RefuseWhatCannotStand) {
    Random random(75);
    const Soup mesh = scenes::dense(quads(random));
    const auto shared = scenes::shared_mesh(mesh);
    const auto error = [&](const std::vector<Instance>& instances) {
        const auto world = CollisionWorld::build(mesh.view(), instances);
        return world ? std::string() : world.error().text();
    };
    const FaceId first = mesh.faces.back() + 1;
    EXPECT_EQ(error({{shared, {}, first, nullptr}}), "");
    EXPECT_THAT(error({{shared, {}, first - 1}}), testing::HasSubstr("not above those before"));
    EXPECT_THAT(error({{nullptr, {}, first}}), testing::HasSubstr("has no mesh"));
    EXPECT_THAT(error({{shared, placement({0, 0, 0}, {0, 0, 0}, {1, 0, 1}), first}}),
                testing::HasSubstr("flattens"));
    EXPECT_THAT(error({{shared, placement({1e39, 0, 0}, {0, 0, 0}, {1, 1, 1}), first}}),
                testing::HasSubstr("not finite"));
    EXPECT_THAT(error({{shared, placement({NAN, 0, 0}, {0, 0, 0}, {1, 1, 1}), first}}),
                testing::HasSubstr("not finite"));
    EXPECT_THAT(error({{shared, {}, no_id - 2}}), testing::HasSubstr("too many faces"));
    CollisionWorld world =
        std::move(CollisionWorld::build(mesh.view(), std::vector<Instance>{{shared, {}, first}}).value());
    const std::array<TriangleId, 1> moved{static_cast<TriangleId>(mesh.triangles.size())};
    const std::vector<std::array<Vec3f, 3>> corners(1);
    EXPECT_FALSE(world.move_triangles(moved, corners).ok());
}

}  // namespace
}  // namespace slipface
