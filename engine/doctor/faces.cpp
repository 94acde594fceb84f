// Slivers, duplicate faces, overlapping faces, faces wound the wrong way.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "checks.h"
#include "slipface/base/key_sort.h"
#include "slipface/base/parallel.h"

namespace slipface::doctor {
namespace {

constexpr double thinnest = 1.0 / 1000.0;  // height of a triangle as a fraction of its longest edge
constexpr double vague = 3.5e-3;           // radians, 0.2 degrees: a normal off by more misleads movement

std::array<Vec3, 3> corners_of(const Patient& patient, TriangleId triangle) {
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
        corners[i] = patient.topology.position[patient.topology.vertex[patient.mesh.triangles[triangle][i]]];
    return corners;
}

std::vector<std::uint32_t> sorted_loop(const Patient& patient, FaceId face) {
    const auto first = patient.topology.vertex.begin() + patient.mesh.face_first_corner[face];
    const auto last = patient.topology.vertex.begin() + patient.mesh.face_first_corner[face + 1];
    std::vector<std::uint32_t> loop(first, last);
    std::sort(loop.begin(), loop.end());
    return loop;
}

// Of the corners, whatever their order.
std::uint64_t loop_key(const Patient& patient, FaceId face) {
    std::uint64_t key = 0;
    for (std::uint32_t corner = patient.mesh.face_first_corner[face];
         corner < patient.mesh.face_first_corner[face + 1]; ++corner) {
        // Spreads the bits (splitmix64); sums do not depend on the order.
        std::uint64_t bits = patient.topology.vertex[corner] + 0x9e3779b97f4a7c15U;
        bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
        bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
        key += bits ^ (bits >> 31U);
    }
    return key;
}

using Flat = std::array<Vec2, 3>;

// Whether two triangles of one plane share more than their border: no edge separates them by `margin`.
bool overlap_in_plane(const Flat& a, const Flat& b, double margin) {
    for (const auto& [one, two] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        const Vec2 centre = ((*one)[0] + (*one)[1] + (*one)[2]) / 3.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec2 from = (*one)[i], edge = (*one)[(i + 1) % 3] - from;
            const double length = edge.norm();
            if (!(length > 0.0)) return false;
            Vec2 outside(edge.y() / length, -edge.x() / length);
            if (outside.dot(centre - from) > 0.0) outside = -outside;
            double nearest = std::numeric_limits<double>::infinity();
            for (const Vec2& p : *two)
                nearest = std::min(nearest, outside.dot(p - from));
            if (nearest > -margin) return false;
        }
    }
    return true;
}

Flat flatten(const std::array<Vec3, 3>& corners, int drop) {
    Flat flat;
    for (std::size_t i = 0; i < 3; ++i)
        flat[i] = {corners[i][(drop + 1) % 3], corners[i][(drop + 2) % 3]};
    return flat;
}

// The box of a triangle; corners are floats.
struct Box {
    Vec3f min, max;

    bool touches(const Box& other) const {
        return min.x() <= other.max.x() && min.y() <= other.max.y() && min.z() <= other.max.z() &&
               max.x() >= other.min.x() && max.y() >= other.min.y() && max.z() >= other.min.z();
    }
};

std::vector<Box> boxes_of(const Patient& patient) {
    std::vector<Box> boxes(patient.mesh.triangle_count());
    parallel_for(boxes.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            const auto& corners = patient.mesh.triangles[t];
            const Vec3f a = patient.mesh.corner_position(corners[0]),
                        b = patient.mesh.corner_position(corners[1]),
                        c = patient.mesh.corner_position(corners[2]);
            boxes[t] = {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
        }
    });
    return boxes;
}

