// A level for other programs. Every face brings its type along, whatever gave it: paint, suffix or rule.
#pragma once

#include "slipface/level/level.h"

namespace slipface {

// NAME.obj and NAME.mtl: materials named MATERIAL__TYPE, coordinates in metres with +Y up, textures named as
// seen from the folder of `path`. Faces stay polygons, in their order; objects and groups keep their names.
Status export_obj(const Level& level, const std::filesystem::path& path);

// glTF 2.0: NAME.gltf with NAME.bin beside it, or all in one NAME.glb. One primitive a material and type; the
// material's and the primitive's `extras` say {"slipface_type": "ice"}, the scene's list every type with its
// parameters.
Status export_gltf(const Level& level, const std::filesystem::path& path);

// One file that a game reads with a few lines (README.md), little-endian:
//   char magic[8] "slipflat"; u32 version (1), types, fields, vertices, triangles
//   fields x char[32]: what a type's numbers are ("friction"), zero-padded
//   types x { char name[32]; f32 values[fields] }: booleans as 0 and 1, not a number where a type says
//   nothing vertices x f32[3]; triangles x u32[3]; triangles x u8: the type
Status export_flat(const Level& level, const std::filesystem::path& path);

}  // namespace slipface
