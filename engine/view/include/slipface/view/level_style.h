// How a level is drawn: with textures or plain, which colours lie over its faces.
#pragma once

#include "slipface/base/types.h"

namespace slipface {

// What the overlay's colours show: the surface types, or how steep a face is for the player.
enum class FaceColors {
    types,
    slope,    // from flat through the limit to vertical; overhangs have their own colour
    walkable  // walkable, too steep, overhanging
};

struct LevelStyle {
    bool textured = true;     // false: plain shaded grey
    bool baked_light = true;  // with `textured`: the level's baked light and sky, if it has them
    float overlay =
        0.55f;  // strength of the surface types' colours and hatches, 0..1; `default` faces have none
    FaceColors colors = FaceColors::types;
    double max_slope = 0.8726646259971648;      // radians; the limit of types without one of their own
    bool wireframe = false;                     // face borders (polygon edges, not triangle edges)
    bool back_faces = true;                     // drawn darker and reddish; false: culled
    Vec3f background_top{0.16f, 0.18f, 0.21f};  // sRGB
    Vec3f background_bottom{0.09f, 0.10f, 0.12f};
};

}  // namespace slipface
