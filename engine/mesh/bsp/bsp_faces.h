// The drawn faces of a Quake 3 map.
#pragma once

#include <string>
#include <vector>

#include "bsp/bsp_file.h"
#include "bsp/bsp_walls.h"
#include "slipface/mesh/build.h"
#include "warning_list.h"

namespace slipface {

struct BspFaces {
    PolygonSoup soup;                // with the materials of all textures
    std::vector<BspTriangle> walls;  // of flat faces that stop a player
};

// Reads all faces. A flat face becomes one polygon if its triangles form one outline, else triangles; meshes
// become triangles, patches become quads. `origins` [face]: the origin of the face's model; faces beyond its
// end have the origin zero. Every index is checked.
Result<BspFaces> read_bsp_faces(const BspFile& file, const std::vector<Vec3>& origins,
                                const std::string& location, WarningList& warnings);

// Appends a face. Returns false and appends nothing if it has fewer than three different corners.
bool append_face(PolygonSoup& soup, std::span<const Vec3f> corners, std::span<const Vec2f> uv,
                 std::size_t material);

// The outline around `triangles` (three indices each, all with the same winding), each corner once. Nothing
// if there are several outlines, holes, or a corner that occurs twice.
std::vector<std::uint32_t> outline_of(std::span<const std::uint32_t> triangles);

}  // namespace slipface
