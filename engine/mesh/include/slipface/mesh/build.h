// Making a Mesh from polygons: what every importer ends with, and how tests and generators make levels
// without a file.
#pragma once

#include "slipface/base/result.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

// Polygons; corners of a face are consecutive. Each corner has a position of its own, or an index to one.
struct PolygonSoup {
    std::vector<Vec3f> corner_position;        // [corner], metres; empty where the next two are given
    std::vector<Vec3f> vertex_position;        // [vertex], metres
    std::vector<std::uint32_t> corner_vertex;  // [corner] index into vertex_position
    std::vector<Vec2f> corner_uv;              // [corner], V up; or empty
    std::vector<std::uint32_t>
        face_first_corner;                     // [face + 1], starts with 0, ends with the number of corners
    std::vector<std::uint32_t> face_material;  // [face] index into materials; or empty: all of them 0
    std::vector<std::uint32_t> face_group;     // [face] index into groups; or empty: all of them 0
    std::vector<Material> materials;           // empty: one without a name
    std::vector<std::string> groups;           // empty: one without a name
};

// Corners at exactly the same position become one vertex (-0 counts as 0); vertices are numbered as corners
// first use them. Faces are cut into triangles by triangulate_polygon. Refuses spans that do not fit
// together, indices out of range, faces of fewer than three corners and coordinates that are not finite.
Result<MeshPtr> build_mesh(PolygonSoup soup);

}  // namespace slipface
