// The editor in a window.
#pragma once

#include <filesystem>
#include <string>

#include "slipface/base/result.h"

namespace slipface {

struct WindowOptions {
    std::filesystem::path level{};   // opened at once; empty: none
    std::string link{};              // likewise
    std::filesystem::path config{};  // folder for preferences and recent files
    std::filesystem::path state{};   // folder for autosaves
    std::filesystem::path review{};  // a snapshot report to review; empty: none
    int width = 1440, height = 900;
    float scale = 0.0f;  // 0: the screen's scale
};

// Runs until the user quits. Fails if there is no display or no OpenGL 3.3.
Status run_window(const WindowOptions& options);

}  // namespace slipface
