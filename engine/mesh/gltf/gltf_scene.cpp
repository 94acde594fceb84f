// Source: glTF 2.0, section 3.5.
#include "gltf/gltf_scene.h"

#include <fmt/format.h>

#include <array>

namespace slipface {
namespace {

GltfValue shown_scene(const GltfFile& file) {
    const GltfValue scene = file.root()["scene"];
    if (scene) return file.element("scenes", scene);
    const GltfValue scenes = file.root()["scenes"];
    return scenes.size() > 0 ? scenes.at(0) : scenes;
}

void read_place(const GltfValue& from, GltfSceneNode& node) {
    std::array<float, 3> translation{0, 0, 0}, scale{1, 1, 1};
    std::array<float, 4> rotation{0, 0, 0, 1};
    from["translation"].numbers(translation.data(), 3);
    from["rotation"].numbers(rotation.data(), 4);
    from["scale"].numbers(scale.data(), 3);
    node.translation = {translation[0], translation[1], translation[2]};
    node.scale = {scale[0], scale[1], scale[2]};
    const Eigen::Quaterniond turn(rotation[3], rotation[0], rotation[1], rotation[2]);
    if (turn.norm() > 1e-6) node.rotation = turn.normalized();
    node.local = gltf_matrix(node.translation, node.rotation, node.scale);
    if (const GltfValue matrix = from["matrix"]) {
        std::array<float, 16> numbers{};
        matrix.numbers(numbers.data(), numbers.size());
        node.local = Eigen::Map<const Eigen::Matrix4f>(numbers.data()).cast<double>();
    }
}

}  // namespace

GltfMatrix gltf_matrix(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation,
                       const Eigen::Vector3d& scale) {
    GltfMatrix matrix = GltfMatrix::Identity();
    matrix.topLeftCorner<3, 3>() = rotation.toRotationMatrix() * scale.asDiagonal();
    matrix.topRightCorner<3, 1>() = translation;
    return matrix;
}

std::vector<GltfSceneNode> gltf_nodes(const GltfFile& file) {
    struct Open {
        std::size_t number;
        std::uint32_t parent;
    };
    const GltfValue list = file.root()["nodes"];
    std::vector<Open> open;
    const auto add = [&](const GltfValue& references, std::uint32_t parent) {
        for (std::size_t i = references.size(); i-- > 0;) {
            file.element("nodes", references.at(i));
            open.push_back({static_cast<std::size_t>(references.at(i).whole()), parent});
        }
    };
    if (const GltfValue scene = shown_scene(file)) {
        add(scene["nodes"], no_id);
    } else {  // without a scene, all nodes that are no children
        std::vector<bool> child(list.size());
        for (std::size_t i = 0; i < list.size(); ++i) {
            const GltfValue children = list.at(i)["children"];
            for (std::size_t k = 0; k < children.size(); ++k) {
                file.element("nodes", children.at(k));
                child[children.at(k).whole()] = true;
            }
        }
        for (std::size_t i = list.size(); i-- > 0;)
            if (!child[i]) open.push_back({i, no_id});
    }
    std::vector<GltfSceneNode> nodes;
    std::vector<bool> met(list.size());
    while (!open.empty()) {
        const Open next = open.back();
        open.pop_back();
        const GltfValue from = list.at(next.number);
        if (met[next.number]) from.refuse("stands at two places of the tree of nodes");
        met[next.number] = true;
        GltfSceneNode& node = nodes.emplace_back();
        node.number = next.number;
        node.parent = next.parent;
        read_place(from, node);
        node.world = next.parent == no_id ? node.local : (nodes[next.parent].world * node.local).eval();
        add(from["children"], static_cast<std::uint32_t>(nodes.size() - 1));
    }
    return nodes;
}

GltfValue gltf_scene_extras(const GltfFile& file) {
    return shown_scene(file)["extras"];
}

}  // namespace slipface
