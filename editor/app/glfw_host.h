// The editor in a window.
#pragma once

#include <filesystem>
#include <string>

#include "slipface/base/result.h"

namespace slipface {

struct WindowOptions {
    std::filesystem::path level{};   // opened at once; empty: none
    std::filesystem::path config{};  // folder for preferences and recent files
    std::filesystem::path state{};   // folder for autosaves
    std::filesystem::path review{};  // a snapshot report to go through; empty: none
    int width = 1440, height = 900;
    float scale = 0.0f;  // 0: what the screen says
};

// Runs until the user quits. The error says why there is no window: no display, or no OpenGL 3.3.
Status run_window(const WindowOptions& options);

}  // namespace slipface
