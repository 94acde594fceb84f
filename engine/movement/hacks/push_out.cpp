// A player inside geometry, because of a bad spawn or a moved wall, is put outside before the step.
//
// Analytic (lecture, "Analytic solution for acute angles"): takes the planes of the triangles whose interior
// is overlapped, moves each outwards by the ellipsoid's extent along its normal plus the skin, and puts the
// player at the nearest point outside all of them. Iterative: moves the player out of the deepest plane,
// again and again. Edges and corners are not planes; both leave them one by one at the end.
//
// With the centre as origin the line of two planes, C + t D, has C = (nA (dA - dB k) + nB (dB - dA k)) / (1 -
// k k). C is its point nearest to the centre, because C is a combination of nA and nB, and D is perpendicular
// to both.
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
    return overlaps_in_scene(mover, centre, found);
}

// How far the player has to go from `start` out of the overlapped face, on the side on which it began.
Plane plane_of(const Mover& mover, const Vec3& start, const Overlap& overlap) {
    const Vec3 normal =
        overlap.normal.dot(start - overlap.point) < 0.0 ? Vec3(-overlap.normal) : overlap.normal;
    const double extent = mover.settings.radii.cwiseProduct(normal).norm();
    return {.normal = normal, .distance = extent + mover.settings.skin - normal.dot(start - overlap.point)};
}

// The planes of the overlapped interiors, coplanar ones once, as seen from where the player began.
struct Planes {
    static constexpr std::size_t capacity = 8;
    std::array<Plane, capacity> plane;
    std::size_t count = 0;
};

void add_planes(const Mover& mover, const Vec3& start, const Overlaps& found, std::size_t count,
                Planes& planes) {
    std::array<Plane, 64> candidates;
    std::size_t interior = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (found[i].feature == Feature::interior) candidates[interior++] = plane_of(mover, start, found[i]);
    }
    // Deepest first, because only the first ones are stored. std::stable_sort would allocate memory.
    const auto deeper = [](const Plane& a, const Plane& b) { return a.distance > b.distance; };
    for (auto end = candidates.begin(); end != candidates.begin() + static_cast<std::ptrdiff_t>(interior);
         ++end)
        std::rotate(std::upper_bound(candidates.begin(), end, *end, deeper), end, end + 1);
    for (std::size_t i = 0; i < interior && planes.count < Planes::capacity; ++i) {
        const Vec3& normal = candidates[i].normal;
        const auto end = planes.plane.begin() + static_cast<std::ptrdiff_t>(planes.count);
        const bool known = std::any_of(planes.plane.begin(), end, [&](const Plane& p) {
            return p.normal.dot(normal) > 0.0 && p.normal.cross(normal).squaredNorm() < parallel &&
                   p.distance >= candidates[i].distance - mover.settings.skin;
        });
        if (!known) planes.plane[planes.count++] = candidates[i];
    }
}

// The point of both planes, or of all three, nearest to the centre; nothing for parallel ones.
std::optional<Vec3> crease(const Plane& a, const Plane& b) {
    const double k = a.normal.dot(b.normal);
    const double square = 1.0 - k * k;
    if (!(square > parallel)) return std::nullopt;
    return Vec3((a.normal * (a.distance - b.distance * k) + b.normal * (b.distance - a.distance * k)) /
                square);
}
std::optional<Vec3> corner(const Plane& a, const Plane& b, const Plane& c) {
    const Vec3 bc = b.normal.cross(c.normal);
    const double volume = a.normal.dot(bc);
    if (!(volume * volume > parallel)) return std::nullopt;
    return Vec3(
        (a.distance * bc + b.distance * c.normal.cross(a.normal) + c.distance * a.normal.cross(b.normal)) /
        volume);
}

