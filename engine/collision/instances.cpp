#include "slipface/collision/instances.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "instance_list.h"

namespace slipface {

using namespace detail;

CollisionMesh::CollisionMesh() : impl_(std::make_unique<Impl>()) {}
CollisionMesh::~CollisionMesh() = default;

Result<std::shared_ptr<const CollisionMesh>> CollisionMesh::build(const TriangleSoup& soup) {
    Result<CollisionWorld> world =
        CollisionWorld::build({soup.positions, soup.triangles, soup.faces}, {}, LeafForm::vertices);
    if (!world) return world.error();
    std::shared_ptr<CollisionMesh> mesh(new CollisionMesh);
    mesh->impl_->world = std::move(*world);
    const CollisionWorld::Impl& impl = mesh->impl_->world.impl();
    if (!impl.faces.empty() || !impl.face_index.ascending())
        return Error{"collision soup", "faces that are not 0, 1, 2, ... in ascending order"};
    return std::shared_ptr<const CollisionMesh>(std::move(mesh));
}

std::size_t CollisionMesh::triangle_count() const {
    return impl_->world.triangle_count();
}
std::size_t CollisionMesh::face_count() const {
    return impl_->world.impl().surfaces.size();
}
std::size_t CollisionMesh::bytes() const {
    return impl_->world.statistics().bytes;
}

namespace {

using Impl = CollisionWorld::Impl;

const Impl& impl_of(const CollisionMesh& mesh) {
    return mesh.impl().world.impl();
}

Status check(const Instance& instance, FaceId least_face, const std::string& location) {
    if (!instance.mesh) return Error{location, "has no mesh"};
    if (instance.mesh->triangle_count() == 0) return Error{location, "its mesh has no triangles"};
    if (instance.first_face < least_face)
        return Error{location, "its faces are not above those before: face " +
                                   std::to_string(instance.first_face) + "; expected at least " +
                                   std::to_string(least_face)};
    if (instance.mesh->face_count() > no_id - 1 - std::size_t{instance.first_face})
        return Error{location, "has too many faces"};
    if (instance.surfaces && instance.surfaces->size() != instance.mesh->face_count())
        return Error{location, "has types of " + std::to_string(instance.surfaces->size()) +
                                   " faces; expected " + std::to_string(instance.mesh->face_count())};
    return {};
}

bool invert(const Placement& placement, InstanceView& view) {
    const auto& [x, y, z] = placement.columns;
    const Vec3 rows[3] = {y.cross(z), z.cross(x), x.cross(y)};
    const double determinant = x.dot(rows[0]);
    bool finite = std::isfinite(determinant) && determinant != 0.0;
    double norm2 = 0.0;
    for (int i = 0; i < 3; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const double one = rows[i][axis] / determinant;
            view.inverse[i][axis] = one;
            norm2 += one * one;
            finite = finite && std::isfinite(one);
        }
    }
    // Along the axes of the mesh if these stay at right angles, else the bound that holds for every map.
    const double longest = std::max({x.squaredNorm(), y.squaredNorm(), z.squaredNorm()});
    const double skew = std::max({std::fabs(x.dot(y)), std::fabs(y.dot(z)), std::fabs(z.dot(x))});
    const double shortest = std::min({x.norm(), y.norm(), z.norm()});
    view.least_scale = skew <= 1e-9 * shortest * shortest ? shortest * (1.0 - 1e-6) : 1.0 / std::sqrt(norm2);
    return finite && std::isfinite(longest) && view.least_scale > 0.0 && placement.offset.allFinite();
}

// The box of the placed corners, exactly; false if one of them is not finite.
bool box_of(const Bvh& bvh, const Placement& placement, std::array<Vec3f, 2>& box) {
    box = {Vec3f::Constant(std::numeric_limits<float>::infinity()),
           Vec3f::Constant(-std::numeric_limits<float>::infinity())};
    bool finite = true;
    for (const BvhNode& node : bvh.nodes) {
        for (std::size_t k = 0; k < 8; ++k) {
            if (is_missing(node, k) || (node.child[k] & leaf_bit) == 0) continue;
            const Leaf& leaf = bvh.leaf_at(node.child[k] & leaf_index_mask);
            const float* at = leaf_values(leaf);
            const std::size_t vertices = leaf.values[0];
            for (std::size_t i = 0; i < vertices; ++i) {
                const Vec3f placed = placement.apply({at[i], at[i + vertices], at[i + 2 * vertices]});
                finite = finite && placed.allFinite();
                box[0] = box[0].cwiseMin(placed);
                box[1] = box[1].cwiseMax(placed);
            }
        }
    }
    return finite;
}

}  // namespace

