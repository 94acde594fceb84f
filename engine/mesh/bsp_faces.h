// The drawn faces of a Quake 3 map.
#pragma once

#include <string>
#include <vector>

#include "bsp_file.h"
#include "bsp_walls.h"
#include "slipface/mesh/build.h"
#include "warning_list.h"

namespace slipface {

struct BspFaces {
    PolygonSoup soup;                // with the materials of all textures
    std::vector<BspTriangle> walls;  // of flat faces that stop a player
};

// Flat faces become polygons where their triangles form one outline, else triangles; meshes triangles;
// patches quads. `origins` [face] is where the model of a face stands; faces beyond its end stand at the
// origin. Every index is checked.
Result<BspFaces> read_bsp_faces(const BspFile& file, const std::vector<Vec3>& origins,
                                const std::string& location, WarningList& warnings);

// Appends a face; false, and nothing is appended, where it has no three different corners.
bool append_face(PolygonSoup& soup, std::span<const Vec3f> corners, std::span<const Vec2f> uv,
                 std::size_t material);

// The outline around `triangles` (three indices each, wound alike) where there is one without holes, each
// corner once; else nothing.
std::vector<std::uint32_t> outline_of(std::span<const std::uint32_t> triangles);

}  // namespace slipface
