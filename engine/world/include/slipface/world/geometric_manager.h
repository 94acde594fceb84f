// Collides entities with the triangles of a level and draws the triangles (lecture: "GeometricManager").
#pragma once

#include "slipface/level/level_scene.h"
#include "slipface/movement/crowd.h"
#include "slipface/world/world.h"

namespace slipface {

class GeometricManager;

// An entity that moves through the level as an ellipsoid.
class Character : public Entity {
  public:
    PlayerState state;  // initialise with GeometricManager::player_at
    PlayerInput input;  // set by the game before each tick
    MovementSettings settings;
    bool meets_others = true;  // false: other characters pass through it
    // The position in coordinates of the level, like the level's spawn and cameras: for drawing and for a
    // camera that follows. Without a GeometricManager in the world: state.position.
    Vec3 position() const;
    void on_draw(Graphics& graphics) const override;  // draws its ellipsoid

  private:
    friend class GeometricManager;
    Rest rest_;
    const GeometricManager* mover_ = nullptr;  // of its world; the last one added if there are several
};

class GeometricManager : public Manager {
  public:
    // Errors: a level without geometry, or with geometry that collision refuses.
    static Result<std::unique_ptr<GeometricManager>> make(Level level);

    // Advances the platforms, then moves all characters together (step_crowd()); one that does not meet
    // others moves by step() alone. With `seconds` below 1e-4 the characters do not move. A character that
    // touched a hazard has state.hazard set; the game decides what follows.
    void on_tick(double seconds) override;
    // Draws the level at time_s(), and its props by Graphics::draw_mesh(), unless the light of both was baked
    // into one image. The world draws the entities.
    void on_draw(Graphics& graphics) override;
    void on_entity_added(Entity& entity) override;
    void on_entity_removed(Entity& entity) override;

    const Level& level() const { return level_; }
    double time_s() const { return time_s_; }  // sum of the seconds of all ticks
    // The scene that the characters move through, at the current time, with its platforms at rest.
    MovementScene scene() { return scene_->at(time_s_); }
    const CollisionWorld& collision() { return scene().collision; }  // the geometry that does not move
    // A player at rest at a position in the level, such as its spawn or a checkpoint.
    PlayerState player_at(const Vec3& level_position) { return scene_->player_at(level_position); }
    // The inverse: the position of a player in the level, whatever its sectors and placement.
    Vec3 position_of(const PlayerState& state) const;

  private:
    explicit GeometricManager(Level level) : level_(std::move(level)) {}
    Level level_;
    Level own_;                        // level_ without props, for drawing; only if props are drawn alone
    std::vector<MeshPtr> drawn_;       // [prop] its mesh as it is drawn; null: it has none
    std::optional<LevelScene> scene_;  // of level_
    double time_s_ = 0.0;
    std::vector<Character*> characters_;
    std::vector<CrowdMember> crowd_;  // of one tick
    RigPose pose_;                    // of one prop
};

}  // namespace slipface
