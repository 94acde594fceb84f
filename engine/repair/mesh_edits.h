// Small changes of a mesh that keep its faces and their numbers.
#pragma once

#include "slipface/mesh/mesh.h"

namespace slipface {

// Moves the corners of one face beside a gap onto the other's edge, those within `widest` metres of `place`
// or as near to the gap as that is wide. Returns how far the farthest was moved, metres; 0: nothing to move.
double close_gap(Mesh& mesh, FaceId face, FaceId other, const Vec3& position, double widest);

// Turns a face's front to its back.
void flip_face(Mesh& mesh, FaceId face);

// Lets an upright face of at most `highest` metres vanish: its upper corners go down to its lower ones.
// Returns its height; 0: it is no such face.
double flatten_riser(Mesh& mesh, FaceId face, double highest);

// Moves the corners of the faces up by `metres`, or those that are higher down to the height `to`.
void raise_faces(Mesh& mesh, std::span<const FaceId> faces, double metres);
void lower_faces(Mesh& mesh, std::span<const FaceId> faces, double to);

}  // namespace slipface
