// A random large world against worlds of one leaf: every query, on every instruction set, at any number of
// threads, before and after its triangles moved, and as instances.
#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include "instanced.h"
#include "leaf_worlds.h"
#include "mixed_world.h"
#include "slipface/collision/neighbourhood.h"
#include "slipface/collision/simd.h"
#include "sound_tree.h"

namespace slipface::scenes {

class LargeWorld {
  public:
    LargeWorld(std::uint64_t seed, std::size_t triangles, int queries)
        : random_(seed), queries_(queries), before_(simd_path()) {
        // Small ones, too: they meet other branches.
        in_ = mixed_world(random_, 8 + static_cast<std::size_t>(static_cast<double>(triangles) *
                                                                std::pow(10.0, random_.uniform(-1, 0))));
        for (std::size_t i = 0; i < in_.soup.triangles.size(); ++i)
            groups_.push_back(static_cast<std::uint32_t>(1 + random_.below(7)));
    }
    ~LargeWorld() { set_simd_path(before_); }
    LargeWorld(const LargeWorld&) = delete;
    LargeWorld& operator=(const LargeWorld&) = delete;

    // What is wrong; empty if nothing.
    std::string fault() {
        CollisionWorld world = built();
        check_tree(world, "built");
        check_threads(world);
        for (FaceId face = 0; face < in_.types.size(); ++face)
            world.set_face_surface(face, in_.types[face]);
        LeafWorlds::set_rules(world);
        check_queries(world, "built");
        for (const char* how : {"some moved", "a body moved", "all moved"}) {
            if (fault_.empty()) move(world, how);
            check_tree(world, how);
            if (fault_.empty()) check_queries(world, how);
        }
        if (fault_.empty()) check_instances();
        return fault_;
    }
    std::size_t triangles() const { return in_.soup.triangles.size(); }
    std::size_t hits() const { return hits_; }

  private:
    TriangleSoup view() const {
        TriangleSoup view = in_.soup.view();
        view.bodies = in_.bodies;
        return view;
    }
    CollisionWorld built() const {
        auto world = CollisionWorld::build(view());
        if (!world) throw std::runtime_error(world.error().text());
        return std::move(*world);
    }
    bool require(bool holds, const std::string& what) {
        if (!holds && fault_.empty()) fault_ = what;
        return holds;
    }
    void check_tree(const CollisionWorld& world, const char* when) {
        const std::string fault = SoundTree(world.impl().bvh, view()).fault();
        require(fault.empty(), fmt::format("{}: {}", when, fault));
    }
    void check_threads(const CollisionWorld& world) {
        for (const int threads : {1, 2, 7}) {
            const oneapi::tbb::global_control more(oneapi::tbb::global_control::max_allowed_parallelism,
                                                   static_cast<std::size_t>(threads));
            oneapi::tbb::task_arena(threads).execute([&] {
                const CollisionWorld other = built();
                const detail::Bvh &a = world.impl().bvh, &b = other.impl().bvh;
                const bool same_nodes =
                    a.nodes.size() == b.nodes.size() &&
                    std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(a.nodes[0])) == 0;
                require(same_nodes && a.leaves == b.leaves && a.leaf_of == b.leaf_of,
                        fmt::format("another tree on {} threads", threads));
            });
        }
    }

    struct Query {
        Vec3 radii, from, move;
        double max_t, max_distance;
        RayStops stops;
        QueryFilter filter;
        Vec3 reach;
    };
    double power(double low, double high) { return std::pow(10.0, random_.uniform(low, high)); }
    // About as large as a triangle that is near, mostly.
    Query query(const Soup& soup) {
        const auto& corners = soup.triangles[random_.below(soup.triangles.size())];
        const Vec3 a = soup.positions[corners[0]].cast<double>(),
                   b = soup.positions[corners[1]].cast<double>(),
                   c = soup.positions[corners[2]].cast<double>();
        const double size = std::clamp((b - a).norm() + (c - a).norm(), 1e-6, 1e6) * power(-1, 2);
        const double u = random_.uniform(0, 1), v = random_.uniform(0, 1 - u);
        Query q;
        q.radii = size * (random_.below(3) == 0 ? Vec3(Vec3::Constant(0.5))
                                                : Vec3(0.55 * Vec3::Ones() + random_.in_box(0.45)));
        q.from = a + u * (b - a) + v * (c - a) + size * random_.uniform(0, 3) * random_.direction();
        q.move = size * power(-2, random_.below(4) == 0 ? 4 : 1.5) * random_.direction();
        if (random_.below(4) == 0)
            q.move = q.move.cwiseProduct(Vec3::Unit(static_cast<int>(random_.below(3))));
        q.max_t = random_.below(2) == 0 ? 1.0 : std::numeric_limits<double>::infinity();
        q.max_distance = random_.below(2) == 0 ? size : std::numeric_limits<double>::infinity();
        q.stops = random_.below(2) == 0 ? RayStops::solid : RayStops::as_movement;
        if (random_.below(2) == 0) q.filter.ignored[random_.below(4)] = true;
        if (random_.below(2) == 0) q.filter.groups = groups_;
        q.filter.mask = static_cast<std::uint32_t>(1 + random_.below(7));
        q.reach = random_.uniform(0, 2) * q.radii;
        return q;
    }