// The shortest displacement out of all planes. It ends on one plane, on the line of two, or in the point of
// three: the shortest of those that satisfy all planes. Where none does (the two sides of a slab), out of the
// deepest plane alone.
Vec3 shift_out_of(const Planes& planes) {
    std::optional<Vec3> best;
    const auto consider = [&](const std::optional<Vec3>& shift) {
        if (!shift || (best && !(shift->squaredNorm() < best->squaredNorm()))) return;
        for (std::size_t i = 0; i < planes.count; ++i) {
            const Plane& p = planes.plane[i];
            if (p.normal.dot(*shift) < p.distance - 1e-9 * (1.0 + p.distance)) return;
        }
        best = shift;
    };
    const auto& p = planes.plane;
    for (std::size_t i = 0; i < planes.count; ++i) {
        consider(Vec3(p[i].normal * p[i].distance));
        for (std::size_t j = i + 1; j < planes.count; ++j) {
            consider(crease(p[i], p[j]));
            for (std::size_t k = j + 1; k < planes.count; ++k)
                consider(corner(p[i], p[j], p[k]));
        }
    }
    return best ? *best : Vec3(p[0].normal * p[0].distance);
}

// Out of the plane that is overlapped deepest, again and again, each from the side on which the player began.
// Between two faces of an acute wedge the steps shrink by the square of the cosine between them, which takes
// thousands of rounds at 5 degrees. So every fifth round adds the rest of the geometric series at once
// (Aitken's extrapolation). Between three faces of an acute corner the steps are not such a series: a player
// that is still inside after half of the rounds is put into the common point of the last three planes.
Vec3 iterate_out_of(const Planes& planes) {
    constexpr int rounds = 200;
    constexpr int leap = 5;
    Vec3 shift = Vec3::Zero();
    std::array<Vec3, leap> last;
    std::array<std::size_t, 3> latest{};  // planes, the last one first; no two alike where there were three
    for (int round = 0; round < rounds; ++round) {
        const Plane* worst = nullptr;
        double missing = 1e-9;
        for (std::size_t i = 0; i < planes.count; ++i) {
            const double left = planes.plane[i].distance - planes.plane[i].normal.dot(shift);
            if (left > missing) {
                missing = left;
                worst = &planes.plane[i];
            }
        }
        if (worst == nullptr) return shift;
        shift += worst->normal * missing;
        const auto number = static_cast<std::size_t>(worst - planes.plane.data());
        if (number != latest[0]) latest = {number, latest[0], number == latest[1] ? latest[2] : latest[1]};
        last[static_cast<std::size_t>(round % leap)] = shift;
        if (round % leap != leap - 1) continue;
        if (round >= rounds / 2) {
            const auto& p = planes.plane;
            if (const auto end = corner(p[latest[0]], p[latest[1]], p[latest[2]])) {
                shift = *end;
                continue;
            }
        }
        // The first, the third and the last since a leap lie on the same face of a wedge.
        const Vec3 older = last[2] - last[0];
        const Vec3 newer = last[4] - last[2];
        const double fraction = older.squaredNorm() > 0.0 ? newer.dot(older) / older.squaredNorm() : 0.0;
        if (fraction > 0.25 && fraction < 0.99999) shift += newer * (fraction / (1.0 - fraction));
    }
    return shift;
}

// Leaves what the planes do not cover: edges, corners, and faces that were not overlapped at first.
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
    const Vec3 motion = to - from;
    return motion.isZero(0.0) || !ray_in_scene(mover, from, motion);
}

}  // namespace

void push_out(Mover& mover) {
    if (mover.settings.push_out == PushOut::off) return;
    Overlaps found;
    std::size_t count = overlaps_at(mover, mover.position, found);
    if (count == 0) return;

    Vec3 centre = mover.position;
    const bool analytic = mover.settings.push_out == PushOut::analytic;
    // Moving out of some planes may lead into others, which then count as well.
    constexpr int rounds = 4;
    Planes overlapped;
    for (int round = 0; round < rounds && count > 0; ++round) {
        const std::size_t known = overlapped.count;
        add_planes(mover, mover.position, found, count, overlapped);
        if (overlapped.count == known) break;
        centre = mover.position + (analytic ? shift_out_of(overlapped) : iterate_out_of(overlapped));
        count = overlaps_at(mover, centre, found);
    }
    const int planes = static_cast<int>(overlapped.count);
    centre = iterate_out(mover, centre, found, count);
    const bool free = count == 0 && crosses_nothing(mover, mover.position, centre);
    if (mover.trace != nullptr) {
        mover.trace->add(PushOutRecord{.from = mover.position, .to = centre, .planes = planes, .free = free});
    }
    if (free) mover.position = centre;
}

}  // namespace slipface
