// Props: instances of meshes that are loaded once, such as crates, columns and trees.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "slipface/collision/instances.h"
#include "slipface/mesh/animation.h"

namespace slipface {

struct Prop {
    // Unique among the props. It is also the name of the group of its faces, so a Platform with this group
    // moves it.
    std::string name;
    std::string mesh;              // geometry file, relative to the folder of the level's geometry
    Vec3 position = Vec3::Zero();  // metres
    Vec3 rotation = Vec3::Zero();  // radians, about z, then x, then y
    Vec3 scale = Vec3::Ones();     // along the mesh's own axes; a negative one mirrors
    std::string texture;           // image file, likewise relative; empty: the textures of the mesh
    std::string type;              // surface type of all its faces; empty: rules and suffixes decide
    Animation animation;           // its clip and the motion of its texture; collision sees it at rest
    Placement placement() const { return slipface::placement(position, rotation, scale); }
    friend bool operator==(const Prop&, const Prop&) = default;
};
inline constexpr std::size_t max_props = 100'000;     // of a level
inline constexpr std::size_t max_prop_meshes = 1000;  // of a level
inline constexpr double farthest_prop = 1e7;          // metres from the origin, along each axis
inline constexpr double smallest_prop_scale = 1e-3, largest_prop_scale = 1e3;
inline constexpr double largest_prop_rotation = 1000.0;  // radians

// Why `props` cannot be a level's props: a name that is empty or used twice, no mesh, a number out of range,
// more than max_props. Empty: they are valid.
std::string props_problem(std::span<const Prop> props);

// The geometry of one file, shared by all props that name it.
struct PropMesh {
    std::string file;                                // Prop::mesh
    MeshPtr mesh;                                    // null: it could not be read
    std::shared_ptr<const CollisionMesh> collision;  // of `mesh`
    std::string problem;                             // why
};

}  // namespace slipface
