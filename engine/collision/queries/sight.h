// The triangles of a world as a query sees them: where they are, or turned by a pose.
#pragma once

#include "impl.h"
#include "simd/kernels.h"
#include "slipface/collision/posed.h"

namespace slipface::detail {

struct Sight {
    const CollisionWorld::Impl& world;
    WorldView view;
    const WorldExtent* extent;
    const InstanceView* turned = nullptr;
    bool has_tree = true;  // false: every triangle is looked at

    explicit Sight(const CollisionWorld::Impl& of) : world(of), view(of.view()), extent(&of.extent) {}
    LeafTriangle triangle(TriangleId id) const {
        return turned == nullptr ? world.triangle(id) : place_triangle(*turned, world.triangle(id));
    }
};

// The world of a PosedWorld, in coordinates relative to its origin(): its own if it is not turned, else those
// of its middle, where it is one instance that stays within a ball.
class PosedSight : public Sight {
  public:
    explicit PosedSight(const PosedWorld& posed);
    PosedSight(const PosedSight&) = delete;
    PosedSight& operator=(const PosedSight&) = delete;

  private:
    InstanceView view_;
    WorldExtent extent_;
};

}  // namespace slipface::detail
