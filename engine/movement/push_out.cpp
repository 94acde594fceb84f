// A player who is inside geometry, by a bad spawn point or a moved wall, is put outside before the step.
//
// Analytic (lecture, "Analytic solution for acute angles"): the planes of the triangles whose interior is
// overlapped, each moved out by the ellipsoid's extent along its normal plus the skin; the player goes to the
// nearest point of their common plane, line or point. Iterative: out of the deepest triangle, again and
// again; slow in acute corners, but knows edges and vertices, which is why what the analytic answer leaves is
// given to it.
//
// With the centre as origin the line of two planes, C + t D, has C = (nA (dA - dB k) + nB (dB - dA k)) / (1 -
// k k), and C is its point nearest to the centre already, because C is a combination of nA and nB and D is
// perpendicular to both.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

using Overlaps = std::array<Overlap, 64>;

struct Plane {
    Vec3 normal;
    double distance;  // how far the centre has to move along the normal
};

constexpr double parallel = 1e-8;  // square of the sine between two planes that count as one

std::size_t overlaps_at(const Mover& mover, const Vec3& centre, Overlaps& found) {
    return std::min(find_overlaps(mover.scene.collision, mover.settings.radii, centre, found), found.size());
}

Plane plane_of(const Mover& mover, const Vec3& centre, const Overlap& overlap) {
    const double extent = mover.settings.radii.cwiseProduct(overlap.normal).norm();
    return {.normal = overlap.normal,
            .distance = extent + mover.settings.skin - overlap.normal.dot(centre - overlap.point)};
}

// The planes of the overlapped interiors, deepest first, coplanar and nearly parallel ones once, three at
// most.
int planes_at(const Mover& mover, const Vec3& centre, const Overlaps& found, std::size_t count,
              std::array<Plane, 3>& planes) {
    std::array<Plane, 64> candidates;
    std::size_t interior = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (found[i].feature == Feature::interior) candidates[interior++] = plane_of(mover, centre, found[i]);
    }
    std::stable_sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(interior),
                     [](const Plane& a, const Plane& b) { return a.distance > b.distance; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < interior && kept < planes.size(); ++i) {
        const bool fresh = std::none_of(
            planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(kept),
            [&](const Plane& p) { return p.normal.cross(candidates[i].normal).squaredNorm() < parallel; });
        if (fresh) planes[kept++] = candidates[i];
    }
    return static_cast<int>(kept);
}

Vec3 shift_out_of(const std::array<Plane, 3>& planes, int count) {
    const auto& [a, b, c] = planes;
    if (count == 3) {
        const Vec3 bc = b.normal.cross(c.normal);
        const double volume = a.normal.dot(bc);
        if (volume * volume > parallel) {
            return (a.distance * bc + b.distance * c.normal.cross(a.normal) +
                    c.distance * a.normal.cross(b.normal)) /
                   volume;
        }
    }
    if (count >= 2) {
        const double k = a.normal.dot(b.normal);
        return (a.normal * (a.distance - b.distance * k) + b.normal * (b.distance - a.distance * k)) /
               (1.0 - k * k);
    }
    return a.normal * a.distance;
}

Vec3 iterate_out(const Mover& mover, Vec3 centre, Overlaps& found, std::size_t& count) {
    constexpr int rounds = 32;
    for (int round = 0; round < rounds && count > 0; ++round) {
        const Overlap& deepest = *std::max_element(
            found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Overlap& a, const Overlap& b) { return a.depth_sphere_space < b.depth_sphere_space; });
        const Vec3& radii = mover.settings.radii;
        const Vec3 sphere_normal = direction_of(deepest.normal.cwiseProduct(radii));
        centre += radii.cwiseProduct(sphere_normal) * deepest.depth_sphere_space +
                  deepest.normal * mover.settings.skin;
        count = overlaps_at(mover, centre, found);
    }
    return centre;
}

// The centre itself may not change sides of anything solid.
bool crosses_nothing(const Mover& mover, const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    return way.isZero(0.0) || !cast_ray(mover.scene.collision, from, way, 1.0);
}

}  // namespace

void push_out(Mover& mover) {
    if (mover.settings.push_out == PushOut::off) return;
    Overlaps found;
    std::size_t count = overlaps_at(mover, mover.position, found);
    if (count == 0) return;

    Vec3 centre = mover.position;
    int planes = static_cast<int>(count);
    if (mover.settings.push_out == PushOut::analytic) {
        std::array<Plane, 3> chosen;
        planes = planes_at(mover, centre, found, count, chosen);
        if (planes > 0) {
            centre += shift_out_of(chosen, planes);
            count = overlaps_at(mover, centre, found);
        }
    }
    centre = iterate_out(mover, centre, found, count);
    const bool free = count == 0 && crosses_nothing(mover, mover.position, centre);
    if (mover.trace != nullptr) {
        mover.trace->add(PushOutRecord{.from = mover.position, .to = centre, .planes = planes, .free = free});
    }
    if (free) mover.position = centre;
}

}  // namespace slipface
