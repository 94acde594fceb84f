#include "slipface/mesh/open_edges.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace slipface {

std::size_t open_edge_count(const Mesh& mesh) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    edges.reserve(mesh.corner_vertex.size());
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        const std::uint32_t first = mesh.face_first_corner[face], count = mesh.face_corner_count(face);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t a = mesh.corner_vertex[first + i],
                                b = mesh.corner_vertex[first + (i + 1) % count];
            if (a != b) edges.emplace_back(std::minmax(a, b));
        }
    }
    std::sort(edges.begin(), edges.end());
    std::size_t open = 0;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t next = i + 1;
        while (next < edges.size() && edges[next] == edges[i])
            ++next;
        if (next == i + 1) ++open;
        i = next;
    }
    return open;
}

}  // namespace slipface
