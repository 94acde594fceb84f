// A small game on Slipface::world: a level, coins to collect, platforms that move, islanders to push and to
// stand on, death and respawn, and a camera behind the player that no wall hides.
#pragma once

#include <slipface/view/camera.h>
#include <slipface/world/geometric_manager.h>

#include <vector>

// A coin hangs in the air until the player comes near.
class Coin : public slipface::Entity {
  public:
    explicit Coin(const slipface::Vec3& at) : position(at) {}
    slipface::Vec3 position;
    double age_s = 0.0;
    void on_tick(double seconds) override { age_s += seconds; }
    void on_draw(slipface::Graphics& graphics) const override;
};

// A character with a figure that walks where it goes. All share one mesh; which clip it plays, and how far it
// is in it, is each one's own.
class Figure : public slipface::Character {
  public:
    explicit Figure(slipface::MeshPtr mesh) : mesh_(std::move(mesh)) {}  // null: an ellipsoid
    void on_tick(double seconds) override;
    void on_draw(slipface::Graphics& graphics) const override;

  private:
    slipface::MeshPtr mesh_;
    slipface::Animation motion_;
    double yaw_ = 0.0, age_s_ = 0.0;
};

// An islander walks about, and turns where there is no floor ahead. The player can push it and stand on it.
class Islander : public Figure {
  public:
    Islander(slipface::GeometricManager& level, slipface::MeshPtr mesh)
        : Figure(std::move(mesh)), level_(level) {}
    void on_tick(double seconds) override;

  private:
    slipface::GeometricManager& level_;
    double heading_ = 0.0;
};

// What the player presses.
struct Buttons {
    slipface::Vec2 stick = slipface::Vec2::Zero();  // x to the right, y away from the camera; at most 1 long
    bool jump = false;
    double turn = 0.0, tilt = 0.0;  // of the camera in this tick, radians
};

class Game {
  public:
    static constexpr double dt = 1.0 / 60.0;

    // Coins are laid where there is floor around the start. Errors: as of load_level() and GeometricManager.
    static slipface::Result<std::unique_ptr<Game>> open(const std::filesystem::path& level);

    void tick(const Buttons& buttons);
    void draw(slipface::Graphics& graphics) { world_.draw(graphics); }
    slipface::Camera camera() const;

    const slipface::Character& player() const { return *player_; }
    const std::vector<Coin*>& coins() const { return coins_; }  // those that are left
    int collected() const { return collected_; }
    int deaths() const { return deaths_; }
    double time_s() const { return time_s_; }
    double yaw() const { return yaw_; }  // of the camera: 0 looks along -Z, positive turns to the left

  private:
    Game() = default;
    void lay_coins_and_islanders();
    void collect();
    void respawn();

    slipface::World world_;
    slipface::MeshPtr figure_;  // of all
    slipface::GeometricManager* level_ = nullptr;
    slipface::Character* player_ = nullptr;
    std::vector<Coin*> coins_;
    slipface::Vec3 start_ = slipface::Vec3::Zero();  // or the last safe place on firm ground
    double lowest_ = 0.0, safe_s_ = 0.0, time_s_ = 0.0;
    double yaw_ = 0.0, tilt_ = 0.35;
    int collected_ = 0, deaths_ = 0;
};
