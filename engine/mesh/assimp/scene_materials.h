// The materials of a scene that assimp read, with the pictures that its file contains.
#pragma once

#include <assimp/material.h>
#include <assimp/scene.h>

#include <string>
#include <vector>

#include "slipface/mesh/mesh.h"

namespace slipface {

struct SceneMaterial {
    Material material;
    // How the corners' texture positions follow from the mesh's.
    unsigned uv_set = 0;
    Eigen::Matrix<float, 2, 3> uv_transform = Eigen::Matrix<float, 2, 3>::Identity();  // V up
};

// A name of the file as UTF-8.
std::string text_of(const aiString& text);

// `extension`: of the file, which decides what colours, names of pictures and texture transforms mean.
std::vector<SceneMaterial> scene_materials(const aiScene& scene, const std::string& extension);

}  // namespace slipface
