#include <DetourCommon.h>
#include <DetourNavMeshBuilder.h>
#include <Recast.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>

#include "recast/nav_mesh.h"

namespace slipface::test {

namespace {

// A Recast object that frees itself.
template <class T>
std::unique_ptr<T, void (*)(T*)> own(T* object, void (*release)(T*)) {
    return {object, release};
}

}  // namespace

Connections connections_of(const std::string& gset) {
    Connections all;
    std::istringstream lines(gset);
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] != 'c') continue;
        float v[6], radius = 0;
        int both = 0, area = 0, flags = 0;
        if (std::sscanf(line.c_str() + 1, "%f %f %f  %f %f %f %f %d %d %d", v, v + 1, v + 2, v + 3, v + 4,
                        v + 5, &radius, &both, &area, &flags) != 10)
            continue;
        all.ends.insert(all.ends.end(), v, v + 6);
        all.radii.push_back(radius);
        all.both_ways.push_back(static_cast<unsigned char>(both));
        all.areas.push_back(static_cast<unsigned char>(area));
        all.flags.push_back(static_cast<unsigned short>(flags));
    }
    return all;
}

std::unique_ptr<NavMesh> NavMesh::build(const Level& level, const Connections& connections) {
    const Mesh& mesh = *level.mesh;
    const MovementSettings& settings = level.movement;
    std::vector<float> vertices;
    for (const Vec3f& position : mesh.positions)
        vertices.insert(vertices.end(), {position.x(), position.y(), position.z()});
    std::vector<int> triangles;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            triangles.push_back(static_cast<int>(mesh.corner_vertex[corner]));
    const int vertex_count = static_cast<int>(mesh.positions.size());
    const int triangle_count = static_cast<int>(mesh.triangles.size());

    rcConfig config{};
    const auto radius = static_cast<float>(settings.radii.x()),
               height = static_cast<float>(2.0 * settings.radii.y());
    // Detour looks for an end of a connection within the climb; its mesh lies up to two cells above the
    // floor.
    const float climb = std::max(0.3f, static_cast<float>(settings.step_up ? settings.step_height : 0.0));
    config.cs = 0.15f;
    config.ch = 0.1f;
    config.walkableSlopeAngle = static_cast<float>(settings.max_slope * 180.0 / std::numbers::pi);
    config.walkableHeight = static_cast<int>(std::ceil(height / config.ch));
    config.walkableClimb = static_cast<int>(std::floor(climb / config.ch));
    config.walkableRadius = static_cast<int>(std::ceil(radius / config.cs));
    config.maxEdgeLen = static_cast<int>(12.0f / config.cs);
    config.maxSimplificationError = 1.3f;
    config.minRegionArea = 8;
    config.mergeRegionArea = 400;
    config.maxVertsPerPoly = DT_VERTS_PER_POLYGON;
    config.detailSampleDist = 6.0f * config.cs;
    config.detailSampleMaxError = config.ch;
    rcCalcBounds(vertices.data(), vertex_count, config.bmin, config.bmax);
    config.bmin[1] -= 1.0f;
    config.bmax[1] += height + 1.0f;
    rcCalcGridSize(config.bmin, config.bmax, config.cs, &config.width, &config.height);

    rcContext context(false);
    const auto field = own(rcAllocHeightfield(), rcFreeHeightField);
    const auto compact = own(rcAllocCompactHeightfield(), rcFreeCompactHeightfield);
    const auto contours = own(rcAllocContourSet(), rcFreeContourSet);
    const auto polygons = own(rcAllocPolyMesh(), rcFreePolyMesh);
    const auto detail = own(rcAllocPolyMeshDetail(), rcFreePolyMeshDetail);
    std::vector<unsigned char> areas(mesh.triangles.size(), 0);
    rcMarkWalkableTriangles(&context, config.walkableSlopeAngle, vertices.data(), vertex_count,
                            triangles.data(), triangle_count, areas.data());
    if (!rcCreateHeightfield(&context, *field, config.width, config.height, config.bmin, config.bmax,
                             config.cs, config.ch) ||
        !rcRasterizeTriangles(&context, vertices.data(), vertex_count, triangles.data(), areas.data(),
                              triangle_count, *field, config.walkableClimb))
        return nullptr;
    rcFilterLowHangingWalkableObstacles(&context, config.walkableClimb, *field);
    rcFilterLedgeSpans(&context, config.walkableHeight, config.walkableClimb, *field);
    rcFilterWalkableLowHeightSpans(&context, config.walkableHeight, *field);
    if (!rcBuildCompactHeightfield(&context, config.walkableHeight, config.walkableClimb, *field, *compact) ||
        !rcErodeWalkableArea(&context, config.walkableRadius, *compact) ||
        !rcBuildDistanceField(&context, *compact) ||
        !rcBuildRegions(&context, *compact, 0, config.minRegionArea, config.mergeRegionArea) ||
        !rcBuildContours(&context, *compact, config.maxSimplificationError, config.maxEdgeLen, *contours) ||
        !rcBuildPolyMesh(&context, *contours, config.maxVertsPerPoly, *polygons) ||
        !rcBuildPolyMeshDetail(&context, *polygons, *compact, config.detailSampleDist,
                               config.detailSampleMaxError, *detail))
        return nullptr;
    // RecastDemo's area and flag of ground.
    for (int i = 0; i < polygons->npolys; ++i)
        if (polygons->areas[i] == RC_WALKABLE_AREA) polygons->areas[i] = 0, polygons->flags[i] = 1;

    dtNavMeshCreateParams params{};
    params.verts = polygons->verts;
    params.vertCount = polygons->nverts;
    params.polys = polygons->polys;
    params.polyAreas = polygons->areas;
    params.polyFlags = polygons->flags;
    params.polyCount = polygons->npolys;
    params.nvp = polygons->nvp;
    params.detailMeshes = detail->meshes;
    params.detailVerts = detail->verts;
    params.detailVertsCount = detail->nverts;
    params.detailTris = detail->tris;
    params.detailTriCount = detail->ntris;
    params.offMeshConVerts = connections.ends.data();
    params.offMeshConRad = connections.radii.data();
    params.offMeshConDir = connections.both_ways.data();
    params.offMeshConAreas = connections.areas.data();
    params.offMeshConFlags = connections.flags.data();
    params.offMeshConCount = connections.size();
    params.walkableHeight = height;
    params.walkableRadius = radius;
    params.walkableClimb = climb;
    std::copy_n(polygons->bmin, 3, params.bmin);
    std::copy_n(polygons->bmax, 3, params.bmax);
    params.cs = config.cs;
    params.ch = config.ch;
    params.buildBvTree = true;
    unsigned char* data = nullptr;
    int size = 0;
    if (!dtCreateNavMeshData(&params, &data, &size)) return nullptr;
    std::unique_ptr<NavMesh> built(new NavMesh);
    built->mesh_.reset(dtAllocNavMesh());
    built->query_.reset(dtAllocNavMeshQuery());
    if (dtStatusFailed(built->mesh_->init(data, size, DT_TILE_FREE_DATA)) ||
        dtStatusFailed(built->query_->init(built->mesh_.get(), 65535)))
        return nullptr;
    return built;
}

