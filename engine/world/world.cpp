#include "slipface/world/world.h"

#include <algorithm>

namespace slipface {

Entity& World::add_entity(std::unique_ptr<Entity> entity) {
    Entity& added = *entities_.emplace_back(std::move(entity));
    for (const auto& manager : managers_)
        manager->on_entity_added(added);
    return added;
}

void World::remove_entity(const Entity& entity) {
    const auto found =
        std::find_if(entities_.begin(), entities_.end(),
                     [&](const std::unique_ptr<Entity>& owned) { return owned.get() == &entity; });
    if (found == entities_.end() || is_removed(entity)) return;
    for (const auto& manager : managers_)
        manager->on_entity_removed(**found);
    if (ticking_) {
        removed_.push_back(&entity);
    } else {
        entities_.erase(found);
    }
}

Manager& World::add_manager(std::unique_ptr<Manager> manager) {
    Manager& added = *managers_.emplace_back(std::move(manager));
    for (const auto& entity : entities_) {
        if (!is_removed(*entity)) added.on_entity_added(*entity);
    }
    return added;
}

bool World::is_removed(const Entity& entity) const {
    return std::find(removed_.begin(), removed_.end(), &entity) != removed_.end();
}

void World::tick(double seconds) {
    ticking_ = true;
    // By index, because entities and managers may add to the lists.
    for (std::size_t i = 0; i < entities_.size(); ++i) {
        if (!is_removed(*entities_[i])) entities_[i]->on_tick(seconds);
    }
    for (std::size_t i = 0; i < managers_.size(); ++i)
        managers_[i]->on_tick(seconds);
    ticking_ = false;
    std::erase_if(entities_, [this](const std::unique_ptr<Entity>& entity) { return is_removed(*entity); });
    removed_.clear();
}

void World::draw(Graphics& graphics) {
    for (const auto& entity : entities_)
        entity->on_draw(graphics);
    for (const auto& manager : managers_)
        manager->on_draw(graphics);
}

}  // namespace slipface
