// The screens of the game: a title, the game, a pause over it, and the end.
#pragma once

#include <slipface/world/screens.h>

#include "game.h"

// What the player does besides walking; numbers for slipface::ScreenInput.
enum Command { go_on = 1, pause_or_back = 2 };

class GameScreen : public slipface::Screen {
  public:
    virtual slipface::Camera camera() const = 0;
    virtual std::string status() const { return {}; }  // for the window's title
};

// The level turns below the game's name.
class Title : public GameScreen {
  public:
    explicit Title(std::unique_ptr<Game> game) : game_(std::move(game)) {}
    void on_tick(double seconds) override;
    void on_draw(slipface::Graphics& graphics) override;
    void on_input(const slipface::ScreenInput& input) override;
    slipface::Camera camera() const override;

  private:
    std::unique_ptr<Game> game_;
    double age_s_ = 0.0;
};

class Play : public GameScreen {
  public:
    explicit Play(std::unique_ptr<Game> game) : game_(std::move(game)) {}
    void on_tick(double seconds) override;
    void on_draw(slipface::Graphics& graphics) override { game_->draw(graphics); }
    void on_input(const slipface::ScreenInput& input) override;
    slipface::Camera camera() const override { return game_->camera(); }
    std::string status() const override;

    Buttons buttons;  // of the next tick; set before it
    const Game& game() const { return *game_; }

  private:
    std::unique_ptr<Game> game_;
};

class Pause : public GameScreen {
  public:
    explicit Pause(const Play& play) : play_(play) {}
    void on_draw(slipface::Graphics& graphics) override;
    void on_input(const slipface::ScreenInput& input) override;
    bool shows_below() const override { return true; }
    slipface::Camera camera() const override { return play_.camera(); }

  private:
    const Play& play_;
};

class End : public GameScreen {
  public:
    explicit End(std::unique_ptr<Game> game) : game_(std::move(game)) {}
    void on_draw(slipface::Graphics& graphics) override;
    void on_input(const slipface::ScreenInput& input) override;
    slipface::Camera camera() const override { return game_->camera(); }

  private:
    std::unique_ptr<Game> game_;
};
