#include "gltf/physics.h"

namespace slipface {

GltfJson GltfPhysics::collider(const std::string& name, SurfaceId surface, std::size_t mesh,
                               std::size_t mesh_node) {
    const SurfaceType& type = surfaces_[surface];
    const auto [shape, new_shape] = shape_of_mesh_.try_emplace(mesh, shapes_.size());
    if (new_shape) shapes_.push_back({{"type", "trimesh"}, {"trimesh", {{"mesh", mesh}}}});
    const auto [material, new_material] = material_of_type_.try_emplace(surface, materials_.size());
    if (new_material) {
        const double friction = type.keeps_energy ? 0.0 : type.friction;
        materials_.push_back(
            {{"staticFriction", friction}, {"dynamicFriction", friction}, {"restitution", type.restitution}});
    }
    const GltfJson omi{{"shape", shape->second}, {"physicsMaterial", material->second}};
    const GltfJson khr{{"geometry", {{"node", mesh_node}}}, {"physicsMaterial", material->second}};
    return {{"name", name},
            {"extensions",
             {{"OMI_physics_body", {{"collider", omi}}}, {"KHR_physics_rigid_bodies", {{"collider", khr}}}}},
            {"extras", {{"slipface_type", type.name}}}};
}

void GltfPhysics::append_to(GltfJson& root) const {
    if (shapes_.empty()) return;
    root["extensionsUsed"] = {"OMI_physics_shape", "OMI_physics_body", "KHR_physics_rigid_bodies"};
    root["extensions"] = {{"OMI_physics_shape", {{"shapes", shapes_}}},
                          {"OMI_physics_body", {{"physicsMaterials", materials_}}},
                          {"KHR_physics_rigid_bodies", {{"physicsMaterials", materials_}}}};
}

}  // namespace slipface
