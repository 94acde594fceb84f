// The editor in a window.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "slipface/base/result.h"

namespace slipface {

class App;

struct WindowOptions {
    std::filesystem::path level{};   // opened at once; empty: none
    std::string link{};              // likewise
    std::filesystem::path config{};  // folder for preferences and recent files
    std::filesystem::path state{};   // folder for autosaves
    std::filesystem::path review{};  // a snapshot report to review; empty: none
    int width = 1440, height = 900;
    float scale = 0.0f;  // 0: the screen's scale
    // Called between two turns of the window's loop, whether a frame was built or not; glfwPostEmptyEvent
    // makes a turn. Tests look at the window with it.
    std::function<void(App&)> between_turns{};
};

// Runs until the user quits. Fails if there is no display or no OpenGL 3.3.
Status run_window(const WindowOptions& options);

}  // namespace slipface
