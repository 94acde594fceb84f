// The light of a level: the parameters of the bake, and the image that holds its result.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "slipface/base/types.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

// Light colours are linear and may exceed 1. A white face in light of colour 1 is shown white.
struct LightEmitter {
    std::string pattern;  // faces whose material matches (as in MaterialRule) glow
    Vec3 color = Vec3::Ones();
    bool window = false;  // the sun shines through
    friend bool operator==(const LightEmitter&, const LightEmitter&) = default;
};

struct LevelLight {
    std::string image{};                // PNG in the level file's folder; empty: not baked yet
    std::uint64_t geometry = 0;         // LightCharts::geometry of the mesh it was baked for
    double texel_m = 0.25;              // edge of a texel of the light map, metres
    Vec3 sun_direction{0.5, 0.7, 0.5};  // towards the sun, any length
    Vec3 sun_color = Vec3::Zero();      // zero: no sun
    double sun_size = 0.02;             // sine of the sun's apparent radius: how soft shadows are
    Vec3 sky_zenith{0.30, 0.45, 0.75};  // colour of the sky's light, and of the drawn sky
    Vec3 sky_horizon{0.75, 0.80, 0.85};
    Vec3 ambient{0.10, 0.10, 0.10};  // stands for light that was reflected more than once
    double haze_m = 0.0;             // metres to where half of a face's colour is the horizon's; 0: no haze
    std::vector<LightEmitter> emitters{};  // the last one that matches a face wins
    friend bool operator==(const LevelLight&, const LevelLight&) = default;
};

// Whether the image was baked for the geometry that the mesh has now. If not, the level is drawn without it.
bool light_fits(const Mesh& mesh, const LevelLight& light);

// A byte b of a light map means light = light_map_range * (b / 255)^2.
inline constexpr double light_map_range = 2.0;

}  // namespace slipface
