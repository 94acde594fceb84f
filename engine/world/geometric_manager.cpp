#include "slipface/world/geometric_manager.h"

#include <algorithm>

namespace slipface {

void Character::on_draw(Graphics& graphics) const {
    graphics.draw_ellipsoid(state.position, settings.radii);
}

Result<std::unique_ptr<GeometricManager>> GeometricManager::make(Level level) {
    Result<CollisionWorld> collision = build_collision_world(level);
    if (!collision) return collision.error();
    return std::unique_ptr<GeometricManager>(new GeometricManager(std::move(level), std::move(*collision)));
}

GeometricManager::GeometricManager(Level level, CollisionWorld collision)
    : level_(std::move(level)), collision_(std::move(collision)) {}

void GeometricManager::on_tick(double seconds) {
    const MovementScene scene{collision_, level_.surfaces};
    for (Character* character : characters_) {
        character->state =
            step(scene, character->settings, character->state, character->input, seconds).state;
    }
}

void GeometricManager::on_draw(Graphics& graphics) {
    graphics.draw_triangles(collision_);
}

void GeometricManager::on_entity_added(Entity& entity) {
    if (auto* character = dynamic_cast<Character*>(&entity)) characters_.push_back(character);
}

void GeometricManager::on_entity_removed(Entity& entity) {
    const auto found = std::find(characters_.begin(), characters_.end(), dynamic_cast<Character*>(&entity));
    if (found != characters_.end()) characters_.erase(found);
}

}  // namespace slipface
