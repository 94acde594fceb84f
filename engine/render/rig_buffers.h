// The rig of a mesh on the graphics card: what each vertex follows, and the poses of a frame.
#pragma once

#include <span>

#include "level_geometry.h"
#include "slipface/mesh/rig.h"

namespace slipface {

// The mesh before its bones move it: corners share no positions.
Mesh before_bones(const Mesh& mesh);

class RigBuffers {
  public:
    // Adds the attributes of `order`'s vertices to `vertex_array`. The mesh has a rig.
    RigBuffers(GlTable gl, unsigned vertex_array, const Mesh& mesh, const DrawOrder& order);
    ~RigBuffers();
    RigBuffers(const RigBuffers&) = delete;
    RigBuffers& operator=(const RigBuffers&) = delete;

    // Sends the poses of a frame. An empty one is the pose at rest.
    void send(std::span<const RigPose* const> poses);
    // Binds the textures that the shader reads, and says where pose number `pose` begins.
    void bind(unsigned program, std::size_t pose) const;

  private:
    GlTable gl_;
    std::size_t bones_ = 0, weights_ = 0;
    RigPose rest_;
    unsigned buffer_ = 0, pose_texture_ = 0, delta_texture_ = 0;
    std::vector<float> texels_;
};

}  // namespace slipface
