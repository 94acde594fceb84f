// The props of a level as LevelMesh knows them: their list may change without it.
#pragma once

#include <mutex>
#include <vector>

#include "slipface/level/level.h"

namespace slipface {

struct PlacedGeometry {
    struct One {  // what counts of a Prop
        std::string name, texture;
        Vec3 position, rotation, scale;
    };
    std::vector<One> props;
    std::vector<PropMesh> files;         // PlacedProps::meshes
    std::vector<std::uint32_t> file_of;  // [prop] in `files`; no_id: it has no faces
    std::vector<Placement> places;       // [prop]
    std::vector<Aabb> boxes;             // [prop]
    std::vector<FaceId> first_face;      // [prop + 1]
    std::size_t triangles = 0;           // with the level's own
    Aabb bounds;                         // likewise
    std::uint64_t fingerprint = 0;       // likewise
    mutable std::once_flag once;
    mutable MeshPtr whole;

    // Null: the prop has no faces.
    const Mesh* mesh(std::size_t prop) const {
        return file_of[prop] == no_id ? nullptr : files[file_of[prop]].mesh.get();
    }
};

}  // namespace slipface
