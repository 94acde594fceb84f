// Light and shadow of a level, computed with the engine's own rays and baked into one picture.
#pragma once

#include <functional>
#include <memory>

#include "slipface/image/image.h"
#include "slipface/level/level.h"
#include "slipface/mesh/light_charts.h"

namespace slipface {

struct LightQuality {
    int sky_rays = 48;  // a texel, over the half of space in front of it
    int sun_rays = 5;   // a texel, over the sun's disc and the texel's area
};

// Bakes `level.light` (which must be there) for `level.mesh`. For each texel of each face's chart:
//   light = sun seen * cosine + emitting faces seen * their form factor
//         + mean over rays of (sky colour, or the colour and direct light of what is hit).
// Only exactly rounded operations and a fixed set of rays: the same level gives the same bytes with every
// compiler and any number of threads.
class LightBaker {
  public:
    // Errors: no mesh, no light, a mesh without room in a light map. Textures are read for their mean colour;
    // those that cannot be read count with the material's own.
    static Result<LightBaker> make(const Level& level, const LightQuality& quality = {});
    ~LightBaker();
    LightBaker(LightBaker&&) noexcept;
    LightBaker& operator=(LightBaker&&) noexcept;

    const LightCharts& charts() const;

    // The whole map. `progress`, if given, is told the fraction done, from any thread.
    Image bake(const std::function<void(double)>& progress = {}) const;

    // The texels of one face, row by row from the top, red, green and blue: what bake() writes there.
    std::vector<std::uint8_t> bake_face(FaceId face) const;

  private:
    struct Impl;
    explicit LightBaker(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

// Bakes the level's light into NAME.light.png beside its level file and notes it in `level.light` (adding a
// sun and a sky if it has none). Does not save the level file.
Status bake_level_light(Level& level, const LightQuality& quality = {},
                        const std::function<void(double)>& progress = {});

}  // namespace slipface
