#include "queries/near.h"
#include "queries/search.h"
#include "queries/sight.h"
#include "slipface/collision/filter.h"

namespace slipface {
namespace {

using namespace detail;

// Calls decide(query, triangle) for the triangles that the ellipsoid at rest may overlap, until it returns
// false.
template <class Visit>
void visit_near(const Sight& sight, const Vec3& radii, const Vec3& centre, Visit decide) {
    const CollisionWorld::Impl& world = sight.world;
    if (world.empty()) return;
    EllipsoidQuery query;
    SweepPath path;
    const Prepared prepared =
        kernels().prepare_sweep(*sight.extent, v3(radii), v3(centre), V3{0.0, 0.0, 0.0}, query, path);
    if (prepared == Prepared::beside) return;
    auto visit = [&](const LeafTriangle& leaf) { return decide(query, leaf); };
    if (prepared == Prepared::in_floats && sight.has_tree) {
        using Bound = decltype(visit);
        const auto consider = [](void* context, const Leaf& leaf, std::uint32_t lane) {
            return (*static_cast<Bound*>(context))(leaf_triangle(leaf, lane)) ? 1.0F : -1.0F;
        };
        kernels().sweep(sight.view, query, path, 1.0F, consider, &visit);
        return;
    }
    if (refused(v3(radii), v3(centre), V3{0.0, 0.0, 0.0})) return;
    for (TriangleId id = 0; id < world.triangle_count(); ++id) {
        if (!visit(sight.triangle(id))) return;
    }
}

// The rule of sweeps: a triangle that is not solid, or one-sided and seen from behind, is ignored.
bool stands(const CollisionWorld::Impl& world, const EllipsoidQuery& query, const LeafTriangle& leaf,
            bool solid) {
    const SurfaceRule& rule = world.rule_of(leaf.id);
    return rule.solid == solid && !(rule.one_sided && kernels().is_behind(leaf, query));
}

// Collects the triangles that the ellipsoid overlaps, offered in any order.
class Overlaps {
  public:
    Overlaps(const CollisionWorld::Impl& world, std::span<Overlap> out, bool solid = true)
        : world_(world), out_(out), solid_(solid) {}

    void consider(const EllipsoidQuery& query, const LeafTriangle& leaf) {
        const Nearest nearest = kernels().nearest_part(leaf, query);
        if (!(nearest.distance2 < 1.0) || !stands(world_, query, leaf, solid_)) return;
        ++found_;
        // `out` is a heap with the highest triangle on top, so that the lowest ones stay, whatever the
        // visiting order.
        if (stored_ == out_.size()) {
            if (stored_ == 0 || leaf.id > out_[0].triangle) return;
            std::ranges::pop_heap(out_.first(stored_--), {}, &Overlap::triangle);
        }
        const Touch touch = kernels().touch_of_nearest(leaf, query, nearest);
        out_[stored_++] = {
            leaf.id,          world_.face_of(leaf.id), world_.surface_of(leaf.id),        nearest.feature,
            vec(touch.point), vec(touch.normal),       1.0 - std::sqrt(nearest.distance2)};
        std::ranges::push_heap(out_.first(stored_), {}, &Overlap::triangle);
    }
    std::size_t finish() {
        std::ranges::sort_heap(out_.first(stored_), {}, &Overlap::triangle);
        return found_;
    }

