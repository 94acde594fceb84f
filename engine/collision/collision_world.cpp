#include <algorithm>
#include <cmath>

#include "impl.h"
#include "sphere_triangle.h"

namespace slipface {
namespace {

Status check(const TriangleSoup& soup) {
    if (soup.faces.size() != soup.triangles.size()) {
        return Error{"collision soup", std::to_string(soup.faces.size()) + " face ids for " +
                                           std::to_string(soup.triangles.size()) +
                                           " triangles; expected one a triangle"};
    }
    if (soup.triangles.size() > detail::max_triangles) {
        return Error{"collision soup", std::to_string(soup.triangles.size()) +
                                           " triangles; expected at most " +
                                           std::to_string(detail::max_triangles)};
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

// Faces numbered densely, so that hostile face ids cost no memory.
void index_faces(const TriangleSoup& soup, CollisionWorld::Impl& impl) {
    impl.faces.assign(soup.faces.begin(), soup.faces.end());
    std::sort(impl.faces.begin(), impl.faces.end());
    impl.faces.erase(std::unique(impl.faces.begin(), impl.faces.end()), impl.faces.end());
    impl.faces.shrink_to_fit();
    impl.surfaces.assign(impl.faces.size(), default_surface);
    impl.face_index.reserve(soup.faces.size());
    for (const FaceId face : soup.faces) {
        const auto place = std::lower_bound(impl.faces.begin(), impl.faces.end(), face);
        impl.face_index.push_back(static_cast<std::uint32_t>(place - impl.faces.begin()));
    }
}

std::optional<std::size_t> find_face(const CollisionWorld::Impl& impl, FaceId face) {
    const auto place = std::lower_bound(impl.faces.begin(), impl.faces.end(), face);
    if (place == impl.faces.end() || *place != face) return std::nullopt;
    return static_cast<std::size_t>(place - impl.faces.begin());
}

}  // namespace

CollisionWorld::CollisionWorld() : impl_(std::make_unique<Impl>()) {}
CollisionWorld::~CollisionWorld() = default;
CollisionWorld::CollisionWorld(CollisionWorld&& other) noexcept = default;
CollisionWorld& CollisionWorld::operator=(CollisionWorld&& other) noexcept = default;

Result<CollisionWorld> CollisionWorld::build(const TriangleSoup& soup) {
    try {
        if (const Status status = check(soup); !status) return status.error();
        CollisionWorld world;
        Impl& impl = *world.impl_;
        std::vector<detail::LeafTriangle> triangles;
        triangles.reserve(soup.triangles.size());
        for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
            detail::LeafTriangle triangle{};
            triangle.id = static_cast<TriangleId>(i);
            for (std::size_t k = 0; k < 9; ++k) {
                triangle.v[k] = soup.positions[soup.triangles[i][k / 3]][static_cast<Eigen::Index>(k % 3)];
                impl.reach = std::max(impl.reach, std::fabs(double{triangle.v[k]}));
            }
            for (int k = 0; k < 3; ++k)
                impl.bounds.add(vec(triangle.corner(k)));
            triangles.push_back(triangle);
        }
        impl.bvh = detail::build_bvh(std::move(triangles));
        impl.slot.resize(impl.bvh.triangles.size());
        for (std::size_t i = 0; i < impl.slot.size(); ++i) {
            impl.slot[impl.bvh.triangles[i].id] = static_cast<std::uint32_t>(i);
        }
        index_faces(soup, impl);
        return world;
    } catch (const std::bad_alloc&) {
        return Error{"collision soup", "not enough memory for " + std::to_string(soup.triangles.size()) +
                                           " triangles; expected a smaller mesh"};
    }
}

void CollisionWorld::set_face_surface(FaceId face, SurfaceId surface) {
    if (const auto index = find_face(*impl_, face)) impl_->surfaces[*index] = surface;
}

SurfaceId CollisionWorld::face_surface(FaceId face) const {
    const auto index = find_face(*impl_, face);
    return index ? impl_->surfaces[*index] : default_surface;
}

void CollisionWorld::set_surface_rule(SurfaceId surface, SurfaceRule rule) {
    impl_->rules[surface] = rule;
}
SurfaceRule CollisionWorld::surface_rule(SurfaceId surface) const {
    return impl_->rules[surface];
}

std::size_t CollisionWorld::triangle_count() const {
    return impl_->slot.size();
}

std::array<Vec3, 3> CollisionWorld::triangle(TriangleId triangle) const {
    const detail::LeafTriangle& leaf = impl_->bvh.triangles[impl_->slot[triangle]];
    return {vec(leaf.corner(0)), vec(leaf.corner(1)), vec(leaf.corner(2))};
}

FaceId CollisionWorld::triangle_face(TriangleId triangle) const {
    return impl_->faces[impl_->face_index[triangle]];
}

Vec3 CollisionWorld::triangle_normal(TriangleId triangle) const {
    return vec(detail::winding_normal(impl_->bvh.triangles[impl_->slot[triangle]]));
}

Aabb CollisionWorld::bounds() const {
    return impl_->bounds;
}

BvhStatistics CollisionWorld::statistics() const {
    const auto bytes = [](const auto& list) { return list.size() * sizeof(list[0]); };
    return {impl_->slot.size(), impl_->bvh.nodes.size(),
            bytes(impl_->bvh.nodes) + bytes(impl_->bvh.triangles) + bytes(impl_->slot) + bytes(impl_->faces) +
                bytes(impl_->face_index) + bytes(impl_->surfaces),
            impl_->bvh.depth};
}

}  // namespace slipface
