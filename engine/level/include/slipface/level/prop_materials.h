// The materials of a prop as its level has them.
#pragma once

#include <string>
#include <vector>

#include "slipface/mesh/mesh.h"

namespace slipface {

// Returns the materials of a prop's mesh, `file` (Prop::mesh). Names of textures are relative to the folder
// of the level's geometry, so that one rule decides what is read (read_texture()). `texture` (Prop::texture),
// if not empty, is on all faces.
std::vector<Material> prop_materials(const Mesh& mesh, const std::string& file, const std::string& texture);

// The mesh with these materials, to be drawn with the textures of the level's folder; `mesh` itself if they
// are equal.
MeshPtr drawn_prop_mesh(const MeshPtr& mesh, const std::string& file, const std::string& texture);

}  // namespace slipface
