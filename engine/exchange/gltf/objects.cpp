#include "gltf/objects.h"

#include <algorithm>

namespace slipface {
namespace {

// Sets the object's place relative to its parent. False if `local` is none of this form.
bool place(const Eigen::Matrix4d& local, GltfObject& object) {
    constexpr double thinnest = 1e-9, largest_shear = 1e-4;
    Eigen::Matrix3d rotation = local.topLeftCorner<3, 3>();
    if (!local.allFinite()) return false;
    Vec3 scale = rotation.colwise().norm().transpose();
    if (!(scale.minCoeff() > thinnest)) return false;
    if (rotation.determinant() < 0.0) scale.x() = -scale.x();
    for (int axis = 0; axis < 3; ++axis)
        rotation.col(axis) /= scale[axis];
    const Eigen::Matrix3d product = rotation.transpose() * rotation;
    if (!product.isIdentity(largest_shear)) return false;
    object.translation = local.topRightCorner<3, 1>().cast<float>();
    object.scale = scale.cast<float>();
    for (float& factor : object.scale)
        if (std::abs(factor - 1.0F) < 1e-6F) factor = 1.0F;
    const Eigen::Quaternionf turned = Eigen::Quaterniond(rotation).cast<float>().normalized();
    if (turned.vec().cwiseAbs().maxCoeff() > 1e-7F) object.rotation = turned;
    return true;
}

Eigen::Matrix4d matrix_of(const GltfObject& object) {
    Eigen::Affine3d local = Eigen::Affine3d::Identity();
    local.translate(object.translation.cast<double>());
    local.rotate(object.rotation.cast<double>().normalized());
    local.scale(object.scale.cast<double>());
    return local.matrix();
}

std::vector<GltfObject> objects_of_groups(const Mesh& mesh) {
    std::vector<bool> used(mesh.groups.size());
    for (const std::uint32_t group : mesh.face_group)
        used[group] = true;
    std::vector<GltfObject> objects;
    for (std::uint32_t group = 0; group < mesh.groups.size(); ++group) {
        if (!used[group]) continue;
        objects.push_back({.name = mesh.groups[group], .group = group});
    }
    return objects;
}

std::vector<GltfObject> objects_of_nodes(const Mesh& mesh) {
    std::vector<GltfObject> objects;
    for (const MeshNode& node : mesh.nodes) {
        GltfObject object{.name = node.name, .parent = node.parent, .group = node.group, .shape = node.shape};
        Eigen::Matrix4d above = Eigen::Matrix4d::Identity();
        if (node.parent != no_id) {
            above = objects[node.parent].world;
            objects[node.parent].has_children = true;
        }
        object.world = above;
        if (place(above.inverse() * node.world.cast<double>(), object)) object.world *= matrix_of(object);
        objects.push_back(std::move(object));
    }
    return objects;
}

}  // namespace

std::vector<GltfObject> gltf_objects(const Mesh& mesh, const std::string& level_name) {
    std::vector<GltfObject> objects = mesh.nodes.empty() ? objects_of_groups(mesh) : objects_of_nodes(mesh);
    for (GltfObject& object : objects)
        if (object.name.empty()) object.name = level_name;
    return objects;
}

}  // namespace slipface
