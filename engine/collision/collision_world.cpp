#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>

#include "impl.h"
#include "instance_list.h"
#include "queries/sphere_triangle.h"
#include "slipface/collision/revision.h"

namespace slipface {
namespace {

Status check(const TriangleSoup& soup) {
    if (soup.faces.size() != soup.triangles.size()) {
        return Error{"collision soup", std::to_string(soup.faces.size()) + " face ids for " +
                                           std::to_string(soup.triangles.size()) +
                                           " triangles; expected one per triangle (twice)"};
    }
    if (soup.triangles.size() > detail::max_triangles) {
        return Error{"collision soup", std::to_string(soup.triangles.size()) +
                                           " triangles; expected at most " +
                                           std::to_string(detail::max_triangles)};
    }
    if (!soup.bodies.empty() && soup.bodies.size() != soup.triangles.size()) {
        return Error{"collision soup", std::to_string(soup.bodies.size()) + " body numbers for " +
                                           std::to_string(soup.triangles.size()) +
                                           " triangles; expected none or one per triangle"};
    }
    for (std::size_t i = 0; i < soup.positions.size(); ++i) {
        if (!soup.positions[i].allFinite()) {
            return Error{"position " + std::to_string(i),
                         "a coordinate is not finite; expected finite numbers"};
        }
    }
    for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
        for (const std::uint32_t index : soup.triangles[i]) {
            if (index >= soup.positions.size()) {
                return Error{"triangle " + std::to_string(i),
                             "corner index " + std::to_string(index) + "; expected less than the " +
                                 std::to_string(soup.positions.size()) + " positions"};
            }
        }
    }
    return {};
}

// Numbers the faces densely, so that very large face ids cost no memory.
void index_faces(const TriangleSoup& soup, CollisionWorld::Impl& impl) {
    impl.faces.assign(soup.faces.begin(), soup.faces.end());
    // Faces of a mesh are already ascending.
    const bool ascending = std::is_sorted(impl.faces.begin(), impl.faces.end());
    if (!ascending) std::sort(impl.faces.begin(), impl.faces.end());
    impl.faces.erase(std::unique(impl.faces.begin(), impl.faces.end()), impl.faces.end());
    impl.faces.shrink_to_fit();
    impl.surfaces.assign(impl.faces.size(), default_surface);
    impl.face_index = detail::TriangleFaces(ascending, soup.faces.size());
    std::size_t index = 0;
    for (const FaceId face : soup.faces) {
        if (ascending) {
            while (impl.faces[index] != face)
                ++index;
        } else {
            index = static_cast<std::size_t>(std::lower_bound(impl.faces.begin(), impl.faces.end(), face) -
                                             impl.faces.begin());
        }
        impl.face_index.add(static_cast<std::uint32_t>(index));
    }
    if (!impl.faces.empty() && impl.faces.back() == impl.faces.size() - 1) {
        impl.faces = std::vector<FaceId>();
    }
}

// Extends the bounds by the boxes of the trees.
void grow_bounds(CollisionWorld::Impl& impl) {
    std::ranges::fill(impl.extent.low, std::numeric_limits<float>::infinity());
    std::ranges::fill(impl.extent.high, -std::numeric_limits<float>::infinity());
    for (const detail::Bvh* bvh : {&impl.bvh, &impl.boxes}) {
        if (bvh->nodes.empty()) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            impl.extent.low[axis] = std::min(impl.extent.low[axis], bvh->low[axis]);
            impl.extent.high[axis] = std::max(impl.extent.high[axis], bvh->high[axis]);
        }
        for (const auto& corner : {bvh->low, bvh->high}) {
            impl.bounds.add(Vec3(double{corner[0]}, double{corner[1]}, double{corner[2]}));
            for (const float coordinate : corner)
                impl.extent.reach = std::max(impl.extent.reach, std::fabs(double{coordinate}));
        }
    }
    impl.radius = impl.bounds.empty() ? 0.0 : (0.5 + 1e-6) * (impl.bounds.max - impl.bounds.min).norm();
}

std::optional<std::size_t> find_face(const CollisionWorld::Impl& impl, FaceId face) {
    if (impl.faces.empty())
        return face < impl.surfaces.size() ? std::optional<std::size_t>(face) : std::nullopt;
    const auto index = std::lower_bound(impl.faces.begin(), impl.faces.end(), face);
    if (index == impl.faces.end() || *index != face) return std::nullopt;
    return static_cast<std::size_t>(index - impl.faces.begin());
}

}  // namespace

std::uint64_t next_revision() {
    static std::atomic<std::uint64_t> latest = 0;
    return ++latest;
}

std::uint64_t revision(const CollisionWorld& world) {
    return world.impl().revision;
}

CollisionWorld::CollisionWorld() : impl_(std::make_unique<Impl>()) {}
CollisionWorld::~CollisionWorld() = default;
CollisionWorld::CollisionWorld(CollisionWorld&& other) noexcept = default;
CollisionWorld& CollisionWorld::operator=(CollisionWorld&& other) noexcept = default;

Result<CollisionWorld> CollisionWorld::build(const TriangleSoup& soup) {
    return build(soup, {});
}

Result<CollisionWorld> CollisionWorld::build(const TriangleSoup& soup, std::span<const Instance> instances) {
    return build(soup, instances, detail::LeafForm::any);
}

Result<CollisionWorld> CollisionWorld::build_movable(const TriangleSoup& soup) {
    return build(soup, {}, detail::LeafForm::vertices);
}

