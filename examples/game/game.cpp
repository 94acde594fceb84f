#include "game.h"

#include <slipface/level/find_start.h>
#include <slipface/level/level_file.h>
#include <slipface/mesh/import.h>
#include <slipface/movement/first_contact.h>

#include <algorithm>
#include <cmath>

using namespace slipface;

void Coin::on_draw(Graphics& graphics) const {
    // An ellipsoid as thin as a coin that turns.
    const double turn = std::abs(std::cos(3.0 * age_s));
    graphics.draw_ellipsoid(position, {0.05 + 0.25 * turn, 0.3, 0.05 + 0.25 * (1.0 - turn)});
}

// The clip follows from what is asked for, which is what a player sees first.
void Figure::on_tick(double seconds) {
    age_s_ += seconds;
    const Vec2 wish = input.wish;
    const char* const clip = wish.norm() < 0.1 ? "idle" : "walk";
    if (motion_.clip != clip) {
        motion_.clip = clip;
        motion_.phase_s = -age_s_;  // from its begin
    }
    if (wish.norm() < 0.1) return;
    // It turns to where it walks, not at once.
    const double turn = std::remainder(std::atan2(-wish.x(), -wish.y()) - yaw_, 6.283185307179586);
    yaw_ += std::clamp(turn, -9.0 * seconds, 9.0 * seconds);
}

void Figure::on_draw(Graphics& graphics) const {
    if (!mesh_) return Character::on_draw(graphics);
    RigPose pose;
    pose_at(*mesh_, motion_, age_s_, pose);
    const double size = settings.radii.y() / 0.9;  // it is 1.8 m tall
    const Vec3 feet = position() - Vec3(0.0, settings.radii.y(), 0.0);
    graphics.draw_mesh(mesh_, placement(feet, {0.0, yaw_, 0.0}, Vec3::Constant(size)), {},
                       {.texture = {}, .pose = &pose});
}

// Half the walking speed, in the direction in which there is floor a metre ahead.
void Islander::on_tick(double seconds) {
    const MovementScene scene = level_.scene();
    const Vec3 ahead(std::cos(heading_), 0.0, std::sin(heading_));
    const Vec3 from = position_in_scene(scene, state) + ahead;
    const auto floor = first_contact(scene, 0.9 * settings.radii, from, {0.0, -0.5, 0.0});
    const bool free = floor && floor->t > 0.0 && floor->normal.y() > 0.8;
    if (!free) heading_ += 0.7;
    input.wish = free ? Vec2(0.5 * ahead.x(), 0.5 * ahead.z()) : Vec2::Zero();
    Figure::on_tick(seconds);
}

Result<std::unique_ptr<Game>> Game::open(const std::filesystem::path& path) {
    Result<LoadedLevel> loaded = load_level(path);
    if (!loaded) return loaded.error();
    const Result<Start> start = settle_start(loaded->level);
    if (!start) return start.error();
    Result<std::unique_ptr<GeometricManager>> geometry = GeometricManager::make(std::move(loaded->level));
    if (!geometry) return geometry.error();
    std::unique_ptr<Game> game(new Game);
    game->level_ = static_cast<GeometricManager*>(&game->world_.add_manager(std::move(*geometry)));
    if (auto figure = import_mesh(path.parent_path() / "../props/islander.gltf"))
        game->figure_ = figure->mesh;
    game->player_ = &game->world_.make_entity<Figure>(game->figure_);
    game->player_->settings = game->level_->level().movement;
    game->player_->state = game->level_->player_at(start->position);
    game->start_ = start->position;
    game->yaw_ = start->yaw;
    game->lowest_ = game->level_->level().fall_limit.value_or(start->position.y() - 40.0);
    game->lay_coins_and_islanders();
    return game;
}

// Rings around the start; a coin where a ray down finds a floor that one can stand on, as high as a head
// above it. One islander per ring stands where a coin would.
void Game::lay_coins_and_islanders() {
    const MovementScene scene = level_->scene();
    const Vec3 offset = position_in_scene(scene, player_->state) - start_;
    for (int ring = 1; ring <= 4; ++ring) {
        for (int i = 0; i < 3 * ring; ++i) {
            const double angle = 6.283185307179586 * i / (3 * ring);
            const Vec3 above = start_ + Vec3(5.0 * ring * std::cos(angle), 3.0, 5.0 * ring * std::sin(angle));
            // A terrain is no triangle: a body that falls finds both.
            const Vec3 radii = player_->settings.radii;
            const auto floor = first_contact(scene, radii, above + offset, {0.0, -8.0, 0.0});
            if (!floor || floor->normal.y() < 0.8 || scene.surfaces[floor->surface].hazardous) continue;
            const Vec3 centre = above + Vec3(0.0, -8.0 * floor->t, 0.0);
            if (i == ring) {
                auto& islander = world_.make_entity<Islander>(*level_, figure_);
                islander.settings = level_->level().movement;
                islander.state = level_->player_at(centre + Vec3(0.0, 0.1, 0.0));
            } else {
                coins_.push_back(&world_.make_entity<Coin>(centre));
            }
        }
    }
}

void Game::tick(const Buttons& buttons) {
    yaw_ += buttons.turn;
    tilt_ = std::clamp(tilt_ + buttons.tilt, -0.2, 1.2);
    const Vec3 away(-std::sin(yaw_), 0.0, -std::cos(yaw_)), right(std::cos(yaw_), 0.0, -std::sin(yaw_));
    const Vec3 wish = buttons.stick.x() * right + buttons.stick.y() * away;
    player_->input = {.wish = {wish.x(), wish.z()}, .buttons = {Button::jump, buttons.jump}};
    world_.tick(dt);
    time_s_ += dt;
    collect();

    const PlayerState& state = player_->state;
    if (state.hazard || state.crushed || state.trapped || !(player_->position().y() > lowest_))
        return respawn();
    // A second of walking on what does not move is a safe place to come back to.
    safe_s_ = state.grounded && state.ground_platform == no_id ? safe_s_ + dt : 0.0;
    if (safe_s_ > 1.0) {
        start_ = player_->position();
        safe_s_ = 0.0;
    }
}

void Game::collect() {
    std::erase_if(coins_, [&](const Coin* coin) {
        if ((coin->position - player_->position()).norm() > 1.2) return false;
        world_.remove_entity(*coin);
        ++collected_;
        return true;
    });
}

void Game::respawn() {
    ++deaths_;
    safe_s_ = 0.0;
    player_->state = level_->player_at(start_);
}

// Five metres behind the player, nearer where something is in between: a ball is swept from the head.
Camera Game::camera() const {
    const Vec3 head = player_->position() + Vec3(0.0, 0.6 * player_->settings.radii.y(), 0.0);
    const Vec3 back(std::sin(yaw_) * std::cos(tilt_), std::sin(tilt_), std::cos(yaw_) * std::cos(tilt_));
    const MovementScene scene = level_->scene();
    const Vec3 offset = position_in_scene(scene, player_->state) - player_->position();
    const Vec3 ball = Vec3::Constant(0.2);
    const auto wall = first_contact(scene, ball, head + offset, 5.0 * back);
    Camera camera;
    camera.target = head;
    camera.eye = head + (wall ? std::max(0.4, 5.0 * wall->t) : 5.0) * back;
    return camera;
}
