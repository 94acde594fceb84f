// Slivers, duplicate faces, faces wound the wrong way.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "checks.h"
#include "slipface/base/key_sort.h"

namespace slipface::doctor {
namespace {

constexpr double vague = 3.5e-3;  // radians, 0.2 degrees: a normal off by more misleads movement

// Number by number: Eigen would load two at once that were just stored one by one, for which the processor
// waits.
using Side = std::array<double, 3>;
Side side(const Vec3f& from, const Vec3f& to) {
    return {double{to.x()} - double{from.x()}, double{to.y()} - double{from.y()},
            double{to.z()} - double{from.z()}};
}
Side cross(const Side& a, const Side& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double squared(const Side& v) {
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

}  // namespace

std::vector<std::uint32_t> sorted_loop(const Patient& patient, FaceId face) {
    const auto first = patient.topology.vertex.begin() + patient.mesh.face_first_corner[face];
    const auto last = patient.topology.vertex.begin() + patient.mesh.face_first_corner[face + 1];
    std::vector<std::uint32_t> loop(first, last);
    std::sort(loop.begin(), loop.end());
    return loop;
}

void find_slivers(const Patient& patient, Problems& out) {
    const Mesh& mesh = patient.mesh;
    // A triangle higher than this, metres, is none wherever it lies, and needs no square root.
    const double high = 1.01 * rounding_of(mesh.bounds.min, mesh.bounds.max) / vague;
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        double worst = 0.0, longest_there = 0.0, height_there = 0.0;
        for (TriangleId t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1]; ++t) {
            const auto [i, j, k] = mesh.triangles[t];
            const Vec3f a = mesh.corner_position(i), b = mesh.corner_position(j), c = mesh.corner_position(k);
            const Side ab = side(a, b), ca = side(c, a);
            const double longest2 = std::max({squared(ab), squared(side(b, c)), squared(ca)});
            const double across2 = squared(cross(ab, ca));
            if (across2 > high * high * longest2) continue;
            const double longest = std::sqrt(longest2);
            const double height = longest > 0.0 ? std::sqrt(across2) / longest : 0.0;
            const Vec3 middle = b.cast<double>();
            const double rounding =
                std::max(rounding_of(a.cast<double>(), middle), rounding_of(middle, c.cast<double>()));
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
    const Mesh& mesh = patient.mesh;
    const std::vector<std::uint32_t>& vertex = patient.topology.vertex;
    // Faces of the same corners have the same lowest vertex and the same sum. Dealt out by the lowest, few
    // are left to compare.
    std::vector<std::uint32_t> lowest(mesh.face_count());
    std::vector<std::uint32_t> end(patient.topology.position.size() + 1, 0);
    for (FaceId face = 0; face < lowest.size(); ++face) {
        const auto first = vertex.begin() + mesh.face_first_corner[face];
        lowest[face] = *std::min_element(first, vertex.begin() + mesh.face_first_corner[face + 1]);
        ++end[lowest[face] + 1];
    }
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<KeyedIndex> dealt(lowest.size());
    for (FaceId face = 0; face < lowest.size(); ++face) {
        const auto first = vertex.begin() + mesh.face_first_corner[face];
        const auto sum =
            std::accumulate(first, vertex.begin() + mesh.face_first_corner[face + 1], std::uint64_t{0});
        dealt[end[lowest[face]]++] = {sum, face};
    }
    const auto by_loop = [&](const KeyedIndex& a, const KeyedIndex& b) {
        if (a.key != b.key) return a.key < b.key;
        const auto loop_a = sorted_loop(patient, a.index), loop_b = sorted_loop(patient, b.index);
        return std::tie(loop_a, a.index) < std::tie(loop_b, b.index);
    };
    const std::size_t before = out.size();
    // Dealing has moved the begin of each vertex's faces to their end.
    for (std::size_t at = 0, begin = 0; at + 1 < end.size(); begin = end[at++]) {
        if (end[at] - begin < 2) continue;
        std::sort(dealt.begin() + static_cast<std::ptrdiff_t>(begin), dealt.begin() + end[at], by_loop);
        for (std::size_t i = begin + 1; i < end[at]; ++i) {
            if (dealt[i].key != dealt[i - 1].key) continue;
            const FaceId face = dealt[i].index, first = dealt[i - 1].index;
            if (sorted_loop(patient, face) != sorted_loop(patient, first)) continue;
            const bool opposite = patient.topology.normal[face].dot(patient.topology.normal[first]) < 0.0;
            // Front and back of a thin thing are two faces, and rightly so; types of both sides must agree.
            if (opposite && patient.resolved.surface[face] == patient.resolved.surface[first]) continue;
            out.push_back({ProblemKind::duplicate, face, first, face_centroid(mesh, face), 0,
                           fmt::format("Same corners as face {}{}", first, opposite ? ", from behind" : "")});
        }
    }
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(before), out.end(),
              [](const Problem& a, const Problem& b) { return a.face < b.face; });
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
