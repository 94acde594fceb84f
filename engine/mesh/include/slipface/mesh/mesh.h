// The immutable geometry of a level: polygons as authored, and their triangles.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "slipface/base/types.h"

namespace slipface {

struct Rig;

struct Material {
    std::string name;                       // as in `newmtl`; empty for faces without a material
    Vec3f diffuse = Vec3f::Constant(0.8f);  // Kd, 0..1, sRGB as authored
    std::string texture;                    // image file, relative to the level's folder; empty: none
    // The image file's content if the mesh's own file contains it (glTF, FBX); then `texture` is only a name.
    std::shared_ptr<const std::string> picture = nullptr;
};

// An object of a file that places its objects in a tree (glTF, FBX, COLLADA and others).
struct MeshNode {
    std::string name;
    std::uint32_t parent = no_id;  // index of a node before this one; no_id: none
    std::uint32_t group = no_id;  // the faces of the object, already in the level's space; no_id: it has none
    std::uint32_t shape = no_id;  // the first node with the same faces, of which this one is a copy
    Eigen::Matrix4f world = Eigen::Matrix4f::Identity();  // from the object's own space to the level's
};

// Groups that touch share vertices here, but each can have its own in the file.
struct GroupVertex {
    std::uint32_t group = 0, vertex = 0;
    std::uint32_t number = 0;  // the index in the file of the group's first one there
};

// A *face* is one polygon of the file, in the winding of the file (counter-clockwise seen from the front).
// Its corners are consecutive in the corner arrays. A *triangle* is three corner indices of one face.
struct Mesh {
    std::vector<Vec3f> positions;                         // [vertex], metres; shared between faces
    std::vector<std::uint32_t> vertex_number;             // [vertex] its index in the file, or empty: as here
    std::vector<GroupVertex> group_vertices;              // those with another one; by group, then by vertex
    std::vector<std::uint32_t> corner_vertex;             // [corner] index into positions
    std::vector<Vec2f> corner_uv;                         // [corner], V up; zero if the file gives none
    std::vector<std::uint32_t> face_first_corner;         // [face + 1], ends with the number of corners
    std::vector<std::uint32_t> face_material;             // [face] index into materials
    std::vector<std::uint32_t> face_group;                // [face] index into groups
    std::vector<std::array<std::uint32_t, 3>> triangles;  // [triangle] corner indices
    std::vector<FaceId> triangle_face;                    // [triangle] ascending
    std::vector<std::uint32_t> face_first_triangle;       // [face + 1], ends with the number of triangles
    std::vector<Material> materials;                      // at least one
    std::vector<std::string> groups;                      // object and group names; at least one
    std::vector<MeshNode> nodes;                          // parents first; empty if the file has no tree
    // Paths of the other files that this one names, read or not: MTL files, buffers of glTF. Pictures are in
    // `materials`.
    std::vector<std::string> other_files;
    Aabb bounds;
    std::shared_ptr<const Rig> rig;  // how it moves (rig.h); null: it has no clips
    std::uint64_t fingerprint = 0;   // of positions, faces and material names

    std::size_t face_count() const { return face_material.size(); }
    std::size_t triangle_count() const { return triangles.size(); }

    // The number of corners of `face`; the first is face_first_corner[face].
    std::uint32_t face_corner_count(FaceId face) const {
        return face_first_corner[face + 1] - face_first_corner[face];
    }
    Vec3f corner_position(std::uint32_t corner) const { return positions[corner_vertex[corner]]; }
    // The index of the vertex in the file; `group` no_id: of the first one at its position.
    std::uint32_t number_in_group(std::uint32_t group, std::uint32_t vertex) const;
};

// All faces, group after group, those of a group in the order of the file.
std::vector<FaceId> faces_by_group(const Mesh& mesh);

using MeshPtr = std::shared_ptr<const Mesh>;

// Newell's normal of a face: unit length, or zero for a face without area. Source: Newell's method, the sum
// of the cross products of consecutive corners; exact for planar polygons, an average for bent ones.
Vec3 face_normal(const Mesh& mesh, FaceId face);

// The mean of the face's corners, world space.
Vec3 face_centroid(const Mesh& mesh, FaceId face);

// The area of a face, square metres: half the length of Newell's sum.
double face_area(const Mesh& mesh, FaceId face);

// The faces that share an edge (the same two vertices, in either direction) with each face, as one flat list:
// neighbours of `face` are list[first[face]] .. list[first[face + 1] - 1], ascending, without repeats.
struct FaceNeighbours {
    std::vector<std::uint32_t> first;  // [face + 1]
    std::vector<FaceId> list;
    std::span<const FaceId> of(FaceId face) const {
        return std::span(list).subspan(first[face], first[face + 1] - first[face]);
    }
};

// Vertices at exactly the same position count as one, so meshes that are split at materials or seams still
// connect. If many faces share one edge, each is linked with the next `max_linked_faces` only: the list stays
// linear in the size of the mesh, and connected faces stay connected.
inline constexpr std::size_t max_linked_faces = 8;
FaceNeighbours face_neighbours(const Mesh& mesh);

}  // namespace slipface