// The first face of a lower number that lies over this triangle in its plane. `candidates`: at least all
// triangles of such faces whose boxes touch this one's, ascending.
FaceId face_over(const Patient& patient, std::span<const Box> boxes, TriangleId triangle,
                 std::span<const TriangleId> candidates) {
    const FaceId face = patient.mesh.triangle_face[triangle];
    const auto corners = corners_of(patient, triangle);
    const Vec3 cross = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double area = cross.norm();
    const double size = std::max({(corners[1] - corners[0]).norm(), (corners[2] - corners[1]).norm(),
                                  (corners[0] - corners[2]).norm()});
    if (!(area > thinnest * size * size)) return no_id;
    const Vec3 normal = cross / area;
    int drop = 0;
    normal.cwiseAbs().maxCoeff(&drop);
    const double largest = std::max({corners[0].cwiseAbs().maxCoeff(), corners[1].cwiseAbs().maxCoeff(),
                                     corners[2].cwiseAbs().maxCoeff()});
    const double off_plane = std::max(1e-5 * size, 8.0 * 0x1p-24 * largest);
    for (const TriangleId other : candidates) {
        if (other >= triangle) break;  // ascending
        if (!boxes[other].touches(boxes[triangle])) continue;
        const FaceId other_face = patient.mesh.triangle_face[other];
        if (other_face == face) break;
        const auto& their_corners = patient.mesh.triangles[other];
        if (std::any_of(their_corners.begin(), their_corners.end(), [&](std::uint32_t corner) {
                const Vec3 p = patient.mesh.corner_position(corner).cast<double>();
                return std::abs(normal.dot(p - corners[0])) > off_plane;
            }))
            continue;
        // Two things that touch, such as a crate on a floor, hide what they share.
        const Vec3 their_normal = patient.topology.normal[other_face];
        if (patient.topology.normal[face].dot(their_normal) < 0.0) continue;
        if (overlap_in_plane(flatten(corners, drop), flatten(corners_of(patient, other), drop),
                             std::max(1e-3 * size, off_plane)))
            return other_face;
    }
    return no_id;
}

// face_over() for the triangles [first, last). They share one look into the tree if they are of about one
// size and near each other, as consecutive numbers mostly are; otherwise each half does.
void faces_over(const Patient& patient, std::span<const Box> boxes, TriangleId first, TriangleId last,
                std::span<FaceId> over) {
    Aabb box;
    double smallest = std::numeric_limits<double>::infinity();
    for (TriangleId t = first; t < last; ++t) {
        smallest = std::min(smallest, static_cast<double>((boxes[t].max - boxes[t].min).norm()));
        box.add(boxes[t].min.cast<double>());
        box.add(boxes[t].max.cast<double>());
    }
    if (last - first > 1 && box.size().norm() > 8.0 * smallest) {
        const TriangleId middle = first + (last - first) / 2;
        faces_over(patient, boxes, first, middle, over);
        faces_over(patient, boxes, middle, last, over);
        return;
    }
    const std::vector<TriangleId> candidates = patient.world.triangles_in(box);
    for (TriangleId t = first; t < last; ++t)
        over[t] = face_over(patient, boxes, t, candidates);
}

}  // namespace

void find_slivers(const Patient& patient, Problems& out) {
    const Mesh& mesh = patient.mesh;
    // A triangle higher than this, metres, is none wherever it lies, and needs no square root.
    const double high = 1.01 * rounding_of(mesh.bounds.min, mesh.bounds.max) / vague;
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        double worst = 0.0, longest_there = 0.0, height_there = 0.0;
        for (TriangleId t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1]; ++t) {
            const auto c = corners_of(patient, t);
            const double longest2 = std::max(
                {(c[1] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm()});
            const double across2 = (c[1] - c[0]).cross(c[2] - c[0]).squaredNorm();
            if (across2 > high * high * longest2) continue;
            const double longest = std::sqrt(longest2);
            const double height = longest > 0.0 ? std::sqrt(across2) / longest : 0.0;
            const double rounding = std::max(rounding_of(c[0], c[1]), rounding_of(c[1], c[2]));
            const double off = height > rounding ? rounding / height : 1.0;
            if (off > worst) {
                worst = off;
                longest_there = longest;
                height_there = height;
            }
        }
        if (worst > vague)
            out.push_back({ProblemKind::sliver, face, no_id, face_centroid(mesh, face), 0,
                           fmt::format("{} wide, {} long: rounding rotates its normal by {}",
                                       metres(height_there), metres(longest_there),
                                       worst < 1.0 ? degrees(worst) : std::string("any angle"))});
    }
}

