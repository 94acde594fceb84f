#include "gltf/objects.h"

#include <algorithm>
#include <cmath>
#include <map>

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

void add_props(const Level& level, std::vector<GltfObject>& objects) {
    auto group = static_cast<std::uint32_t>(own_mesh(level)->groups.size());
    std::map<MeshPtr, std::uint32_t> shapes;  // the first object of each mesh
    for (std::size_t i = 0; i < level.props.size() && has_instances(level); ++i) {
        const FaceId first = level.placed.first_face[i];
        if (first == level.placed.first_face[i + 1]) continue;
        const Prop& prop = level.props[i];
        GltfObject object{.name = prop.name, .group = group++};
        object.rest = find_prop_mesh(level, prop.mesh)->mesh;
        object.first_face = first;
        object.shape = shapes.try_emplace(object.rest, objects.size()).first->second;
        Eigen::Matrix4d world = Eigen::Matrix4d::Identity();
        const Placement at = prop.placement();
        for (int column = 0; column < 3; ++column)
            world.block<3, 1>(0, column) = at.columns[static_cast<std::size_t>(column)];
        world.topRightCorner<3, 1>() = at.offset;
        if (place(world, object)) object.world = matrix_of(object);
        objects.push_back(std::move(object));
    }
}

}  // namespace

std::vector<GltfObject> gltf_objects(const Level& level) {
    const Mesh& mesh = *own_mesh(level);
    const std::string level_name = level.mesh_path.stem().string();
    std::vector<GltfObject> objects = mesh.nodes.empty() ? objects_of_groups(mesh) : objects_of_nodes(mesh);
    add_props(level, objects);
    for (GltfObject& object : objects)
        if (object.name.empty()) object.name = level_name;
    return objects;
}

}  // namespace slipface
