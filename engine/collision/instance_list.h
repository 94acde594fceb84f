// The instances of a world.
#pragma once

#include "impl.h"

namespace slipface {

// Replaces the instances of a world that has its soup. Errors: see CollisionWorld::build(); then nothing
// changes.
Status replace_instances(CollisionWorld::Impl& impl, std::span<const Instance> instances);

// Faces that belong to no instance are ignored, and have the default type.
void set_instance_surface(CollisionWorld::Impl& impl, FaceId face, SurfaceId surface);
SurfaceId instance_surface(const CollisionWorld::Impl& impl, FaceId face);
// `surfaces`: [face] of the whole world. Instances of one mesh with the same types then share their list.
void set_instance_surfaces(CollisionWorld::Impl& impl, std::span<const SurfaceId> surfaces);

// Of the meshes and lists of types, each counted once.
std::size_t bytes_of_meshes(const CollisionWorld::Impl& impl);

}  // namespace slipface
