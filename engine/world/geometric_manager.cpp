#include "slipface/world/geometric_manager.h"

#include <algorithm>
#include <map>

#include "slipface/level/prop_materials.h"

namespace slipface {

Vec3 Character::position() const {
    return mover_ != nullptr ? mover_->position_of(state) : state.position;
}

void Character::on_draw(Graphics& graphics) const {
    graphics.draw_ellipsoid(position(), settings.radii);
}

Result<std::unique_ptr<GeometricManager>> GeometricManager::make(Level level) {
    std::unique_ptr<GeometricManager> manager(new GeometricManager(std::move(level)));
    Result<LevelScene> scene = LevelScene::build(manager->level_);
    if (!scene) return scene.error();
    manager->scene_ = std::move(*scene);
    if (has_instances(manager->level_) && !manager->level_.light)
        manager->own_ = without_props(manager->level_);
    std::map<std::pair<std::string_view, std::string_view>, MeshPtr> drawn;  // by file and texture
    for (const Prop& prop : manager->level_.props) {
        const PropMesh* const known = find_prop_mesh(manager->level_, prop.mesh);
        MeshPtr& mesh = drawn[{prop.mesh, prop.texture}];
        if (!mesh && known != nullptr && known->mesh)
            mesh = drawn_prop_mesh(known->mesh, prop.mesh, prop.texture);
        manager->drawn_.push_back(mesh);
    }
    return manager;
}

void GeometricManager::on_tick(double seconds) {
    const MovementScene scene = scene_->at(time_s_, seconds);
    time_s_ += seconds;
    crowd_.clear();
    for (Character* character : characters_) {
        if (character->meets_others)
            crowd_.push_back({.settings = &character->settings,
                              .state = character->state,
                              .input = character->input,
                              .rest = &character->rest_});
        else
            character->state = step(scene, character->settings, character->state, character->input, seconds,
                                    character->rest_)
                                   .state;
    }
    step_crowd(scene, crowd_, seconds);
    auto moved = crowd_.begin();
    for (Character* character : characters_)
        if (character->meets_others) character->state = (moved++)->state;
}

void GeometricManager::on_draw(Graphics& graphics) {
    if (!own_.mesh) return graphics.draw_level(level_, time_s_);
    graphics.draw_level(own_, time_s_);
    const std::filesystem::path folder = level_.mesh_path.parent_path();
    for (std::size_t i = 0; i < level_.props.size(); ++i) {
        const Prop& prop = level_.props[i];
        if (!drawn_[i]) continue;
        const auto platform = std::ranges::find(level_.platforms, prop.name, &Platform::group);
        Placement at = prop.placement();
        if (platform != level_.platforms.end()) at = moved(at, platform_pose(*platform, time_s_));
        pose_at(*drawn_[i], prop.animation, time_s_, pose_);
        graphics.draw_mesh(drawn_[i], at, folder,
                           {.texture = {}, .pose = &pose_, .uv = uv_at(prop.animation, time_s_)});
    }
}

Vec3 GeometricManager::position_of(const PlayerState& state) const {
    return scene_->to_level(state);
}

void GeometricManager::on_entity_added(Entity& entity) {
    auto* const character = dynamic_cast<Character*>(&entity);
    if (character == nullptr) return;
    character->mover_ = this;
    characters_.push_back(character);
}

void GeometricManager::on_entity_removed(Entity& entity) {
    const auto found = std::find(characters_.begin(), characters_.end(), dynamic_cast<Character*>(&entity));
    if (found != characters_.end()) characters_.erase(found);
}

}  // namespace slipface
