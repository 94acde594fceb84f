// A level as movement sees it at any time: static and moving parts, terrain and sectors. All code that steps
// a player through a level uses this class.
#pragma once

#include <memory>
#include <vector>

#include "slipface/level/level.h"
#include "slipface/movement/step.h"

namespace slipface {

class LevelScene {
  public:
    // Builds the collision worlds of all parts of the level. `level` must outlive the scene and must not be
    // moved in memory. Later changes of its platforms, mesh, terrain or sectors need a new scene; changes of
    // types and painted faces need apply_surfaces(). `settings` decides whether the sectors act. Errors: the
    // level has no mesh, or its triangles cannot be built.
    static Result<LevelScene> build(const Level& level, const MovementSettings& settings);
    static Result<LevelScene> build(const Level& level) { return build(level, level.movement); }
    // The same, but uses `whole` (of build_collision_world()) instead of building another world, if no face
    // of the level moves and offset() is zero. `whole` must outlive the scene, and its owner must keep its
    // types up to date.
    static Result<LevelScene> borrow(const Level& level, const CollisionWorld& whole,
                                     const MovementSettings& settings);

    // The same scene for another thread: it has its own time and shares the collision worlds of this one.
    // This scene must outlive it, and its types must not change meanwhile.
    LevelScene for_another_thread() const;

    LevelScene(LevelScene&&) noexcept;
    LevelScene& operator=(LevelScene&&) noexcept;
    ~LevelScene();

    // The scene of the tick from `time_s` to `time_s + dt`, seconds. Valid until the next call of at(), which
    // moves the platforms; therefore one thread at a time. The same arguments give the same bits, whatever
    // calls came before.
    MovementScene at(double time_s, double dt);
    // The platforms at rest at `time_s`, for cameras, rays and drawing.
    MovementScene at(double time_s) { return at(time_s, 0.0); }

    void apply_surfaces();  // after types or faces of the level changed

    // What would happen if: gives faces another type in this scene alone, until end_trial(). Only for scenes
    // of build(). nothing() is a type that nothing meets: faces that get it are as if they were not there.
    // Empty if the level has as many types as there can be.
    void try_surface(std::span<const FaceId> faces, SurfaceId type);
    void end_trial();
    std::optional<SurfaceId> nothing();

    // Level::fall_limit, in the scene's coordinates.
    std::optional<double> fall_limit() const;

    // True if no part of the level moves: one MovementScene serves all ticks and threads.
    bool is_static() const;
    std::size_t platform_count() const;  // Level::platforms, or 0 if no face belongs to any
    // [face] index of its platform in Level::platforms, or no_id; empty if no face moves.
    std::span<const std::uint32_t> face_platforms() const;
    // Pose of Level::platforms[platform] at `time_s`, in the scene's coordinates.
    Pose pose(std::size_t platform, double time_s) const;

    // What to add to the level's coordinates (of the mesh, the spawns, the cameras) to get the scene's.
    Vec3 offset() const;
    Vec3 to_scene(const Vec3& level_position) const { return level_position + offset(); }
    // The position of a player who was stepped through this scene, in the level's coordinates.
    Vec3 to_level(const MovementScene& scene, const PlayerState& state) const;
    Vec3 to_level(const PlayerState& state) const;
    // A player at rest at `level_position`.
    PlayerState player_at(const Vec3& level_position);

  private:
    struct Impl;
    explicit LevelScene(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace slipface