LeafTriangle place_triangle(const InstanceView& in, const LeafTriangle& rest) {
    LeafTriangle placed{};
    for (int axis = 0; axis < 3; ++axis) {
        for (int k = 0; k < 3; ++k) {
            const int to = in.mirrors && k > 0 ? 3 - k : k;
            placed.at[axis][to] = static_cast<float>(
                in.linear[0][axis] * double{rest.at[0][k]} + in.linear[1][axis] * double{rest.at[1][k]} +
                in.linear[2][axis] * double{rest.at[2][k]} + in.offset[axis]);
        }
    }
    placed.id = in.first + rest.id;
    return placed;
}

namespace {

// How queries see an instance, and its box. False: its placement is not finite or flattens the mesh.
bool look_at(const Instance& instance, InstanceView& view, std::array<Vec3f, 2>& box) {
    const Impl& mesh = impl_of(*instance.mesh);
    view.tree = mesh.bvh.view();
    view.mirrors = instance.placement.mirrors();
    if (!invert(instance.placement, view) || !box_of(mesh.bvh, instance.placement, box)) return false;
    double reach = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        double most = std::fabs(instance.placement.offset[axis]);
        for (int column = 0; column < 3; ++column) {
            view.linear[column][axis] = instance.placement.columns[static_cast<std::size_t>(column)][axis];
            most += std::fabs(view.linear[column][axis]) * mesh.extent.reach;
        }
        view.offset[axis] = instance.placement.offset[axis];
        reach = std::max(reach, most);
    }
    view.slack = 0x1p-23 * reach + 1e-37;
    return true;
}

bool stands_there(const InstanceView& view, const Placement& placement) {
    for (int axis = 0; axis < 3; ++axis) {
        if (view.offset[axis] != placement.offset[axis]) return false;
        for (int column = 0; column < 3; ++column)
            if (view.linear[column][axis] != placement.columns[static_cast<std::size_t>(column)][axis])
                return false;
    }
    return true;
}

}  // namespace

