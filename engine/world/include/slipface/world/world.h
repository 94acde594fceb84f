// The common engine: a World keeps Managers and Entities, and ticks and draws them. It knows no geometry; a
// game adds the managers it needs (lecture: "Review of Managers").
#pragma once

#include <memory>
#include <vector>

#include "slipface/base/types.h"
#include "slipface/collision/collision_world.h"

namespace slipface {

// What a world is drawn with. `render` implements it with OpenGL; a test may count calls.
class Graphics {
  public:
    virtual ~Graphics() = default;
    virtual void draw_triangles(const CollisionWorld& triangles) = 0;
    virtual void draw_ellipsoid(const Vec3& centre, const Vec3& radii) = 0;
};

// Anything that lives in the world. Entities are owned by the World; managers refer to them.
class Entity {
  public:
    virtual ~Entity() = default;
    virtual void on_tick(double /*seconds*/) {}
    virtual void on_draw(Graphics& /*graphics*/) const {}
};

class Manager {
  public:
    virtual ~Manager() = default;
    virtual void on_tick(double seconds) = 0;
    virtual void on_draw(Graphics& graphics) = 0;
    virtual void on_entity_added(Entity& /*entity*/) {}
    virtual void on_entity_removed(Entity& /*entity*/) {}
};

// Ticks and draws in the order in which things were added: entities first, then managers.
//
// Entities may add and remove entities while they are ticked: an added one is ticked from then on, in the
// same tick; a removed one is told to the managers at once, ticked and drawn no more, and destroyed when the
// tick is over.
class World {
  public:
    // Tells every manager of it.
    Entity& add_entity(std::unique_ptr<Entity> entity);
    // Tells every manager, then destroys it. An entity of another world is left alone.
    void remove_entity(const Entity& entity);
    // Tells it of the entities that are there already.
    Manager& add_manager(std::unique_ptr<Manager> manager);

    template <class T, class... Args>
    T& make_entity(Args&&... args) {
        return static_cast<T&>(add_entity(std::make_unique<T>(std::forward<Args>(args)...)));
    }
    template <class T, class... Args>
    T& make_manager(Args&&... args) {
        return static_cast<T&>(add_manager(std::make_unique<T>(std::forward<Args>(args)...)));
    }

    void tick(double seconds);
    void draw(Graphics& graphics);
    std::size_t entity_count() const { return entities_.size() - removed_.size(); }

  private:
    bool is_removed(const Entity& entity) const;

    bool ticking_ = false;
    std::vector<const Entity*> removed_;  // in the running tick, still in entities_
    std::vector<std::unique_ptr<Entity>> entities_;
    std::vector<std::unique_ptr<Manager>> managers_;
};

}  // namespace slipface
