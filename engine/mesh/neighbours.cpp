#include <algorithm>
#include <numeric>

#include "slipface/base/parallel.h"
#include "slipface/mesh/mesh.h"
#include "weld.h"

namespace slipface {
namespace {

struct EdgeOfFace {
    std::uint32_t low, high;  // vertices
    FaceId face;
    friend auto operator<=>(const EdgeOfFace&, const EdgeOfFace&) = default;
};

// All edges, sorted: counted into buckets by their lower vertex, then each bucket is sorted.
std::vector<EdgeOfFace> edges_of(const Mesh& mesh) {
    const Welded welded = weld_positions(mesh.positions);
    const auto for_each_edge = [&](const auto& visit) {
        for (FaceId face = 0; face < mesh.face_count(); ++face) {
            const std::uint32_t end = mesh.face_first_corner[face + 1];
            std::uint32_t before = welded.index[mesh.corner_vertex[end - 1]];
            for (std::uint32_t corner = mesh.face_first_corner[face]; corner < end; ++corner) {
                const std::uint32_t here = welded.index[mesh.corner_vertex[corner]];
                if (before != here) visit(EdgeOfFace{std::min(before, here), std::max(before, here), face});
                before = here;
            }
        }
    };
    std::vector<std::uint32_t> next(welded.positions.size() + 1, 0);
    for_each_edge([&](const EdgeOfFace& edge) { ++next[edge.low + 1]; });
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<EdgeOfFace> edges(next.back());
    for_each_edge([&](const EdgeOfFace& edge) { edges[next[edge.low]++] = edge; });
    // Filling has moved the begin of each bucket to its end.
    constexpr std::size_t buckets_per_task = 4096;
    parallel_for(welded.positions.size(), buckets_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t low = begin; low < end; ++low) {
            const std::uint32_t from = low == 0 ? 0 : next[low - 1];
            std::sort(edges.begin() + static_cast<std::ptrdiff_t>(from),
                      edges.begin() + static_cast<std::ptrdiff_t>(next[low]));
        }
    });
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

// Calls link(face, neighbour) for each pair of faces with a common edge.
template <class Link>
void for_each_link(const std::vector<EdgeOfFace>& edges, const Link& link) {
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end].low == edges[begin].low &&
               edges[end].high == edges[begin].high)
            ++end;
        for (std::size_t a = begin; a < end; ++a) {
            for (std::size_t b = a + 1; b < std::min(end, a + 1 + max_linked_faces); ++b) {
                link(edges[a].face, edges[b].face);
                link(edges[b].face, edges[a].face);
            }
        }
    }
}

}  // namespace

FaceNeighbours face_neighbours(const Mesh& mesh) {
    const std::vector<EdgeOfFace> edges = edges_of(mesh);
    std::vector<std::size_t> end(mesh.face_count() + 1, 0);
    for_each_link(edges, [&](FaceId face, FaceId) { ++end[face + 1]; });
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<FaceId> links(end.back());
    for_each_link(edges, [&](FaceId face, FaceId neighbour) { links[end[face]++] = neighbour; });

    // Filling has moved the begin of each face to its end, which is the begin of the next face.
    FaceNeighbours result;
    result.first.reserve(mesh.face_count() + 1);
    result.first.push_back(0);
    std::size_t begin = 0;
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        const auto from = links.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto to = links.begin() + static_cast<std::ptrdiff_t>(end[face]);
        begin = end[face];
        std::sort(from, to);
        result.list.insert(result.list.end(), from, std::unique(from, to));
        result.first.push_back(static_cast<std::uint32_t>(result.list.size()));
    }
    return result;
}

}  // namespace slipface
