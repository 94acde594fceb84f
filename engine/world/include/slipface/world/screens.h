// A stack of screens (lecture: "Common Engine: Screens"): title, play, pause. The top one ticks and gets the
// input; those below wait.
//
//   Screens screens;
//   screens.push(std::make_unique<Title>());
//   while (!screens.empty()) {
//       screens.input({.key = key, .pressed = true});
//       screens.tick(1.0 / 60.0);
//       screens.draw(graphics);
//   }
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "slipface/world/world.h"

namespace slipface {

class Screens;

// A key, a button or a command: the numbers are the game's own, such as those of its window library.
struct ScreenInput {
    int key = 0;
    bool pressed = true;  // false: released
};

class Screen {
  public:
    virtual ~Screen() = default;
    virtual void on_tick(double /*seconds*/) {}
    virtual void on_draw(Graphics& graphics) = 0;
    virtual void on_input(const ScreenInput& /*input*/) {}
    // It is the top one now: after push(), and when what was above is gone.
    virtual void on_show() {}
    // True: the screen below is drawn first, as under a pause.
    virtual bool shows_below() const { return false; }

  protected:
    Screens& screens() const { return *screens_; }  // from the first push() on

  private:
    friend class Screens;
    Screens* screens_ = nullptr;
};

// A screen may change the stack while it ticks or gets input: the change follows directly after that call, so
// a screen is never destroyed inside its own function.
class Screens {
  public:
    void push(std::unique_ptr<Screen> screen);
    void pop();  // of an empty stack: nothing
    void replace(std::unique_ptr<Screen> screen);
    void clear();

    void tick(double seconds);
    void input(const ScreenInput& input);
    void draw(Graphics& graphics);

    bool empty() const { return screens_.empty(); }  // the game is over
    std::size_t count() const { return screens_.size(); }
    Screen* top() const { return screens_.empty() ? nullptr : screens_.back().get(); }

  private:
    void put(std::unique_ptr<Screen> screen, bool instead);
    void change(std::function<void()> how);
    void call(const std::function<void(Screen&)>& what);
    std::vector<std::unique_ptr<Screen>> screens_;
    std::vector<std::function<void()>> changes_;  // while calling_
    bool calling_ = false;
};

}  // namespace slipface
