// A level's baked light on the graphics card.
#pragma once

#include <filesystem>
#include <optional>

#include "gl_util.h"
#include "slipface/level/level_light.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

// Two textures: the light map, and three texels per face that convert a position into chart coordinates:
//   (direction of u / step, offset), (direction of v / step, offset), (first texel centre, width - 1, height
//   - 1).
class LightMap {
  public:
    explicit LightMap(GlTable gl) : gl_(std::move(gl)) {}
    ~LightMap() { clear(); }
    LightMap(const LightMap&) = delete;
    LightMap& operator=(const LightMap&) = delete;

    // Loads the image that `light` names from `folder`, for a mesh drawn relative to `origin`. Of the
    // `drawn_faces`, those after the mesh's own have no chart. An image that is missing, broken or baked for
    // other geometry is not used and returned as a warning.
    Warnings load(const Mesh& mesh, std::size_t drawn_faces, const LevelLight& light,
                  const std::filesystem::path& folder, const Vec3& origin);
    void clear();

    bool loaded() const { return image_ != 0; }
    unsigned image() const { return image_; }
    unsigned charts() const { return charts_; }

  private:
    GlTable gl_;
    unsigned image_ = 0, charts_ = 0;
};

}  // namespace slipface
