// Fills a Rig corner by corner, from any reader.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "slipface/mesh/rig.h"

namespace slipface {

class RigCorners {
  public:
    RigCorners() = default;  // of a file without clips
    explicit RigCorners(Rig rig) : rig_(std::make_shared<Rig>(std::move(rig))) {
        rig_->corner_first_delta = {0};
    }
    explicit operator bool() const { return rig_ != nullptr; }

    // The bone of a node with this bind. Throws std::length_error beyond 65536 of them.
    std::uint16_t bone(std::uint32_t node, const Affine& bind);
    void begin_corner(const Vec3f& position);
    void follow(std::uint16_t bone, float weight) { influences_.emplace_back(weight, bone); }
    void morph(std::uint32_t weight, const Vec3f& delta) {
        if (!delta.isZero(0.0F)) rig_->deltas.push_back({weight, delta});
    }
    // The heaviest bones count; `otherwise` if there are none.
    void end_corner(std::uint16_t otherwise);

    std::shared_ptr<Rig> take();  // null if there is none

  private:
    std::shared_ptr<Rig> rig_;
    std::vector<std::pair<float, std::uint16_t>> influences_;       // of the corner
    std::map<std::uint32_t, std::vector<std::uint16_t>> bones_of_;  // [node]
};

}  // namespace slipface
