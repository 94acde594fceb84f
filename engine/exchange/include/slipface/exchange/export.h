// Exports a level for other programs. Every face carries its resolved type, whether that comes from paint,
// suffix or rule.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "slipface/level/level.h"

namespace slipface {

struct ExportTargets {
    // NAME.obj and NAME.mtl: materials named MATERIAL__TYPE, coordinates in metres with +Y up, textures named
    // as seen from the folder of the file. Faces stay polygons, in their order; objects and groups keep their
    // names.
    std::optional<std::filesystem::path> obj = {};

    // glTF 2.0: NAME.gltf with NAME.bin beside it, or a single NAME.glb. One primitive per material and type.
    // The `extras` of material and primitive are {"slipface_type": "ice"}; those of the scene list every type
    // with its parameters.
    std::optional<std::filesystem::path> gltf = {};

    // One file that a game reads with a few lines (README.md), little-endian:
    //   char magic[8] "slipflat"; u32 version (1), types, fields, vertices, triangles
    //   fields x char[32]: names of a type's numbers ("friction"), zero-padded
    //   types x { char name[32]; f32 values[fields] }: booleans as 0 and 1, NaN for a number that is not set
    //   vertices x f32[3]
    //   triangles x u32[3]
    //   triangles x u8: the type
    std::optional<std::filesystem::path> flat = {};
};

// A further node of a glTF file's scene.
struct GltfNode {
    std::string name;
    Vec3 position = Vec3::Zero();
    std::string extras;  // JSON
};

// Writes all files of the targets, or none (write_files_atomic). Errors: no geometry; a target that is one of
// the level's own files, or a file of another target, unless both have the same bytes (a picture); a file
// that cannot be written; for OBJ and glTF a type's name that cannot be part of a material's name.
Status export_level(const Level& level, const ExportTargets& targets, std::span<const GltfNode> nodes = {});

}  // namespace slipface