Status replace_instances(Impl& impl, std::span<const Instance> instances) {
    std::vector<InstanceView> views;
    std::vector<PlacedMesh> placed;
    std::vector<Vec3f> corners;
    std::vector<std::array<std::uint32_t, 3>> boxes;
    views.reserve(instances.size());
    placed.reserve(instances.size());
    std::map<const CollisionMesh*, std::shared_ptr<const std::vector<SurfaceId>>> defaults;
    std::size_t triangles = impl.own_triangles();
    FaceId least_face =
        impl.faces.empty() ? static_cast<FaceId>(impl.surfaces.size()) : impl.faces.back() + 1;
    std::size_t next = 0;  // that which is probably the same instance among those before
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const Instance& instance = instances[i];
        const std::string location = "instance " + std::to_string(i);
        if (Status status = check(instance, least_face, location); !status) return status;
        if (triangles + instance.mesh->triangle_count() >= no_id)
            return Error{location, "its triangles are more than there are numbers"};
        const auto was = [&](std::size_t k) {
            return k < impl.placed.size() && impl.placed[k].mesh == instance.mesh &&
                   stands_there(impl.views[k], instance.placement);
        };
        // One may have gone, or come.
        if (!was(next)) next = was(next + 1) ? next + 1 : next > 0 && was(next - 1) ? next - 1 : next;
        InstanceView view{};
        std::array<Vec3f, 2> box;
        if (was(next)) {
            view = impl.views[next];
            box = impl.placed[next].box;
        } else if (!look_at(instance, view, box)) {
            return Error{location, "its placement is not finite or flattens the mesh"};
        }
        ++next;
        view.first = static_cast<std::uint32_t>(triangles);
        std::shared_ptr<const std::vector<SurfaceId>> surfaces = instance.surfaces;
        if (!surfaces) {
            auto& shared = defaults[instance.mesh.get()];
            if (!shared) shared = std::make_shared<std::vector<SurfaceId>>(instance.mesh->face_count());
            surfaces = shared;
        }
        views.push_back(view);
        placed.push_back({instance.mesh, instance.first_face, std::move(surfaces), box});
        triangles += instance.mesh->triangle_count();
        least_face = instance.first_face + static_cast<FaceId>(instance.mesh->face_count());
        const auto first = static_cast<std::uint32_t>(corners.size());
        corners.insert(corners.end(), box.begin(), box.end());
        boxes.push_back({first, first + 1, first + 1});
    }
    impl.boxes = build_bvh(corners, boxes, {}, LeafForm::any);
    impl.views = std::move(views);
    impl.placed = std::move(placed);
    impl.triangles = triangles;
    return {};
}

namespace {

// The instance with that face, or nothing.
std::optional<std::size_t> instance_with(const Impl& impl, FaceId face) {
    const auto after = std::ranges::upper_bound(impl.placed, face, {}, &PlacedMesh::first_face);
    if (after == impl.placed.begin()) return std::nullopt;
    const auto i = static_cast<std::size_t>(after - impl.placed.begin() - 1);
    if (face - impl.placed[i].first_face >= impl.placed[i].surfaces->size()) return std::nullopt;
    return i;
}

}  // namespace

void set_instance_surface(Impl& impl, FaceId face, SurfaceId surface) {
    const std::optional<std::size_t> i = instance_with(impl, face);
    if (!i) return;
    PlacedMesh& placed = impl.placed[*i];
    const std::size_t index = face - placed.first_face;
    if ((*placed.surfaces)[index] == surface) return;
    auto own = placed.surfaces.use_count() == 1
                   ? std::const_pointer_cast<std::vector<SurfaceId>>(placed.surfaces)
                   : std::make_shared<std::vector<SurfaceId>>(*placed.surfaces);
    (*own)[index] = surface;
    placed.surfaces = std::move(own);
}

SurfaceId instance_surface(const Impl& impl, FaceId face) {
    const std::optional<std::size_t> i = instance_with(impl, face);
    return i ? (*impl.placed[*i].surfaces)[face - impl.placed[*i].first_face] : default_surface;
}

void set_instance_surfaces(Impl& impl, std::span<const SurfaceId> surfaces) {
    using List = std::vector<SurfaceId>;
    std::map<std::pair<const CollisionMesh*, List>, std::shared_ptr<List>> known;
    for (PlacedMesh& placed : impl.placed) {
        List list = *placed.surfaces;
        for (std::size_t i = 0; i < list.size() && placed.first_face + i < surfaces.size(); ++i)
            list[i] = surfaces[placed.first_face + i];
        auto& shared = known[{placed.mesh.get(), list}];
        if (!shared) shared = std::make_shared<List>(std::move(list));
        placed.surfaces = shared;
    }
}

std::size_t bytes_of_meshes(const Impl& impl) {
    std::set<const void*> known;
    std::size_t bytes = 0;
    for (const PlacedMesh& placed : impl.placed) {
        if (known.insert(placed.mesh.get()).second) bytes += placed.mesh->bytes();
        if (known.insert(placed.surfaces.get()).second) bytes += placed.surfaces->size();
    }
    return bytes;
}

}  // namespace slipface
