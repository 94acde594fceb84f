#include "assimp/scene_rig.h"

#include <assimp/anim.h>
#include <assimp/mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assimp/scene_materials.h"

namespace slipface {
namespace {

Affine affine_of(const aiMatrix4x4& matrix) {
    Affine affine;
    for (unsigned row = 0; row < 3; ++row)
        for (unsigned column = 0; column < 4; ++column)
            affine(row, column) = matrix[row][column];
    return affine;
}

Vec3f vector_of(const aiVector3D& from) {
    return {from.x, from.y, from.z};
}

// Keys as a track: `put` appends the numbers of one. Keys that go back in time are left out.
template <class Key, class Put>
void add_track(const Key* keys, unsigned count, double ticks_per_second, std::uint32_t node,
               RigTrack::Moves moves, Clip& clip, const Put& put) {
    RigTrack track;
    track.node = node;
    track.moves = moves;
    for (unsigned i = 0; i < count; ++i) {
        const auto at = static_cast<float>(keys[i].mTime / ticks_per_second);
        if (!std::isfinite(at) || at < 0.0F || (!track.times.empty() && !(at > track.times.back()))) continue;
        track.times.push_back(at);
        put(keys[i], track.values);
    }
    const bool finite =
        std::all_of(track.values.begin(), track.values.end(), [](float v) { return std::isfinite(v); });
    if (track.times.empty() || !finite) return;
    clip.seconds = std::max(clip.seconds, track.times.back());
    clip.tracks.push_back(std::move(track));
}

}  // namespace

std::vector<SceneNode> scene_nodes(const aiScene& scene, bool root_is_frame) {
    struct Open {
        const aiNode* node;
        std::uint32_t parent;
    };
    std::vector<SceneNode> nodes;
    std::vector<Open> open{{scene.mRootNode, no_id}};  // not recursive: the file determines the depth
    while (!open.empty()) {
        const Open next = open.back();
        open.pop_back();
        if (next.node == nullptr) continue;
        SceneNode& node = nodes.emplace_back();
        node.node = next.node;
        node.parent = next.parent;
        if (!(root_is_frame && next.node == scene.mRootNode)) node.local = next.node->mTransformation;
        node.world = next.parent == no_id ? node.local : nodes[next.parent].world * node.local;
        const auto index = static_cast<std::uint32_t>(nodes.size() - 1);
        for (unsigned i = next.node->mNumChildren; i-- > 0;)
            open.push_back({next.node->mChildren[i], index});
    }
    return nodes;
}

SceneRig::SceneRig(const aiScene& scene, const std::vector<SceneNode>& nodes) : scene_(scene), nodes_(nodes) {
    Rig rig;
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        index_of_.try_emplace(text_of(nodes[i].node->mName), i);
        RigNode& node = rig.nodes.emplace_back();
        node.parent = nodes[i].parent;
        node.local = affine_of(nodes[i].local);
        aiVector3D scale, position;
        aiQuaternion rotation;
        nodes[i].local.Decompose(scale, rotation, position);
        node.translation = vector_of(position);
        node.scale = vector_of(scale);
        node.rotation = {rotation.x, rotation.y, rotation.z, rotation.w};
        node.first_weight = static_cast<std::uint32_t>(rig.weights.size());
        first_weight_.push_back(node.first_weight);
        for (unsigned k = 0; k < nodes[i].node->mNumMeshes; ++k) {
            const unsigned number = nodes[i].node->mMeshes[k];
            if (number >= scene.mNumMeshes) continue;
            const aiMesh& mesh = *scene.mMeshes[number];
            // The meshes of a node, one for each material, share their targets.
            for (unsigned target = node.weights; target < mesh.mNumAnimMeshes; ++target) {
                rig.weights.push_back(mesh.mAnimMeshes[target]->mWeight);
                ++node.weights;
            }
        }
    }
    read_clips(rig);
    if (!rig.clips.empty()) corners_ = RigCorners(std::move(rig));
}

