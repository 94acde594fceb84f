// The connections of a mesh: vertices at one position are welded, and each edge has its faces.
#pragma once

#include <vector>

#include "slipface/mesh/mesh.h"

namespace slipface::doctor {

// One side of an edge. `from` < `to` are welded vertices; `forward`: the face runs from `from` to `to`.
struct EdgeUse {
    std::uint32_t from = 0, to = 0;
    FaceId face = no_id;
    bool forward = true;
};

struct Topology {
    explicit Topology(const Mesh& mesh);

    std::vector<std::uint32_t> vertex;  // [corner] welded
    std::vector<Vec3> position;         // [welded vertex]
    std::vector<EdgeUse> edges;         // sorted by from, to, face: the uses of one edge are neighbours
    std::vector<Vec3> normal;           // [face], unit or zero

    // Calls visit(first, last) for the uses [first, last) of each edge.
    template <class Visit>
    void each_edge(Visit visit) const {
        for (std::size_t first = 0; first < edges.size();) {
            std::size_t last = first + 1;
            while (last < edges.size() && edges[last].from == edges[first].from &&
                   edges[last].to == edges[first].to)
                ++last;
            visit(first, last);
            first = last;
        }
    }
};

// The rounding error, in metres, that the corners of an edge may have.
double rounding_of(const Vec3& a, const Vec3& b);

}  // namespace slipface::doctor
