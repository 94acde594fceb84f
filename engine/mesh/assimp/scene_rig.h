// The nodes of a scene that assimp read, and what its bones, morph targets and clips do to vertices.
#pragma once

#include <assimp/scene.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rig_corners.h"
#include "slipface/base/types.h"

namespace slipface {

struct SceneNode {
    const aiNode* node = nullptr;
    std::uint32_t parent = no_id;  // a node before this one
    aiMatrix4x4 local, world;
};

// Children before siblings, in the order of the file. `root_is_frame`: the root does not move anything.
std::vector<SceneNode> scene_nodes(const aiScene& scene, bool root_is_frame);

class SceneRig {
  public:
    // Both must outlive it.
    SceneRig(const aiScene& scene, const std::vector<SceneNode>& nodes);

    // The mesh whose vertices follow, where `node` places it; bones place it instead.
    void begin_mesh(const aiMesh& mesh, std::uint32_t node);
    bool mirrored() const { return matrices_.front().Determinant() < 0.0F; }
    aiVector3D placed(unsigned vertex) const;  // at rest, in the file's space
    void add_corner(unsigned vertex);          // of a mesh that moves; nothing if the file has no clips
    std::shared_ptr<Rig> take() { return corners_.take(); }

  private:
    struct Influence {
        std::size_t bone = 0;  // of matrices_
        float weight = 0.0F;
    };
    void read_clips(Rig& rig) const;
    aiVector3D own(unsigned vertex) const;  // with the morph targets' weights

    const aiScene& scene_;
    const std::vector<SceneNode>& nodes_;
    std::map<std::string, std::uint32_t> index_of_;  // [name] the first node
    std::vector<std::uint32_t> first_weight_;        // [node]
    RigCorners corners_;
    // Of the mesh that was begun: the node's matrix, or those of its bones.
    const aiMesh* mesh_ = nullptr;
    std::uint32_t node_ = 0;
    std::vector<aiMatrix4x4> matrices_, binds_;
    std::vector<std::uint32_t> bone_node_;
    std::vector<std::vector<Influence>> influences_;  // [vertex]; empty without bones
};

}  // namespace slipface