void find_duplicates(const Patient& patient, Problems& out) {
    const std::size_t count = patient.mesh.face_count();
    // Faces of the same corners have the same key, and hardly any others.
    std::vector<KeyedIndex> order(count);
    parallel_for(count, 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t face = begin; face < end; ++face)
            order[face] = {loop_key(patient, static_cast<FaceId>(face)), static_cast<std::uint32_t>(face)};
    });
    sort_by_key(order);
    const auto by_loop = [&](const KeyedIndex& a, const KeyedIndex& b) {
        const auto loop_a = sorted_loop(patient, a.index), loop_b = sorted_loop(patient, b.index);
        return std::tie(loop_a, a.index) < std::tie(loop_b, b.index);
    };
    for (auto begin = order.begin(), end = begin; begin != order.end(); begin = end) {
        end = std::find_if(begin, order.end(), [&](const KeyedIndex& one) { return one.key != begin->key; });
        if (end - begin > 1) std::sort(begin, end, by_loop);
    }
    const std::size_t before = out.size();
    for (std::size_t i = 1; i < count; ++i) {
        if (order[i].key != order[i - 1].key) continue;
        const FaceId face = order[i].index, first = order[i - 1].index;
        if (sorted_loop(patient, face) != sorted_loop(patient, first)) continue;
        const bool opposite = patient.topology.normal[face].dot(patient.topology.normal[first]) < 0.0;
        // Front and back of a thin thing are two faces, and rightly so; types of both sides must agree.
        if (opposite && patient.resolved.surface[face] == patient.resolved.surface[first]) continue;
        out.push_back({ProblemKind::duplicate, face, first, face_centroid(patient.mesh, face), 0,
                       fmt::format("Same corners as face {}{}", first, opposite ? ", from behind" : "")});
    }
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(before), out.end(),
              [](const Problem& a, const Problem& b) { return a.face < b.face; });
}

void find_overlaps(const Patient& patient, Problems& out) {
    const Mesh& mesh = patient.mesh;
    if (patient.world.triangle_count() != mesh.triangle_count()) return;
    std::vector<FaceId> over(mesh.triangle_count(), no_id);
    const std::vector<Box> boxes = boxes_of(patient);
    constexpr std::size_t together = 16;
    parallel_for((over.size() + together - 1) / together, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t group = begin; group < end; ++group) {
            const auto first = static_cast<TriangleId>(group * together);
            const auto last = static_cast<TriangleId>(std::min(over.size(), (group + 1) * together));
            faces_over(patient, boxes, first, last, over);
        }
    });
    FaceId last = no_id;
    for (TriangleId t = 0; t < over.size(); ++t) {
        const FaceId face = mesh.triangle_face[t];
        if (over[t] == no_id || face == last) continue;
        // Faces with the same corners are duplicates, said already.
        if (sorted_loop(patient, face) == sorted_loop(patient, over[t])) continue;
        last = face;
        const auto corners = corners_of(patient, t);
        out.push_back({ProblemKind::overlap, face, over[t], (corners[0] + corners[1] + corners[2]) / 3.0, 0,
                       fmt::format("Overlaps face {} in one plane", over[t])});
    }
}

void find_flipped(const Patient& patient, Problems& out) {
    const Topology& topology = patient.topology;
    struct Count {
        std::uint32_t against = 0, with = 0;
    };
    std::vector<Count> counts(patient.mesh.face_count());
    const auto each_pair = [&](auto visit) {
        topology.each_edge([&](std::size_t first, std::size_t last) {
            if (last - first != 2) return;
            const EdgeUse &a = topology.edges[first], &b = topology.edges[first + 1];
            if (a.face != b.face) visit(a.face, b.face, a.forward == b.forward);
        });
    };
    each_pair([&](FaceId a, FaceId b, bool against) {
        for (const FaceId face : {a, b})
            ++(against ? counts[face].against : counts[face].with);
    });
    // Of two faces that disagree, the one with more neighbours against it is the odd one.
    const auto odd = [&](FaceId a, FaceId b) {
        const double sa = double(counts[a].against) / (counts[a].against + counts[a].with);
        const double sb = double(counts[b].against) / (counts[b].against + counts[b].with);
        return sa > sb ? a : sb > sa ? b : std::max(a, b);
    };
    std::map<FaceId, FaceId> found;
    each_pair([&](FaceId a, FaceId b, bool against) {
        if (!against) return;
        const FaceId face = odd(a, b);
        if (counts[face].against >= counts[face].with) found.try_emplace(face, face == a ? b : a);
    });
    for (const auto& [face, neighbour] : found)
        out.push_back({ProblemKind::flipped, face, neighbour, face_centroid(patient.mesh, face), 0,
                       fmt::format("Wound against {} of {} neighbours", counts[face].against,
                                   counts[face].against + counts[face].with)});
}

}  // namespace slipface::doctor
