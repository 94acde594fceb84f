// Collides entities with the triangles of a level and draws the triangles (lecture: "GeometricManager").
#pragma once

#include "slipface/level/level.h"
#include "slipface/movement/step.h"
#include "slipface/world/world.h"

namespace slipface {

// An entity that moves through the level as an ellipsoid.
class Character : public Entity {
  public:
    PlayerState state;
    PlayerInput input;  // set by the game before each tick
    MovementSettings settings;
    void on_draw(Graphics& graphics) const override;
};

class GeometricManager : public Manager {
  public:
    // Refuses a level whose geometry cannot be collided with.
    static Result<std::unique_ptr<GeometricManager>> make(Level level);

    // One step() of `seconds` (1e-4..0.25, as step() takes them) for each Character, in the order in which
    // they were added. A character that touched a hazard has state.hazard set; what then happens is the
    // game's choice.
    void on_tick(double seconds) override;
    void on_draw(Graphics& graphics) override;  // the triangles; the world draws the entities
    void on_entity_added(Entity& entity) override;
    void on_entity_removed(Entity& entity) override;

    const Level& level() const { return level_; }
    const CollisionWorld& collision() const { return collision_; }

  private:
    GeometricManager(Level level, CollisionWorld collision);
    Level level_;
    CollisionWorld collision_;
    std::vector<Character*> characters_;
};

}  // namespace slipface
