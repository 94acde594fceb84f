// A navigation mesh as RecastDemo's "Solo Mesh" builds it, with the off-mesh connections of a .gset file.
#pragma once

#include <DetourNavMesh.h>
#include <DetourNavMeshQuery.h>

#include <memory>
#include <string>
#include <vector>

#include "slipface/level/level.h"

namespace slipface::test {

// The off-mesh connections of a .gset file, as arrays for dtNavMeshCreateParams.
struct Connections {
    std::vector<float> ends, radii;
    std::vector<unsigned char> both_ways, areas;
    std::vector<unsigned short> flags;
    int size() const { return static_cast<int>(radii.size()); }
};
Connections connections_of(const std::string& gset);

class NavMesh {
  public:
    // Empty if Recast refuses.
    static std::unique_ptr<NavMesh> build(const Level& level, const Connections& connections);

    struct Way {
        bool complete = false;  // it ends on the target's polygon
        int connections = 0;    // that it passes
    };
    Way way(const Vec3& from, const Vec3& to) const;
    // Area of the mesh to which there is a way from a place, square metres; and of all of it.
    double area_from(const Vec3& place) const;
    double area() const;

  private:
    NavMesh() = default;
    double area_of(const dtPoly& polygon) const;
    dtPolyRef polygon_at(const Vec3& place, float* on) const;
    struct Free {
        void operator()(dtNavMesh* mesh) const { dtFreeNavMesh(mesh); }
        void operator()(dtNavMeshQuery* query) const { dtFreeNavMeshQuery(query); }
    };
    std::unique_ptr<dtNavMesh, Free> mesh_;
    std::unique_ptr<dtNavMeshQuery, Free> query_;
};

}  // namespace slipface::test
