// The common engine: a World owns Managers and Entities, and ticks and draws them. It knows no geometry; a
// game adds the managers that it needs (lecture: Brown University CS1950u, "Review of Managers").
#pragma once

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "slipface/base/placement.h"
#include "slipface/mesh/animation.h"

namespace slipface {

struct Level;

// What an instance of a mesh has for itself (lecture: "specific instance properties like scale, texture, or
// animation should go in a containing class").
struct MeshLook {
    std::filesystem::path texture;  // an image file that replaces those of all materials; empty: its own
    const RigPose* pose = nullptr;  // of pose_at(), read during the call; null: at rest
    UvChange uv{1, 1, 0, 0};        // of uv_at()
};

// The interface that a world is drawn through (lecture: "Graphics *g"): slipface/render/gl_graphics.h draws
// with OpenGL, a test counts calls. All positions are in coordinates of the level, metres. An implementation
// may collect the calls of a frame and draw at its end, so their order does not decide what covers what.
class Graphics {
  public:
    virtual ~Graphics() = default;
    // Draws all faces of `level`, with its platforms at their positions `time_s` seconds after the start. The
    // caller must not move or destroy `level` until the frame is drawn.
    virtual void draw_level(const Level& level, double time_s) = 0;
    // Draws a mesh where `at` places it: a prop, or what a game adds. However often it is drawn, it is loaded
    // once. The textures of its materials are read from `folder`. By default nothing is drawn.
    virtual void draw_mesh(const MeshPtr& /*mesh*/, const Placement& /*at*/,
                           const std::filesystem::path& /*folder*/, const MeshLook& /*look*/ = {}) {}
    // Draws an ellipsoid with axes parallel to the world's, such as a character; `radii` > 0.
    virtual void draw_ellipsoid(const Vec3& centre, const Vec3& radii) = 0;
};

// Anything that lives in the world. The World owns entities; managers refer to them.
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

// Ticks and draws entities first, then managers, each in the order in which they were added.
//
// Entities may add and remove entities during a tick. An added entity is ticked in the same tick. A removed
// one is reported to the managers at once, is not ticked or drawn again, and is destroyed after the tick.
class World {
  public:
    // Adds an entity and notifies every manager.
    Entity& add_entity(std::unique_ptr<Entity> entity);
    // Notifies every manager, then destroys the entity (during a tick: after it). An entity of another world
    // is ignored.
    void remove_entity(const Entity& entity);
    // Adds a manager and notifies it of the existing entities.
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
    std::vector<const Entity*> removed_;  // removed in the current tick, still in entities_
    std::vector<std::unique_ptr<Entity>> entities_;
    std::vector<std::unique_ptr<Manager>> managers_;
};

}  // namespace slipface
