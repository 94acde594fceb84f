#include "slipface/world/geometric_manager.h"

#include <algorithm>

namespace slipface {

void Character::on_draw(Graphics& graphics) const {
    graphics.draw_ellipsoid(state.position, settings.radii);
}

Result<std::unique_ptr<GeometricManager>> GeometricManager::make(Level level) {
    std::unique_ptr<GeometricManager> manager(new GeometricManager(std::move(level)));
    Result<LevelScene> scene = LevelScene::build(manager->level_);
    if (!scene) return scene.error();
    manager->scene_ = std::move(*scene);
    return manager;
}

void GeometricManager::on_tick(double seconds) {
    const MovementScene scene = scene_->at(time_s_, seconds);
    time_s_ += seconds;
    for (Character* character : characters_) {
        character->state =
            step(scene, character->settings, character->state, character->input, seconds).state;
    }
}

void GeometricManager::on_draw(Graphics& graphics) {
    const MovementScene now = scene();
    graphics.draw_triangles(now.collision);
    for (const MovingPart& platform : now.platforms)
        graphics.draw_triangles(*platform.collision);
}

void GeometricManager::on_entity_added(Entity& entity) {
    if (auto* character = dynamic_cast<Character*>(&entity)) characters_.push_back(character);
}

void GeometricManager::on_entity_removed(Entity& entity) {
    const auto found = std::find(characters_.begin(), characters_.end(), dynamic_cast<Character*>(&entity));
    if (found != characters_.end()) characters_.erase(found);
}

}  // namespace slipface
