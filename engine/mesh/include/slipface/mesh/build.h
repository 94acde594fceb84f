// Building a Mesh from polygons. Every importer ends with this; tests and generators use it to make levels
// without a file.
#pragma once

#include "slipface/base/result.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

// Polygons; the corners of a face are consecutive. Corners have either their own positions or indices.
struct PolygonSoup {
    std::vector<Vec3f> corner_position;        // [corner], metres; empty if the next two are given
    std::vector<Vec3f> vertex_position;        // [vertex], metres
    std::vector<std::uint32_t> corner_vertex;  // [corner] index into vertex_position
    std::vector<Vec2f> corner_uv;              // [corner], V up; or empty
    std::vector<std::uint32_t>
        face_first_corner;                     // [face + 1], starts with 0, ends with the number of corners
    std::vector<std::uint32_t> face_material;  // [face] index into materials; or empty: all of them 0
    std::vector<std::uint32_t> face_group;     // [face] index into groups; or empty: all of them 0
    std::vector<Material> materials;           // empty: one without a name
    std::vector<std::string> groups;           // empty: one without a name
    std::vector<MeshNode> nodes;               // as in Mesh
    std::vector<std::string> other_files;      // as in Mesh
    std::shared_ptr<Rig> rig;                  // of the corners above, or null
};

// Builds a mesh. Welds corners at exactly the same position into one vertex (-0 counts as 0) and numbers
// vertices in the order in which corners first use them. triangulate_polygon cuts the faces into triangles.
// Errors (without a location): arrays that do not fit together, indices out of range, faces of fewer than
// three corners, coordinates that are not finite, too little memory.
Result<MeshPtr> build_mesh(PolygonSoup soup);

// Mesh::fingerprint of what else is in the mesh.
std::uint64_t mesh_fingerprint(const Mesh& mesh);

}  // namespace slipface
