// The nodes of a glTF file's scene: where they stand, and what each places.
#pragma once

#include <vector>

#include "gltf/gltf_file.h"
#include "slipface/base/types.h"

namespace slipface {

using GltfMatrix = Eigen::Matrix4d;

struct GltfSceneNode {
    std::size_t number = 0;        // in the file
    std::uint32_t parent = no_id;  // index of a node before this one
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // unit
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();
    GltfMatrix local = GltfMatrix::Identity();  // of these three, or the node's own matrix
    GltfMatrix world = GltfMatrix::Identity();
};

GltfMatrix gltf_matrix(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation,
                       const Eigen::Vector3d& scale);

// The nodes of the scene that the file shows, parents before children, in the order of the file. Throws
// GltfRefused if a node has two parents.
std::vector<GltfSceneNode> gltf_nodes(const GltfFile& file);

// The extras of that scene.
GltfValue gltf_scene_extras(const GltfFile& file);

}  // namespace slipface
