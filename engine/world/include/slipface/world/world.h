// The common engine: a World keeps Managers and Entities, and ticks and draws them. It knows no geometry; a
// game adds the managers it needs (lecture: "Review of Managers").
#pragma once

#include <memory>
#include <vector>

#include "slipface/base/types.h"

namespace slipface {

struct Level;

// What a world is drawn with (lecture: "Graphics *g"): slipface/render/gl_graphics.h draws with OpenGL, a
// test counts calls. All places are in the coordinates of the level, metres. An implementation may gather the
// calls of a frame and draw at its end, so the order of the calls does not decide what covers what.
class Graphics {
  public:
    virtual ~Graphics() = default;
    // All faces of `level`, its platforms where they are `time_s` seconds after it began. `level` stays
    // alive and where it is until the frame is drawn.
    virtual void draw_level(const Level& level, double time_s) = 0;
    // An ellipsoid whose axes are the world's, as characters are; `radii` > 0.
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
