// Exports a level for other programs. Every face carries its resolved type, whether that comes from paint,
// suffix or rule. Errors: no geometry; a path of the level's own files; a file that cannot be written; for
// OBJ and glTF a type's name that cannot be part of a material's name.
#pragma once

#include <span>

#include "slipface/level/level.h"

namespace slipface {

// NAME.obj and NAME.mtl: materials named MATERIAL__TYPE, coordinates in metres with +Y up, textures named as
// seen from the folder of `path`. Faces stay polygons, in their order; objects and groups keep their names.
Status export_obj(const Level& level, const std::filesystem::path& path);

// glTF 2.0: NAME.gltf with NAME.bin beside it, or a single NAME.glb. One primitive per material and type. The
// `extras` of material and primitive are {"slipface_type": "ice"}; those of the scene list every type with
// its parameters.
Status export_gltf(const Level& level, const std::filesystem::path& path);
// The same with further nodes in the scene.
struct GltfNode {
    std::string name;
    Vec3 position = Vec3::Zero();
    std::string extras;  // JSON
};
Status export_gltf(const Level& level, const std::filesystem::path& path, std::span<const GltfNode> nodes);

// One file that a game reads with a few lines (README.md), little-endian:
//   char magic[8] "slipflat"; u32 version (1), types, fields, vertices, triangles
//   fields x char[32]: names of a type's numbers ("friction"), zero-padded
//   types x { char name[32]; f32 values[fields] }: booleans as 0 and 1, NaN for a number that is not set
//   vertices x f32[3]
//   triangles x u32[3]
//   triangles x u8: the type
Status export_flat(const Level& level, const std::filesystem::path& path);

}  // namespace slipface
