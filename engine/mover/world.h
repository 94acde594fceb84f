// What a handle of a world stands for: the world of a game's triangles, or that of a level (level.cpp).
#pragma once

#include <optional>

#include "handles.h"
#include "slipface/movement/scene.h"

namespace slipface::c {

struct World : Object {
    std::optional<MovementScene> now;  // what queries and steps see; always there

    virtual std::vector<SurfaceType>& types() = 0;
    virtual void types_changed() = 0;
    virtual std::size_t face_count() const = 0;  // of what does not move
    virtual void set_face_type(FaceId face, SurfaceId type) = 0;
};

}  // namespace slipface::c
