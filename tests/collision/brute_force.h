// The answer of a world, put together from worlds of one triangle each by the rules that collision_world.h
// states.
#pragma once

#include "scenes.h"

namespace slipface::scenes {

class BruteForce {
  public:
    explicit BruteForce(const Soup& soup) {
        for (std::size_t i = 0; i < soup.triangles.size(); ++i)
            singles_.push_back(soup.single(i));
    }

    std::optional<Contact> sweep(const Vec3& radii, const Vec3& from, const Vec3& move) const {
        std::optional<Contact> best;
        for (std::size_t i = 0; i < singles_.size(); ++i) {
            auto contact = sweep_ellipsoid(singles_[i], radii, from, move);
            if (!contact) continue;
            contact->triangle = static_cast<TriangleId>(i);
            if (!best || contact->t < best->t ||
                (contact->t == best->t && contact->feature < best->feature)) {
                best = contact;
            }
        }
        return best;
    }
    std::optional<RayHit> ray(const Vec3& origin, const Vec3& direction, double max_t) const {
        std::optional<RayHit> best;
        for (std::size_t i = 0; i < singles_.size(); ++i) {
            auto hit = cast_ray(singles_[i], origin, direction, max_t);
            if (!hit) continue;
            hit->triangle = static_cast<TriangleId>(i);
            if (!best || hit->t < best->t) best = hit;
        }
        return best;
    }
    std::optional<ClosestPoint> closest(const Vec3& point, double max_distance) const {
        std::optional<ClosestPoint> best;
        for (std::size_t i = 0; i < singles_.size(); ++i) {
            auto found = closest_point(singles_[i], point, max_distance);
            if (!found) continue;
            found->triangle = static_cast<TriangleId>(i);
            if (!best || found->distance < best->distance) best = found;
        }
        return best;
    }
    std::vector<Overlap> overlaps(const Vec3& radii, const Vec3& centre) const {
        std::vector<Overlap> all;
        for (std::size_t i = 0; i < singles_.size(); ++i) {
            Overlap overlap;
            if (find_overlaps(singles_[i], radii, centre, {&overlap, 1}) == 0) continue;
            overlap.triangle = static_cast<TriangleId>(i);
            all.push_back(overlap);
        }
        return all;
    }

  private:
    std::vector<CollisionWorld> singles_;
};

// Bit for bit.
inline bool same(const std::optional<Contact>& a, const std::optional<Contact>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return a->t == b->t && a->normal == b->normal && a->point == b->point && a->triangle == b->triangle &&
           a->face == b->face && a->feature == b->feature;
}
inline bool same(const std::optional<RayHit>& a, const std::optional<RayHit>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return a->t == b->t && a->normal == b->normal && a->point == b->point && a->triangle == b->triangle &&
           a->face == b->face && a->back_face == b->back_face;
}
inline bool same(const std::optional<ClosestPoint>& a, const std::optional<ClosestPoint>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return a->distance == b->distance && a->point == b->point && a->triangle == b->triangle &&
           a->face == b->face;
}
inline bool same(const Overlap& a, const Overlap& b) {
    return a.triangle == b.triangle && a.face == b.face && a.feature == b.feature && a.point == b.point &&
           a.normal == b.normal && a.depth_sphere_space == b.depth_sphere_space;
}

}  // namespace slipface::scenes
