// Collides entities with the triangles of a level and draws the triangles (lecture: "GeometricManager").
#pragma once

#include "slipface/level/level_scene.h"
#include "slipface/movement/step.h"
#include "slipface/world/world.h"

namespace slipface {

class GeometricManager;

// An entity that moves through the level as an ellipsoid.
class Character : public Entity {
  public:
    PlayerState state;  // begin with GeometricManager::player_at
    PlayerInput input;  // set by the game before each tick
    MovementSettings settings;
    // Where it is in the level's own coordinates, as the level's spawn and cameras are given: what is drawn
    // and what a camera follows. Without a GeometricManager in its world: state.position.
    Vec3 position() const;
    void on_draw(Graphics& graphics) const override;  // its ellipsoid

  private:
    friend class GeometricManager;
    const GeometricManager* mover_ = nullptr;  // of its world; the last one added, if there are several
};

class GeometricManager : public Manager {
  public:
    // Errors: a level without geometry, or with geometry that cannot be collided with.
    static Result<std::unique_ptr<GeometricManager>> make(Level level);

    // Platforms move on, then one step() of `seconds` (1e-4..0.25, as step() takes them) for each Character,
    // in the order in which they were added. A character that touched a hazard has state.hazard set; what
    // then happens is the game's choice.
    void on_tick(double seconds) override;
    void on_draw(Graphics& graphics) override;  // the level at time_s(); the world draws the entities
    void on_entity_added(Entity& entity) override;
    void on_entity_removed(Entity& entity) override;

    const Level& level() const { return level_; }
    double time_s() const { return time_s_; }  // seconds that were ticked
    // What the characters move through, at rest now.
    MovementScene scene() { return scene_->at(time_s_); }
    const CollisionWorld& collision() { return scene().collision; }  // what does not move
    // A player at rest at a place of the level: its spawn, a checkpoint.
    PlayerState player_at(const Vec3& level_position) { return scene_->player_at(level_position); }
    // The other way round: where in the level a player is, whatever sectors and placement make of it.
    Vec3 position_of(const PlayerState& state) const;

  private:
    explicit GeometricManager(Level level) : level_(std::move(level)) {}
    Level level_;
    std::optional<LevelScene> scene_;  // of level_
    double time_s_ = 0.0;
    std::vector<Character*> characters_;
};

}  // namespace slipface
