// What held the player, found by trying: the run is played again without the faces that were met, until the
// player gets on; then as many of them as possible are put back.
#pragma once

#include <memory>

#include "slipface/sim/stops.h"

namespace slipface {

// A part of the level that was met: faces of one plane, or a platform.
struct Obstacle {
    std::vector<FaceId> faces;  // ascending; the first one met is `face`
    FaceId face = no_id;
    Vec3 normal = Vec3::Zero();  // of the first contact
    Vec3 point = Vec3::Zero();   // of the first contact, in the level's coordinates
    std::uint32_t platform = no_id;
};

// What is enough to let the player on, with nothing in it that may stay.
using Holding = std::vector<Obstacle>;

class WhatHolds {
  public:
    static constexpr double looked_at_s = 0.35;  // of a stop

    // Both must outlive this object.
    WhatHolds(const Level& level, const TapeRun& run);
    ~WhatHolds();

    // What takes motion towards the stick from tick `first` on; `lost_m` of it until looked_at_s later. Each
    // element lets the player regain half of it, alone. The one that took most comes first. Empty: nothing
    // that the player touched holds it.
    std::vector<Holding> of_stop(std::size_t first, double lost_m);

    // After of_stop(): what leans against the stick from another side than `wall` at the end of the stop's
    // ticks `first` to `last`.
    std::optional<Obstacle> beside(const Obstacle& wall, std::size_t first, std::size_t last);
    // After of_stop(): the face that the player stands on or leans on with its back, if there is no ground
    // between it and what is `nearest` metres ahead.
    FaceId rim_before(double nearest, std::size_t tick);
    // After of_stop(): whether a much thinner player would have got on.
    bool lets_thin_through();

    // What would have carried a player who left the ground before tick `left` and was sent back, or landed
    // deep below, at `end`: at a height of its middle of more than `lowest`.
    struct Carrier {
        Holding holding;  // what let it through, or what it touched in the air
        FallCause cause = FallCause::unknown;
        FaceId ground = no_id;                  // where it would have landed, or what it stood on
        std::optional<SurfaceId> surface = {};  // whose type made it fall
    };
    std::optional<Carrier> of_fall(std::size_t left, std::size_t end, double lowest);

    // Without any one of these the player would not have been crushed in tick `tick`.
    std::vector<Holding> of_crush(std::size_t tick);

    // The lowest and the highest point, above the player's feet in metres, of the first object that stands in
    // the player's way, where it begins; and how far that is from the player's middle. Nothing if it is
    // aside.
    struct Extent {
        double lowest = 0.0, highest = 0.0, nearest = 0.0;
        double feet = 0.0;  // their height in the level
    };
    std::optional<Extent> extent(const Holding& holding, std::size_t tick);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace slipface
