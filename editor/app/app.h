// The editor's frame: the same code whether a GLFW window or an off-screen context drives it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "panels/panels.h"
#include "slipface/render/gl_context.h"

namespace slipface {

struct AppOptions {
    GlTable gl;
    float scale = 1.0f;          // pixels per design pixel
    bool deterministic = false;  // pictures for goldens: no caret blink, no paths, fixed time
    std::string hidden_folder;  // left out of messages, so that pictures do not depend on where the files lie
    std::filesystem::path config;  // folder for preferences and recent files; empty: nothing is remembered
    std::filesystem::path state;   // folder for autosaves; empty: none are made
    std::function<void()>
        wake;  // called from threads when something is there to be shown; empty: callers wait
};

// A key press, for shortcuts. Text and navigation keys reach Dear ImGui by themselves.
struct KeyPress {
    Shortcut shortcut;
};

class App {
  public:
    explicit App(
        const AppOptions& options);  // an OpenGL context is current, a Dear ImGui context is made here
    ~App();
    App(const App&) = delete;
    App& operator=(const App&) = delete;

    Editor& editor();

    void key_pressed(const KeyPress& press);
    void drop_file(const std::filesystem::path& path);
    void focus_lost();  // releases every held key
    // Does what is due beside the frames. Returns in how many seconds to call again at the latest; sets
    // `shown_changed` if a frame is needed. Draws nothing.
    double tick(double now_s, bool& shown_changed);
    FrameContext& context();  // the host fills `held` before each frame and obeys the outputs after it

    // Builds one frame of `width` x `height` pixels lasting `seconds`, without drawing it. The host has fed
    // ImGui's io.
    void build_frame(int width, int height, double seconds);
    // True if the frame built last would look different from the one drawn last.
    bool needs_drawing() const;
    std::uint64_t frame_hash() const;  // of the frame built last: equal hashes, equal pictures
    void redraw();  // the window's pixels were lost: needs_drawing() until the next draw_frame()
    // Draws it into the framebuffer that is bound (0: the window).
    void draw_frame();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace slipface