  private:
    const CollisionWorld::Impl& world_;
    std::span<Overlap> out_;
    bool solid_;
    std::size_t found_ = 0;
    std::size_t stored_ = 0;
};

bool overlaps(const CollisionWorld::Impl& world, const EllipsoidQuery& query, const LeafTriangle& leaf,
              bool solid = true) {
    return kernels().nearest_part(leaf, query).distance2 < 1.0 && stands(world, query, leaf, solid);
}

}  // namespace

std::size_t find_overlaps(const CollisionWorld& world, const Vec3& radii, const Vec3& centre,
                          std::span<Overlap> out) {
    Overlaps found(world.impl(), out);
    visit_near(Sight(world.impl()), radii, centre,
               [&](const EllipsoidQuery& query, const LeafTriangle& leaf) {
                   found.consider(query, leaf);
                   return true;
               });
    return found.finish();
}

std::size_t find_overlaps(const CollisionWorld& world, const Vec3& radii, const Vec3& centre,
                          std::span<Overlap> out, const QueryFilter& filter) {
    Overlaps found(world.impl(), out, filter.solid);
    visit_near(Sight(world.impl()), radii, centre,
               [&](const EllipsoidQuery& query, const LeafTriangle& leaf) {
                   if (filter.sees(leaf.id, world.impl().surface_of(leaf.id))) found.consider(query, leaf);
                   return true;
               });
    return found.finish();
}

bool overlaps_any(const CollisionWorld& world, const Vec3& radii, const Vec3& centre) {
    bool found = false;
    visit_near(Sight(world.impl()), radii, centre,
               [&](const EllipsoidQuery& query, const LeafTriangle& leaf) {
                   found = overlaps(world.impl(), query, leaf);
                   return !found;
               });
    return found;
}

bool overlaps_any(const CollisionWorld& world, const Vec3& radii, const Vec3& centre,
                  const QueryFilter& filter) {
    bool found = false;
    visit_near(Sight(world.impl()), radii, centre,
               [&](const EllipsoidQuery& query, const LeafTriangle& leaf) {
                   found = filter.sees(leaf.id, world.impl().surface_of(leaf.id)) &&
                           overlaps(world.impl(), query, leaf, filter.solid);
                   return !found;
               });
    return found;
}

std::size_t find_overlaps(const PosedWorld& world, const Vec3& radii, const Vec3& centre,
                          std::span<Overlap> out, const QueryFilter& filter) {
    const PosedSight sight(world);
    Overlaps found(sight.world, out, filter.solid);
    visit_near(sight, radii, centre - world.origin(),
               [&](const EllipsoidQuery& query, const LeafTriangle& leaf) {
                   if (filter.sees(leaf.id, sight.world.surface_of(leaf.id))) found.consider(query, leaf);
                   return true;
               });
    const std::size_t count = found.finish();
    for (Overlap& overlap : out.first(std::min(count, out.size())))
        overlap.point += world.origin();
    return count;
}

bool overlaps_any(const PosedWorld& world, const Vec3& radii, const Vec3& centre, const QueryFilter& filter) {
    const PosedSight sight(world);
    bool found = false;
    visit_near(sight, radii, centre - world.origin(),
               [&](const EllipsoidQuery& query, const LeafTriangle& leaf) {
                   found = filter.sees(leaf.id, sight.world.surface_of(leaf.id)) &&
                           overlaps(sight.world, query, leaf, filter.solid);
                   return !found;
               });
    return found;
}

std::size_t find_overlaps(const Neighbourhood& near, const Vec3& radii, const Vec3& centre,
                          std::span<Overlap> out) {
    NearCandidates candidates(near, radii, centre);
    if (candidates.lead_out())
        return near.filter() == nullptr ? find_overlaps(near.world(), radii, centre, out)
                                        : find_overlaps(near.world(), radii, centre, out, *near.filter());
    Overlaps found(near.world().impl(), out);
    for (; const NearCandidate* next = candidates.take();)
        found.consider(candidates.query(), near_triangle(near.triangles(), next->index));
    return found.finish();
}

bool overlaps_any(const Neighbourhood& near, const Vec3& radii, const Vec3& centre) {
    if (near.triangles().clear > 0.0F && is_built_for(near.triangles(), radii, centre)) return false;
    NearCandidates candidates(near, radii, centre);
    if (candidates.lead_out())
        return near.filter() == nullptr ? overlaps_any(near.world(), radii, centre)
                                        : overlaps_any(near.world(), radii, centre, *near.filter());
    for (; const NearCandidate* next = candidates.take();) {
        if (overlaps(near.world().impl(), candidates.query(), near_triangle(near.triangles(), next->index)))
            return true;
    }
    return false;
}

namespace {

bool touches(const Aabb& box, int axis, float low, float high) {
    return double{low} <= box.max[axis] && double{high} >= box.min[axis];
}

// Calls visit(leaf) for the leaves whose boxes touch `box`.
template <class Visit>
void visit_leaves(const TreeView& tree, const Aabb& box, Visit visit) {
    if (tree.nodes == nullptr) return;
    std::array<std::uint32_t, traversal_stack> open;
    std::size_t count = 0;
    open[count++] = 0;
    while (count > 0) {
        const BvhNode& node = tree.nodes[open[--count]];
        for (int k = 0; k < 8; ++k) {
            bool hit = node.bound[0][k] <= node.bound[3][k];
            for (int axis = 0; axis < 3; ++axis)
                hit = hit && touches(box, axis, node.bound[axis][k], node.bound[axis + 3][k]);
            if (!hit) continue;
            if ((node.child[k] & leaf_bit) == 0) {
                open[count++] = node.child[k];
            } else {
                const std::size_t leaf = node.child[k] & leaf_index_mask;
                visit(*reinterpret_cast<const Leaf*>(tree.leaves + leaf * leaf_alignment));
            }
        }
    }
}

// The box in the space of the mesh that holds all of `box`.
Aabb in_mesh(const InstanceView& view, const Aabb& box) {
    const Vec3 middle = 0.5 * (box.min + box.max);
    const Vec3 half = 0.5 * (box.max - box.min).array() + view.slack;
    Vec3 centre = Vec3::Zero(), reach = Vec3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
        for (int of = 0; of < 3; ++of) {
            centre[axis] += view.inverse[axis][of] * (middle[of] - view.offset[of]);
            reach[axis] += std::abs(view.inverse[axis][of]) * half[of];
        }
    }
    return {centre - reach, centre + reach};
}

}  // namespace

