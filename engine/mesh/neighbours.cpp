#include <algorithm>

#include "slipface/mesh/mesh.h"
#include "weld.h"

namespace slipface {
namespace {

struct EdgeOfFace {
    std::uint32_t low, high;  // vertices
    FaceId face;
    friend auto operator<=>(const EdgeOfFace&, const EdgeOfFace&) = default;
};

struct Pair {
    FaceId face, neighbour;
    friend auto operator<=>(const Pair&, const Pair&) = default;
};

std::vector<EdgeOfFace> edges_of(const Mesh& mesh) {
    const Welded welded = weld_positions(mesh.positions);
    std::vector<EdgeOfFace> edges;
    edges.reserve(mesh.corner_vertex.size());
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        const std::uint32_t end = mesh.face_first_corner[face + 1];
        std::uint32_t before = welded.index[mesh.corner_vertex[end - 1]];
        for (std::uint32_t corner = mesh.face_first_corner[face]; corner < end; ++corner) {
            const std::uint32_t here = welded.index[mesh.corner_vertex[corner]];
            if (before != here) edges.push_back({std::min(before, here), std::max(before, here), face});
            before = here;
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

}  // namespace

FaceNeighbours face_neighbours(const Mesh& mesh) {
    const std::vector<EdgeOfFace> edges = edges_of(mesh);
    std::vector<Pair> pairs;
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end].low == edges[begin].low &&
               edges[end].high == edges[begin].high)
            ++end;
        for (std::size_t a = begin; a < end; ++a) {
            for (std::size_t b = a + 1; b < std::min(end, a + 1 + max_linked_faces); ++b) {
                pairs.push_back({edges[a].face, edges[b].face});
                pairs.push_back({edges[b].face, edges[a].face});
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

    FaceNeighbours result;
    result.first.assign(mesh.face_count() + 1, 0);
    result.list.reserve(pairs.size());
    for (const Pair& pair : pairs) {
        ++result.first[pair.face + 1];
        result.list.push_back(pair.neighbour);
    }
    for (std::size_t i = 1; i < result.first.size(); ++i)
        result.first[i] += result.first[i - 1];
    return result;
}

}  // namespace slipface
