#include "slipface/mesh/open_edges.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace slipface {

std::size_t open_edge_count(const Mesh& mesh) {
    const auto each_side = [&](const auto& visit) {
        for (FaceId face = 0; face < mesh.face_count(); ++face) {
            const std::uint32_t end = mesh.face_first_corner[face + 1];
            std::uint32_t before = mesh.corner_vertex[end - 1];
            for (std::uint32_t corner = mesh.face_first_corner[face]; corner < end; ++corner) {
                const std::uint32_t here = mesh.corner_vertex[corner];
                if (here != before) visit(std::min(before, here), std::max(before, here));
                before = here;
            }
        }
    };
    // [lower vertex] the higher vertices of its edges. Few of each are left to sort.
    std::vector<std::uint32_t> end(mesh.positions.size() + 1, 0);
    each_side([&](std::uint32_t low, std::uint32_t) { ++end[low + 1]; });
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<std::uint32_t> high(end.back());
    each_side([&](std::uint32_t low, std::uint32_t to) { high[end[low]++] = to; });
    std::size_t open = 0;
    // Filling has moved the begin of each vertex's edges to their end.
    for (std::size_t low = 0, i = 0; low < mesh.positions.size(); ++low) {
        std::sort(high.begin() + static_cast<std::ptrdiff_t>(i), high.begin() + end[low]);
        while (i < end[low]) {
            std::size_t next = i + 1;
            while (next < end[low] && high[next] == high[i])
                ++next;
            if (next == i + 1) ++open;
            i = next;
        }
    }
    return open;
}

}  // namespace slipface
