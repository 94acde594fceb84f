// A person at the real window: an X server of its own (Xvfb), the window in it, pointer and keyboard by
// xdotool. The person acts in real time on a thread of its own and looks at the window between two turns of
// its loop, so that looking makes no frame.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <thread>

#include "app/app.h"
#include "app/glfw_host.h"
#include "widgets/ui.h"

namespace slipface {

class Person {
  public:
    // Opens a window with `options` on a screen of its size, lets `act` use it, and closes it.
    static void use(WindowOptions options, const std::function<void(Person&)>& act);

    // Runs `look` in the window's thread, between two frames.
    void look(const std::function<void(App&)>& look);
    template <class Result>
    Result ask(const std::function<Result(App&)>& question) {
        Result answer{};
        look([&](App& app) { answer = question(app); });
        return answer;
    }
    bool truth(const std::function<bool(App&)>& question) { return ask<bool>(question); }
    // Waits up to ten seconds, real time, for it to become true.
    bool wait_for(const std::function<bool(App&)>& question);

    void rest(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }
    // Until the window has built no frame for a while.
    void settle();

    // With hands: the pointer goes in a few steps, presses last some tenths of a second and shake by a pixel.
    void move_to(ImVec2 at);
    void press(int button);
    void release(int button);
    void click(ImVec2 at, int button = 1);
    void double_click(ImVec2 at);
    void drag(ImVec2 from, ImVec2 to, int button = 1);
    void wheel(int notches);             // positive: away from the person
    void key(const std::string& name);   // as xdotool names it: "ctrl+shift+z"
    void type(const std::string& text);  // as fast as a fast typist
    // The text follows the key without a pause, whether the window has seen the key or not.
    void type_after(const std::string& key, const std::string& text);

    // The widget's centre once it is drawn and in sight; fails the test if it does not come.
    ImVec2 widget(std::string_view path);
    bool comes(std::string_view path);  // soon
    bool shows(std::string_view path);  // now
    void click_widget(std::string_view path) { click(widget(path)); }
    // Clicks through "Edit/Make it/Make it ice".
    void click_menu(std::string_view path);

    // A picture of the screen into the folder SLIPFACE_WINDOW_PICTURES, if that is set.
    void picture(const std::string& name);

  private:
    Person() = default;
    void send(const std::string& line);
    struct Screen;
    struct Questions;
    Questions* questions_ = nullptr;
    FILE* hands_ = nullptr;  // xdotool reads its commands from it
    ImVec2 at_{0, 0};
    int pictures_ = 0;
};

}  // namespace slipface
