// The answers of a large world, put together from worlds of eight triangles each, whose trees are one leaf.
#pragma once

#include <algorithm>
#include <tuple>

#include "brute_force.h"
#include "slipface/collision/filter.h"

namespace slipface::scenes {

class LeafWorlds {
  public:
    static constexpr std::size_t size = 8;

    // `types`: [face]. Type 2 is one-sided, type 3 not solid.
    LeafWorlds(const Soup& soup, std::span<const SurfaceId> types) : soup_(soup) {
        for (std::size_t first = 0; first < soup.triangles.size(); first += size) {
            const std::size_t count = std::min(size, soup.triangles.size() - first);
            // Only their own positions: build() reads all of them.
            std::array<Vec3f, 3 * size> positions;
            std::array<std::array<std::uint32_t, 3>, size> triangles{};
            for (std::uint32_t i = 0; i < 3 * count; ++i) {
                positions[i] = soup.positions[soup.triangles[first + i / 3][i % 3]];
                triangles[i / 3][i % 3] = i;
            }
            auto world = CollisionWorld::build({std::span(positions).first(3 * count),
                                                std::span(triangles).first(count),
                                                std::span(soup.faces).subspan(first, count)});
            if (!world) throw std::runtime_error(world.error().text());
            for (const FaceId face : std::span(soup.faces).subspan(first, count))
                world->set_face_surface(face, types[face]);
            set_rules(*world);
            worlds_.push_back(std::move(*world));
        }
    }
    static void set_rules(CollisionWorld& world) {
        world.set_surface_rule(2, {.solid = true, .one_sided = true});
        world.set_surface_rule(3, {.solid = false});
    }

    std::vector<Contact> sweep_hits(const Vec3& radii, const Vec3& from, const Vec3& move,
                                    const QueryFilter& filter) const {
        auto all = gather<Contact>(
            filter, [&](const CollisionWorld& world, std::span<Contact> out, const QueryFilter& its) {
                return find_sweep_hits(world, radii, from, move, out, its);
            });
        std::ranges::sort(all, [](const Contact& a, const Contact& b) {
            return std::tie(a.t, a.feature, a.triangle) < std::tie(b.t, b.feature, b.triangle);
        });
        return all;
    }
    std::vector<RayHit> ray_hits(const Vec3& origin, const Vec3& direction, double max_t, RayStops stops,
                                 const QueryFilter& filter) const {
        auto all = gather<RayHit>(
            filter, [&](const CollisionWorld& world, std::span<RayHit> out, const QueryFilter& its) {
                return find_ray_hits(world, origin, direction, max_t, stops, out, its);
            });
        std::ranges::sort(all, [](const RayHit& a, const RayHit& b) {
            return std::tie(a.t, a.triangle) < std::tie(b.t, b.triangle);
        });
        return all;
    }
    std::vector<Overlap> overlaps(const Vec3& radii, const Vec3& centre, const QueryFilter& filter) const {
        return gather<Overlap>(
            filter, [&](const CollisionWorld& world, std::span<Overlap> out, const QueryFilter& its) {
                return find_overlaps(world, radii, centre, out, its);
            });
    }
    std::optional<ClosestPoint> closest(const Vec3& point, double max_distance,
                                        const QueryFilter& filter) const {
        std::optional<ClosestPoint> best;
        for (std::size_t i = 0; i < worlds_.size(); ++i) {
            auto found =
                closest_point(worlds_[i], point, best ? best->distance : max_distance, of_leaf(filter, i));
            if (!found || (best && !(found->distance < best->distance))) continue;
            found->triangle += static_cast<TriangleId>(i * size);
            best = found;
        }
        return best;
    }
    std::vector<TriangleId> in_box(const Aabb& box) const {
        std::vector<TriangleId> found;
        for (std::size_t i = 0; i < soup_.triangles.size(); ++i) {
            Aabb own;
            for (const std::uint32_t corner : soup_.triangles[i])
                own.add(soup_.positions[corner].cast<double>());
            if ((own.min.array() <= box.max.array()).all() && (own.max.array() >= box.min.array()).all())
                found.push_back(static_cast<TriangleId>(i));
        }
        return found;
    }

  private:
    static QueryFilter of_leaf(const QueryFilter& filter, std::size_t i) {
        QueryFilter its = filter;
        const std::size_t first = std::min(i * size, filter.groups.size());
        its.groups = filter.groups.subspan(first, std::min(size, filter.groups.size() - first));
        return its;
    }
    template <class T, class Query>
    std::vector<T> gather(const QueryFilter& filter, const Query& query) const {
        std::vector<T> all;
        for (std::size_t i = 0; i < worlds_.size(); ++i) {
            std::array<T, size> found;
            const std::size_t count = query(worlds_[i], std::span<T>(found), of_leaf(filter, i));
            for (T& one : std::span(found).first(count)) {
                one.triangle += static_cast<TriangleId>(i * size);
                all.push_back(one);
            }
        }
        return all;
    }

    const Soup& soup_;
    std::vector<CollisionWorld> worlds_;
};

}  // namespace slipface::scenes