    void check_queries(const CollisionWorld& world, const char* when) {
        const LeafWorlds leaves(in_.soup, in_.types);
        check_queries(world, in_.soup, leaves, when);
    }
    void check_queries(const CollisionWorld& world, const Soup& soup, const LeafWorlds& leaves,
                       const char* when) {
        std::vector<Sweep> sweeps;
        std::vector<std::optional<Contact>> contacts;
        for (int i = 0; i < queries_ && fault_.empty(); ++i) {
            const Query q = query(soup);
            const auto hits = leaves.sweep_hits(q.radii, q.from, q.move, {});
            sweeps.push_back({q.radii, q.from, q.move});
            contacts.push_back(hits.empty() ? std::nullopt : std::optional(hits[0]));
            hits_ += hits.size();
            check_query(world, leaves, q, contacts.back(), fmt::format("{}, query {}", when, i));
        }
        for (const std::string_view path : simd_paths()) {
            set_simd_path(path);
            std::vector<std::optional<Contact>> out(sweeps.size());
            sweep_ellipsoids(world, sweeps, out);
            for (std::size_t i = 0; i < sweeps.size() && fault_.empty(); ++i)
                require(same(out[i], contacts[i]), fmt::format("{}: {} in a batch, {}", when, i, path));
        }
    }

    template <class T>
    static std::optional<T> first(const std::vector<T>& all) {
        return all.empty() ? std::nullopt : std::optional(all[0]);
    }
    template <class T>
    void require_list(const std::vector<T>& found, std::size_t count, const std::vector<T>& expected,
                      const std::string& what) {
        if (!require(count == expected.size(), fmt::format("{}: {} of {}", what, count, expected.size())))
            return;
        for (std::size_t i = 0; i < std::min(count, found.size()); ++i)
            require(same_one(found[i], expected[i]), what);
    }
    static bool same_one(const Overlap& a, const Overlap& b) { return same(a, b) && a.surface == b.surface; }
    static bool same_one(const Contact& a, const Contact& b) {
        return same(std::optional(a), std::optional(b)) && a.surface == b.surface;
    }
    static bool same_one(const RayHit& a, const RayHit& b) {
        return same(std::optional(a), std::optional(b));
    }
    // Different squares may have the same root.
    static bool same_distance(const std::optional<ClosestPoint>& a, const std::optional<ClosestPoint>& b) {
        return a.has_value() == b.has_value() && (!a || a->distance == b->distance);
    }

    void check_query(const CollisionWorld& world, const LeafWorlds& leaves, const Query& q,
                     const std::optional<Contact>& contact, const std::string& when) {
        const auto seen_hits = leaves.sweep_hits(q.radii, q.from, q.move, q.filter);
        const auto rays = leaves.ray_hits(q.from, q.move, q.max_t, q.stops, {});
        const auto seen_rays = leaves.ray_hits(q.from, q.move, q.max_t, q.stops, q.filter);
        const auto overlaps = leaves.overlaps(q.radii, q.from, {});
        const auto seen_overlaps = leaves.overlaps(q.radii, q.from, q.filter);
        const auto closest = leaves.closest(q.from, q.max_distance, {});
        const auto seen_closest = leaves.closest(q.from, q.max_distance, q.filter);
        Aabb box;
        box.add(q.from - q.radii);
        box.add(q.from + q.radii);
        require(world.triangles_in(box) == leaves.in_box(box), when + ": triangles in a box");
        for (const std::string_view path : simd_paths()) {
            const std::string what = fmt::format("{}, {}: ", when, path);
            set_simd_path(path);
            require(same(sweep_ellipsoid(world, q.radii, q.from, q.move), contact), what + "sweep");
            require(same(sweep_ellipsoid(world, q.radii, q.from, q.move, q.filter), first(seen_hits)),
                    what + "filtered sweep");
            std::vector<Contact> hits(5);
            require_list(hits, find_sweep_hits(world, q.radii, q.from, q.move, hits, q.filter), seen_hits,
                         what + "hits of a sweep");
            require(same(cast_ray(world, q.from, q.move, q.max_t, q.stops), first(rays)), what + "ray");
            require(same(cast_ray(world, q.from, q.move, q.max_t, q.stops, q.filter), first(seen_rays)),
                    what + "filtered ray");
            std::vector<RayHit> pierced(5);
            require_list(pierced, find_ray_hits(world, q.from, q.move, q.max_t, q.stops, pierced, q.filter),
                         seen_rays, what + "hits of a ray");
            require(same_distance(closest_point(world, q.from, q.max_distance), closest), what + "closest");
            require(same_distance(closest_point(world, q.from, q.max_distance, q.filter), seen_closest),
                    what + "filtered closest");
            std::vector<Overlap> touched(5);
            require_list(touched, find_overlaps(world, q.radii, q.from, touched), overlaps,
                         what + "overlaps");
            require(overlaps_any(world, q.radii, q.from) == !overlaps.empty(), what + "overlaps any");
            require_list(touched, find_overlaps(world, q.radii, q.from, touched, q.filter), seen_overlaps,
                         what + "filtered overlaps");
            const Neighbourhood near(world, q.radii, q.from, q.reach);
            require(same(sweep_ellipsoid(near, q.radii, q.from, q.move), contact), what + "sweep nearby");
            require_list(touched, find_overlaps(near, q.radii, q.from, touched), overlaps,
                         what + "overlaps nearby");
        }
    }

