// Bakes the light and shadow of a level into one image, with the engine's own rays.
#pragma once

#include <functional>
#include <memory>

#include "slipface/image/image.h"
#include "slipface/level/level.h"
#include "slipface/mesh/light_charts.h"

namespace slipface {

struct LightQuality {
    int sky_rays = 48;  // per texel, over the hemisphere in front of it; at least 1
    int sun_rays = 5;   // per texel, over the sun's disc and the texel's area; at least 1
};

// Bakes `level.light` (which must be set) for `level.mesh`. For each texel of each face's chart:
//   light = visible fraction of the sun * cosine + visible emitting faces * their form factor
//         + mean over rays of (sky colour, or the colour and direct light of the surface that is hit).
// Only exactly rounded operations and a fixed set of rays are used: the same level gives the same bytes with
// every compiler and any number of threads.
class LightBaker {
  public:
    // Errors: no mesh, no light, a mesh that does not fit into a light map, a mesh that collision refuses.
    // Textures are read for their mean colour; if one cannot be read, the colour of the material is used.
    static Result<LightBaker> make(const Level& level, const LightQuality& quality = {});
    ~LightBaker();
    LightBaker(LightBaker&&) noexcept;
    LightBaker& operator=(LightBaker&&) noexcept;

    const LightCharts& charts() const;

    // The whole map. `progress`, if given, is called with the fraction done, 0 to 1, from any thread.
    Image bake(const std::function<void(double)>& progress = {}) const;

    // The texels of one face, row by row from the top, as red, green and blue: the same bytes that bake()
    // writes.
    std::vector<std::uint8_t> bake_face(FaceId face) const;

  private:
    struct Impl;
    explicit LightBaker(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

// Bakes the level's light into NAME.light.png beside its level file, records the image in `level.light` (a
// sun and a sky are added if it has none) and saves the level file: both files or neither. Errors: those of
// LightBaker::make(), encode_png() and write_files_atomic().
Status bake_level_light(Level& level, const LightQuality& quality = {},
                        const std::function<void(double)>& progress = {});

}  // namespace slipface
