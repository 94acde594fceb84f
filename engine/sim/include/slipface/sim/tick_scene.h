// The scene of each tick of a run: a level with moving platforms, or one scene for all ticks.
#pragma once

#include "slipface/level/level_scene.h"

namespace slipface {

class TickScene {
  public:
    TickScene(const MovementScene& scene) : still_(scene) {}
    // `level` must outlive this object. One thread at a time.
    TickScene(LevelScene& level)
        : still_(level.at(0.0)),
          level_(level.is_static() ? nullptr : &level),
          offset_(level.offset()),
          fall_limit_(level.fall_limit()) {}

    // The scene of the time from tick * dt to (tick + 1) * dt. Valid until the next call.
    MovementScene at(std::size_t tick, double dt) const {
        return level_ ? level_->at(static_cast<double>(tick) * dt, dt) : still_;
    }
    SurfaceTable surfaces() const { return still_.surfaces; }

    // A player at rest at a position in the level, and the position of a player in the level.
    PlayerState player_at(const Vec3& level_position) const {
        PlayerState state;
        put_in_scene(still_, level_position + offset_, state);
        return state;
    }
    Vec3 to_level(const PlayerState& state) const { return position_in_scene(still_, state) - offset_; }
    const Vec3& offset() const { return offset_; }  // add it to the level's coordinates to get the scene's
    std::optional<double> fall_limit() const { return fall_limit_; }  // in the scene's coordinates
    Aabb bounds() const { return still_.collision.bounds(); }         // of the static geometry

  private:
    MovementScene still_;
    LevelScene* level_ = nullptr;
    Vec3 offset_ = Vec3::Zero();
    std::optional<double> fall_limit_;
};

}  // namespace slipface