std::vector<TriangleId> CollisionWorld::triangles_in(const Aabb& box) const {
    std::vector<TriangleId> found;
    const auto test = [&](const LeafTriangle& triangle) {
        bool hit = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto& at = triangle.at[axis];
            const auto [low, high] = std::minmax({at[0], at[1], at[2]});
            hit = hit && touches(box, static_cast<int>(axis), low, high);
        }
        if (hit) found.push_back(triangle.id);
    };
    visit_leaves(impl_->bvh.view(), box, [&](const Leaf& leaf) {
        for (std::size_t lane = 0; lane < leaf_size(leaf); ++lane)
            test(leaf_triangle(leaf, lane));
    });
    // Of an instance every triangle is tested if its box touches.
    for (std::size_t i = 0; i < impl_->views.size(); ++i) {
        const LeafTriangle bounds = impl_->boxes.triangle(static_cast<TriangleId>(i));
        bool hit = true;
        for (int axis = 0; axis < 3; ++axis)
            hit = hit && touches(box, axis, bounds.at[axis][0], bounds.at[axis][1]);
        const InstanceView& view = impl_->views[i];
        for (TriangleId t = 0; hit && t < impl_->placed[i].mesh->triangle_count(); ++t)
            test(impl_->triangle(view.first + t));
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::size_t CollisionWorld::crowd_in(const Aabb& box) const {
    const Aabb inside{box.min.cwiseMax(impl_->bounds.min), box.max.cwiseMin(impl_->bounds.max)};
    if ((inside.min.array() > inside.max.array()).any()) return 0;
    std::size_t count = 0;
    const auto add = [&](const Leaf& leaf) { count += leaf_size(leaf); };
    visit_leaves(impl_->bvh.view(), inside, add);
    visit_leaves(impl_->boxes.view(), inside, [&](const Leaf& boxes) {
        for (std::size_t lane = 0; lane < leaf_size(boxes); ++lane) {
            const InstanceView& view = impl_->views[leaf_id(boxes, lane)];
            visit_leaves(view.tree, in_mesh(view, inside), add);
        }
    });
    return count;
}

}  // namespace slipface
