#include "topology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <tuple>

#include "slipface/base/parallel.h"

namespace slipface::doctor {
namespace {

// Numbers that compare as the floats do; -0 as 0.
std::uint32_t ordered(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value + 0.0f);
    return (bits >> 31U) != 0 ? ~bits : bits | 0x80000000U;
}

struct Place {
    std::array<std::uint32_t, 3> at;  // z, y, x
    std::uint32_t vertex;
};

// By x, y, z, then as they were. Eleven bits at a time, the lowest first.
void sort_places(std::vector<Place>& places) {
    constexpr unsigned bits = 11;
    std::vector<Place> dealt(places.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (unsigned shift = 0; shift < 32; shift += bits) {
            std::array<std::uint32_t, (1U << bits) + 1> begin{};
            const auto digit = [&](const Place& place) {
                return (place.at[axis] >> shift) & ((1U << bits) - 1U);
            };
            for (const Place& place : places)
                ++begin[digit(place) + 1];
            std::partial_sum(begin.begin(), begin.end(), begin.begin());
            for (const Place& place : places)
                dealt[begin[digit(place)]++] = place;
            places.swap(dealt);
        }
    }
}

// [vertex of the mesh] -> the first vertex, by position, at the same place.
std::vector<std::uint32_t> weld(const Mesh& mesh, std::vector<Vec3>& positions) {
    std::vector<Place> places(mesh.positions.size());
    for (std::uint32_t vertex = 0; vertex < places.size(); ++vertex) {
        const Vec3f& p = mesh.positions[vertex];
        places[vertex] = {{ordered(p.z()), ordered(p.y()), ordered(p.x())}, vertex};
    }
    sort_places(places);
    std::vector<std::uint32_t> welded(places.size());
    positions.reserve(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i == 0 || places[i].at != places[i - 1].at)
            positions.push_back(mesh.positions[places[i].vertex].cast<double>());
        welded[places[i].vertex] = static_cast<std::uint32_t>(positions.size() - 1);
    }
    return welded;
}

}  // namespace

double rounding_of(const Vec3& a, const Vec3& b) {
    // Six decimals is what most tools write; a float holds 24 bits.
    return std::max(2e-6, 4.0 * 0x1p-24 * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()));
}

Topology::Topology(const Mesh& mesh) {
    const std::vector<std::uint32_t> welded = weld(mesh, position);
    vertex.resize(mesh.corner_vertex.size());
    for (std::size_t corner = 0; corner < vertex.size(); ++corner)
        vertex[corner] = welded[mesh.corner_vertex[corner]];

    const auto each_use = [&](const auto& visit) {
        for (FaceId face = 0; face < mesh.face_count(); ++face) {
            const std::uint32_t first = mesh.face_first_corner[face], last = mesh.face_first_corner[face + 1];
            for (std::uint32_t corner = first; corner < last; ++corner) {
                const std::uint32_t a = vertex[corner], b = vertex[corner + 1 < last ? corner + 1 : first];
                if (a != b) visit(EdgeUse{std::min(a, b), std::max(a, b), face, a < b});
            }
        }
    };
    // Dealt out by their first vertex, few of each are left to sort.
    std::vector<std::uint32_t> end(position.size() + 1, 0);
    each_use([&](const EdgeUse& use) { ++end[use.from + 1]; });
    std::partial_sum(end.begin(), end.end(), end.begin());
    edges.resize(end.back());
    each_use([&](const EdgeUse& use) { edges[end[use.from]++] = use; });
    // Dealing has moved the begin of each vertex's edges to their end.
    parallel_for(position.size(), 4096, [&](std::size_t begin, std::size_t last) {
        for (std::size_t from = begin; from < last; ++from)
            std::sort(edges.begin() + (from == 0 ? 0 : end[from - 1]), edges.begin() + end[from],
                      [](const EdgeUse& a, const EdgeUse& b) {
                          return std::tie(a.to, a.face, a.forward) < std::tie(b.to, b.face, b.forward);
                      });
    });
    normal.resize(mesh.face_count());
    parallel_for(normal.size(), 4096, [&](std::size_t begin, std::size_t last) {
        for (std::size_t face = begin; face < last; ++face)
            normal[face] = face_normal(mesh, static_cast<FaceId>(face));
    });
}

}  // namespace slipface::doctor