dtPolyRef NavMesh::polygon_at(const Vec3& place, float* on) const {
    const dtQueryFilter all;
    const float around[3] = {1.0f, 2.0f, 1.0f};
    const float at[3] = {static_cast<float>(place.x()), static_cast<float>(place.y()),
                         static_cast<float>(place.z())};
    dtPolyRef polygon = 0;
    query_->findNearestPoly(at, around, &all, &polygon, on);
    return polygon;
}

NavMesh::Way NavMesh::way(const Vec3& from, const Vec3& to) const {
    const dtQueryFilter all;
    float begin[3], end[3];
    const dtPolyRef first = polygon_at(from, begin), last = polygon_at(to, end);
    constexpr int most = 4096;
    std::vector<dtPolyRef> path(most);
    int count = 0;
    Way way;
    if (first == 0 || last == 0 ||
        dtStatusFailed(query_->findPath(first, last, begin, end, &all, path.data(), &count, most)))
        return way;
    path.resize(static_cast<std::size_t>(count));
    way.complete = !path.empty() && path.back() == last;
    for (const dtPolyRef polygon : path)
        way.connections += mesh_->getOffMeshConnectionByRef(polygon) != nullptr ? 1 : 0;
    return way;
}

double NavMesh::area_of(const dtPoly& polygon) const {
    if (polygon.getType() == DT_POLYTYPE_OFFMESH_CONNECTION) return 0.0;
    const dtNavMesh& mesh = *mesh_;
    const float* vertices = mesh.getTile(0)->verts;
    double area = 0.0;
    for (unsigned i = 2; i < polygon.vertCount; ++i)
        area += 0.5 * std::abs(static_cast<double>(dtTriArea2D(vertices + 3 * polygon.verts[0],
                                                               vertices + 3 * polygon.verts[i - 1],
                                                               vertices + 3 * polygon.verts[i])));
    return area;
}

double NavMesh::area() const {
    const dtNavMesh& mesh = *mesh_;
    const dtMeshTile* tile = mesh.getTile(0);
    double area = 0.0;
    for (int i = 0; i < tile->header->polyCount; ++i)
        area += area_of(tile->polys[i]);
    return area;
}

double NavMesh::area_from(const Vec3& place) const {
    const dtNavMesh& mesh = *mesh_;
    const dtMeshTile* tile = mesh.getTile(0);
    float on[3];
    std::vector<dtPolyRef> open;
    std::vector<bool> seen(static_cast<std::size_t>(tile->header->polyCount));
    const auto visit = [&](dtPolyRef polygon) {
        const unsigned index = mesh.decodePolyIdPoly(polygon);
        if (polygon == 0 || seen[index]) return;
        seen[index] = true;
        open.push_back(polygon);
    };
    visit(polygon_at(place, on));
    double area = 0.0;
    while (!open.empty()) {
        const dtPoly& polygon = tile->polys[mesh.decodePolyIdPoly(open.back())];
        open.pop_back();
        area += area_of(polygon);
        for (unsigned link = polygon.firstLink; link != DT_NULL_LINK; link = tile->links[link].next)
            visit(tile->links[link].ref);
    }
    return area;
}

}  // namespace slipface::test
