// A level as movement sees it at any time: what stands still, what moves, terrain and sectors. Everybody who
// steps a player through a level gets the scene here.
#pragma once

#include <memory>
#include <vector>

#include "slipface/level/level.h"
#include "slipface/movement/step.h"

namespace slipface {

class LevelScene {
  public:
    // Builds the collision of all that the level holds. `level` must outlive the scene and stay where it is;
    // later changes of its platforms, mesh, terrain or sectors need a new scene, later changes of types and
    // painted faces apply_surfaces(). `settings` decides whether the sectors act.
    static Result<LevelScene> build(const Level& level, const MovementSettings& settings);
    static Result<LevelScene> build(const Level& level) { return build(level, level.movement); }
    // The same, but uses `whole`, the collision of all faces, where nothing of the level moves or is placed
    // elsewhere, instead of building another. `whole` must outlive the scene, and be kept up to date by its
    // owner.
    static Result<LevelScene> borrow(const Level& level, const CollisionWorld& whole,
                                     const MovementSettings& settings);

    // The same scene for another thread: platforms of its own, and this one's of all that stands still. This
    // one must outlive it and keep its surfaces.
    LevelScene for_another_thread() const;

    LevelScene(LevelScene&&) noexcept;
    LevelScene& operator=(LevelScene&&) noexcept;
    ~LevelScene();

    // The tick from `time_s` to `time_s + dt`. Valid until the next call of at(), which moves the platforms;
    // so one thread at a time. The same time gives the same bits, whatever was asked before.
    MovementScene at(double time_s, double dt);
    // At rest at `time_s`, for cameras, rays and drawing.
    MovementScene at(double time_s) { return at(time_s, 0.0); }

    void apply_surfaces();  // after types or faces of the level changed

    // Level::fall_limit, in the scene's coordinates.
    std::optional<double> fall_limit() const;

    // Nothing in the level depends on time: one MovementScene serves all ticks and threads.
    bool is_static() const;
    std::size_t platform_count() const;
    // [face] which of Level::platforms it belongs to, or no_id; empty if nothing moves.
    std::span<const std::uint32_t> face_platforms() const;
    Pose pose(std::size_t platform,
              double time_s) const;  // one of Level::platforms, in the scene's coordinates

    // Where the level's own coordinates (of the mesh, the spawn, the cameras) lie in the scene's.
    Vec3 offset() const;
    Vec3 to_scene(const Vec3& level_position) const { return level_position + offset(); }
    Vec3 to_level(const MovementScene& scene, const PlayerState& state) const;
    Vec3 to_level(const PlayerState& state) const;  // of a player who was stepped through this scene
    // A player at rest at `level_position`.
    PlayerState player_at(const Vec3& level_position);

  private:
    struct Impl;
    explicit LevelScene(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace slipface