Result<CollisionWorld> CollisionWorld::build(const TriangleSoup& soup, std::span<const Instance> instances,
                                             detail::LeafForm form) {
    try {
        if (const Status status = check(soup); !status) return status.error();
        CollisionWorld world;
        Impl& impl = *world.impl_;
        impl.bvh = detail::build_bvh(soup.positions, soup.triangles, soup.bodies, form);
        index_faces(soup, impl);
        impl.triangles = soup.triangles.size();
        if (const Status status = replace_instances(impl, instances); !status) return status.error();
        grow_bounds(impl);
        if (form == detail::LeafForm::vertices && !soup.triangles.empty()) {
            const auto radius = static_cast<float>(impl.radius);
            const std::array<Vec3f, 2> corners{Vec3f::Constant(-radius), Vec3f::Constant(radius)};
            const std::vector<std::array<std::uint32_t, 3>> box{{0, 1, 1}};
            impl.ball = detail::build_bvh(corners, box, {}, detail::LeafForm::any);
        }
        return world;
    } catch (const std::bad_alloc&) {
        return Error{"collision soup", "not enough memory for " + std::to_string(soup.triangles.size()) +
                                           " triangles; expected a smaller mesh"};
    }
}

Status CollisionWorld::set_instances(std::span<const Instance> instances) {
    impl_->revision = next_revision();
    try {
        if (Status status = replace_instances(*impl_, instances); !status) return status;
    } catch (const std::bad_alloc&) {
        return Error{"instances", "not enough memory for " + std::to_string(instances.size()) +
                                      " instances; expected fewer"};
    }
    impl_->bounds = {};
    impl_->extent = {};
    grow_bounds(*impl_);
    return {};
}

Status CollisionWorld::move_triangles(std::span<const TriangleId> triangles,
                                      std::span<const std::array<Vec3f, 3>> corners) {
    impl_->revision = next_revision();
    if (triangles.size() != corners.size()) {
        return Error{"moved triangles", std::to_string(corners.size()) + " triples of corners for " +
                                            std::to_string(triangles.size()) +
                                            " triangles; expected one per triangle (twice)"};
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (triangles[i] >= impl_->own_triangles()) {
            return Error{"moved triangle " + std::to_string(i),
                         "number " + std::to_string(triangles[i]) + "; expected less than the " +
                             std::to_string(impl_->own_triangles()) + " triangles"};
        }
        for (const Vec3f& corner : corners[i]) {
            if (!corner.allFinite()) {
                return Error{"moved triangle " + std::to_string(i),
                             "a coordinate is not finite; expected finite numbers"};
            }
        }
    }
    detail::move_bvh_triangles(impl_->bvh, triangles, corners);
    grow_bounds(*impl_);
    return {};
}

void CollisionWorld::set_face_surface(FaceId face, SurfaceId surface) {
    impl_->revision = next_revision();
    if (const auto index = find_face(*impl_, face))
        impl_->surfaces[*index] = surface;
    else
        set_instance_surface(*impl_, face, surface);
}

void CollisionWorld::set_face_surfaces(std::span<const SurfaceId> surfaces) {
    impl_->revision = next_revision();
    const std::size_t first_placed =
        impl_->placed.empty() ? surfaces.size() : std::size_t{impl_->placed.front().first_face};
    const std::size_t count = std::min(surfaces.size(), first_placed);
    if (impl_->faces.empty())
        std::copy_n(surfaces.begin(), std::min(count, impl_->surfaces.size()), impl_->surfaces.begin());
    else
        for (std::size_t face = 0; face < count; ++face)
            set_face_surface(static_cast<FaceId>(face), surfaces[face]);
    if (surfaces.size() > first_placed) set_instance_surfaces(*impl_, surfaces);
}

SurfaceId CollisionWorld::face_surface(FaceId face) const {
    const auto index = find_face(*impl_, face);
    return index ? impl_->surfaces[*index] : instance_surface(*impl_, face);
}

void CollisionWorld::set_surface_rule(SurfaceId surface, SurfaceRule rule) {
    impl_->revision = next_revision();
    impl_->rules[surface] = rule;
    impl_->plain = std::all_of(impl_->rules.begin(), impl_->rules.end(),
                               [](const SurfaceRule& any) { return any.solid && !any.one_sided; });
}
SurfaceRule CollisionWorld::surface_rule(SurfaceId surface) const {
    return impl_->rules[surface];
}

std::size_t CollisionWorld::triangle_count() const {
    return impl_->triangle_count();
}

std::array<Vec3, 3> CollisionWorld::triangle(TriangleId triangle) const {
    const detail::LeafTriangle leaf = impl_->triangle(triangle);
    return {vec(corner(leaf, 0)), vec(corner(leaf, 1)), vec(corner(leaf, 2))};
}

FaceId CollisionWorld::triangle_face(TriangleId triangle) const {
    return impl_->face_of(triangle);
}

Vec3 CollisionWorld::triangle_normal(TriangleId triangle) const {
    return vec(detail::winding_normal(impl_->triangle(triangle)));
}

Aabb CollisionWorld::bounds() const {
    return impl_->bounds;
}

BvhStatistics CollisionWorld::statistics() const {
    const auto bytes = [](const auto& list) { return list.capacity() * sizeof(list[0]); };
    BvhStatistics all{triangle_count(), 0, 0, 0};
    for (const detail::Bvh* bvh : {&impl_->bvh, &impl_->boxes}) {
        all.nodes += bvh->nodes.size();
        all.bytes += bytes(bvh->nodes) + bytes(bvh->leaves) + bvh->leaf_of.bytes() + bytes(bvh->parents) +
                     bytes(bvh->leaf_parents);
    }
    all.bytes += bytes(impl_->faces) + impl_->face_index.bytes() + bytes(impl_->surfaces) +
                 bytes(impl_->views) + bytes(impl_->placed) + bytes_of_meshes(*impl_);
    all.depth = impl_->bvh.depth + impl_->boxes.depth;
    return all;
}

}  // namespace slipface
