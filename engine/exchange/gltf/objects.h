// The objects of a level as glTF places them.
#pragma once

#include <string>
#include <vector>

#include "slipface/level/level.h"

namespace slipface {

struct GltfObject {
    std::string name;
    std::uint32_t parent = no_id;  // index of an object before this one
    std::uint32_t group = no_id;   // of the mesh; no_id: no faces of its own
    std::uint32_t shape = no_id;   // as in MeshNode
    bool has_children = false;
    // Of a prop: its mesh, whose face 0 is the level's first_face.
    MeshPtr rest{};
    FaceId first_face = 0;
    // Relative to the parent: glTF's translation, rotation and scale.
    Vec3f translation = Vec3f::Zero();
    Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
    Vec3f scale = Vec3f::Ones();
    Eigen::Matrix4d world = Eigen::Matrix4d::Identity();  // what these and the parents' make together
};

// The nodes of the level's own mesh, or its groups if the file had no nodes, and then the props that have
// faces; the name of the level's geometry for one without a name. A node whose place is no translation,
// rotation and scale (a sheared or flattened one) stands where its parent does.
std::vector<GltfObject> gltf_objects(const Level& level);

}  // namespace slipface
