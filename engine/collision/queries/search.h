// The state of a sweep.
#pragma once

#include "impl.h"
#include "simd/kernels.h"

namespace slipface::detail {

// At the ends of double's range, sphere space can overflow. A triangle without a valid touch must not hide
// one that has.
inline bool well_formed(const Touch& touch) {
    return finite(touch.point) && dot(touch.normal, touch.normal) > 0.0;
}

// A sweep in progress: the first touch so far.
struct Search {
    const CollisionWorld::Impl& world;
    const EllipsoidQuery& query;
    bool solid = true;      // what counts is solid; else what is not
    bool in_floats = true;  // the query is in float range, where every touch is finite
    TriangleHit hit{1.0, Feature::vertex, 0, false};
    LeafTriangle triangle = no_triangle();
    const Kernels& kernels = detail::kernels();

    // As an aggregate it would be filled with zeros first.
    Search(const CollisionWorld::Impl& of, const EllipsoidQuery& along) : world(of), query(along) {}

    bool beaten_by(const TriangleHit& other, TriangleId id) const {
        if (triangle.id == no_id || other.t != hit.t) return triangle.id == no_id || other.t < hit.t;
        if (other.feature != hit.feature) return other.feature < hit.feature;
        return id < triangle.id;
    }
    void consider(const LeafTriangle& leaf) {
        TriangleHit other{};
        if (!kernels.sweep_triangle(leaf, query, hit.t, other) || !beaten_by(other, leaf.id)) return;
        if (!stopped_by(leaf, other)) return;
        hit = {other.t, other.feature, other.part, other.started};
        triangle = leaf;
    }
    bool stopped_by(const LeafTriangle& leaf, const TriangleHit& other) const {
        if (!world.plain || !solid) {
            const SurfaceRule& rule = world.rule_of(leaf.id);
            if (rule.solid != solid || (rule.one_sided && kernels.passes_one_sided(leaf, query, other)))
                return false;
        }
        return in_floats || well_formed(kernels.touch_of_hit(leaf, query, other));
    }

    Contact contact_of(const LeafTriangle& leaf, const TriangleHit& of) const {
        const Touch touch = kernels.touch_of_hit(leaf, query, of);
        return {of.t,      vec(touch.normal),      vec(touch.point),
                leaf.id,   world.face_of(leaf.id), world.surface_of(leaf.id),
                of.feature};
    }
    double limit() const { return hit.t; }
    std::optional<Contact> contact() const {
        return triangle.id == no_id ? std::nullopt : std::optional(contact_of(triangle, hit));
    }
};

// True if a query out of float range is invalid and has no result.
inline bool refused(const V3& radii, const V3& from, const V3& move) {
    return !(radii.x > 0.0 && radii.y > 0.0 && radii.z > 0.0) || !finite(radii) || !finite(from) ||
           !finite(move);
}

}  // namespace slipface::detail