    // Rigidly, or each corner elsewhere.
    void move(CollisionWorld& world, const std::string& how) {
        Soup& soup = in_.soup;
        const std::size_t count = soup.triangles.size();
        const auto body = in_.bodies.empty() ? 0 : in_.bodies[random_.below(count)];
        const std::size_t part = 1 + random_.below(count);
        const bool rigid = random_.below(2) == 0;
        const double far = power(-2, 3);
        const Vec3f by = (far * random_.direction()).cast<float>();
        std::vector<TriangleId> ids;
        std::vector<std::array<Vec3f, 3>> corners;
        for (TriangleId i = 0; i < count; ++i) {
            const bool goes = how == "all moved" || (how == "some moved"  ? random_.below(part) == 0
                                                     : in_.bodies.empty() ? i < part
                                                                          : in_.bodies[i] == body);
            if (!goes) continue;
            ids.push_back(i);
            auto& to = corners.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                to[k] = soup.positions[soup.triangles[i][k]] +
                        (rigid ? by : Vec3f(random_.in_box(far).cast<float>()));
                soup.positions.push_back(to[k]);
                soup.triangles[i][k] = static_cast<std::uint32_t>(soup.positions.size() - 1);
            }
        }
        // In any order, as the caller likes.
        for (std::size_t i = ids.size(); how != "all moved" && i > 1; --i) {
            const std::size_t other = random_.below(i);
            std::swap(ids[i - 1], ids[other]);
            std::swap(corners[i - 1], corners[other]);
        }
        require(bool(world.move_triangles(ids, corners)), how);
    }

    // The world as it was last, with instances of smaller worlds in it, also far away and very small or
    // large.
    void check_instances() {
        std::vector<Soup> meshes;
        for (int i = 0; i < 3; ++i)
            meshes.push_back(mixed_world(random_, 1 + random_.below(1 + triangles() / 8)).soup);
        Soup ground = random_.below(3) == 0 ? Soup() : dense_order(in_.soup);
        Instanced scene(std::move(ground), meshes);
        for (std::size_t i = 1 + random_.below(12); i > 0; --i)
            scene.add(random_.below(meshes.size()),
                      placement(power(0, 5) * random_.direction(), random_.in_box(4),
                                power(-2, 1) * random_scale(random_, 4)));
        CollisionWorld world = scene.world();
        std::vector<SurfaceId> types(scene.faces());
        for (SurfaceId& type : types)
            type = static_cast<SurfaceId>(random_.below(4));
        world.set_face_surfaces(types);
        LeafWorlds::set_rules(world);
        while (groups_.size() < scene.flat().triangles.size())
            groups_.push_back(static_cast<std::uint32_t>(1 + random_.below(7)));
        check_queries(world, scene.flat(), LeafWorlds(scene.flat(), types), "instances");
    }
    // Its faces in ascending order, as a soup below instances has them.
    static Soup dense_order(Soup soup) {
        std::ranges::sort(soup.faces);
        return soup;
    }

    Random random_;
    int queries_;
    std::string before_;
    MixedWorld in_;
    std::vector<std::uint32_t> groups_;  // [triangle]
    std::size_t hits_ = 0;
    std::string fault_;
};

}  // namespace slipface::scenes