void SceneRig::read_clips(Rig& rig) const {
    for (unsigned i = 0; i < scene_.mNumAnimations; ++i) {
        const aiAnimation& from = *scene_.mAnimations[i];
        const double rate = from.mTicksPerSecond > 0.0 ? from.mTicksPerSecond : 25.0;  // assimp's own guess
        Clip clip;
        clip.name = text_of(from.mName);
        if (clip.name.empty()) clip.name = fmt::format("clip {}", i + 1);
        for (unsigned k = 0; k < from.mNumChannels; ++k) {
            const aiNodeAnim& channel = *from.mChannels[k];
            const auto node = index_of_.find(text_of(channel.mNodeName));
            if (node == index_of_.end()) continue;
            const auto put_vector = [](const aiVectorKey& key, std::vector<float>& to) {
                to.insert(to.end(), {key.mValue.x, key.mValue.y, key.mValue.z});
            };
            const auto put_turn = [](const aiQuatKey& key, std::vector<float>& to) {
                to.insert(to.end(), {key.mValue.x, key.mValue.y, key.mValue.z, key.mValue.w});
            };
            using Moves = RigTrack::Moves;
            add_track(channel.mPositionKeys, channel.mNumPositionKeys, rate, node->second, Moves::translation,
                      clip, put_vector);
            add_track(channel.mRotationKeys, channel.mNumRotationKeys, rate, node->second, Moves::rotation,
                      clip, put_turn);
            add_track(channel.mScalingKeys, channel.mNumScalingKeys, rate, node->second, Moves::scale, clip,
                      put_vector);
        }
        for (unsigned k = 0; k < from.mNumMorphMeshChannels; ++k) {
            const aiMeshMorphAnim& channel = *from.mMorphMeshChannels[k];
            const auto node = index_of_.find(text_of(channel.mName));
            if (node == index_of_.end()) continue;
            const std::size_t count = rig.nodes[node->second].weights;
            if (count == 0) continue;
            add_track(channel.mKeys, channel.mNumKeys, rate, node->second, RigTrack::Moves::weights, clip,
                      [&](const aiMeshMorphKey& key, std::vector<float>& to) {
                          const std::size_t first = to.size();
                          to.resize(first + count, 0.0F);
                          for (unsigned w = 0; w < key.mNumValuesAndWeights; ++w)
                              if (key.mValues[w] < count)
                                  to[first + key.mValues[w]] = static_cast<float>(key.mWeights[w]);
                      });
        }
        std::stable_sort(clip.tracks.begin(), clip.tracks.end(),
                         [](const RigTrack& a, const RigTrack& b) { return a.node < b.node; });
        if (!clip.tracks.empty()) rig.clips.push_back(std::move(clip));
    }
}

void SceneRig::begin_mesh(const aiMesh& mesh, std::uint32_t node) {
    mesh_ = &mesh;
    node_ = node;
    matrices_.clear();
    binds_.clear();
    bone_node_.clear();
    influences_.clear();
    for (unsigned i = 0; i < mesh.mNumBones; ++i) {
        const aiBone& bone = *mesh.mBones[i];
        const auto joint = index_of_.find(text_of(bone.mName));
        if (joint == index_of_.end()) continue;
        influences_.resize(mesh.mNumVertices);
        for (unsigned k = 0; k < bone.mNumWeights; ++k)
            if (bone.mWeights[k].mVertexId < mesh.mNumVertices && bone.mWeights[k].mWeight > 0.0F)
                influences_[bone.mWeights[k].mVertexId].push_back(
                    {matrices_.size(), bone.mWeights[k].mWeight});
        matrices_.push_back(nodes_[joint->second].world * bone.mOffsetMatrix);
        binds_.push_back(bone.mOffsetMatrix);
        bone_node_.push_back(joint->second);
    }
    if (!matrices_.empty()) return;
    matrices_.push_back(nodes_[node].world);
    binds_.emplace_back();
    bone_node_.push_back(node);
}

aiVector3D SceneRig::own(unsigned vertex) const {
    aiVector3D position = mesh_->mVertices[vertex];
    for (unsigned i = 0; i < mesh_->mNumAnimMeshes; ++i) {
        const aiAnimMesh& target = *mesh_->mAnimMeshes[i];
        if (target.HasPositions() && vertex < target.mNumVertices && target.mWeight != 0.0F)
            position += target.mWeight * (target.mVertices[vertex] - mesh_->mVertices[vertex]);
    }
    return position;
}

aiVector3D SceneRig::placed(unsigned vertex) const {
    const aiVector3D from = own(vertex);
    if (influences_.empty() || influences_[vertex].empty()) return matrices_.front() * from;
    aiVector3D at;
    float sum = 0.0F;
    for (const Influence& influence : influences_[vertex]) {
        at += influence.weight * (matrices_[influence.bone] * from);
        sum += influence.weight;
    }
    return at / sum;
}

void SceneRig::add_corner(unsigned vertex) {
    if (!corners_) return;
    const auto bone = [&](std::size_t i) { return corners_.bone(bone_node_[i], affine_of(binds_[i])); };
    corners_.begin_corner(vector_of(mesh_->mVertices[vertex]));
    if (!influences_.empty())
        for (const Influence& influence : influences_[vertex])
            corners_.follow(bone(influence.bone), influence.weight);
    for (unsigned i = 0; i < mesh_->mNumAnimMeshes; ++i) {
        const aiAnimMesh& target = *mesh_->mAnimMeshes[i];
        if (target.HasPositions() && vertex < target.mNumVertices)
            corners_.morph(first_weight_[node_] + i,
                           vector_of(target.mVertices[vertex] - mesh_->mVertices[vertex]));
    }
    corners_.end_corner(bone(0));
}

}  // namespace slipface
