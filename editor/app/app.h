// The editor's frame: the same code for a GLFW window and an off-screen context.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "panels/panels.h"
#include "slipface/render/gl_context.h"

namespace slipface {

struct AppOptions {
    GlTable gl;
    float scale = 1.0f;          // pixels per design pixel
    bool deterministic = false;  // for golden images: no caret blink, no paths, fixed time
    std::string hidden_folder;   // left out of messages, so that images do not depend on the files' location
    std::filesystem::path config;  // folder for preferences and recent files; empty: nothing is stored
    std::filesystem::path state;   // folder for autosaves; empty: none are written
    // Triangles of a level from which its first image is drawn without multisampling, and in full right after
    // that. It takes half the time where the processor draws.
    std::size_t draft_from = std::numeric_limits<std::size_t>::max();
    // Called from threads when there is something new to show; empty: callers wait.
    std::function<void()> wake;
    // Shows a section of docs/symptoms.md; empty: the status line names it.
    std::function<void(const std::string& title)> show_symptom;
};

// A key press, for shortcuts. Text and navigation keys reach Dear ImGui by themselves.
struct KeyPress {
    Shortcut shortcut;
};

// What throws in one of these functions costs that action alone (tools/session/failed_action.h): the document
// is as it was before, and a message says so.
class App {
  public:
    explicit App(const AppOptions& options);  // needs a current OpenGL context; makes the Dear ImGui context
    ~App();
    App(const App&) = delete;
    App& operator=(const App&) = delete;

    Editor& editor();

    void key_pressed(const KeyPress& press);
    void drop_file(const std::filesystem::path& path);  // a level, or a link (*.link)
    void focus_lost();                                  // releases every held key
    void set_scale(float scale);                        // pixels per design pixel, from the next frame on
    // Does the background work that is due. Returns after how many seconds to call again at the latest; sets
    // `shown_changed` if a frame is needed. Draws nothing.
    double tick(double now_s, bool& shown_changed);
    // The host fills `held` before each frame and follows the members marked "out" after it.
    FrameContext& context();

    // Builds one frame of `width` x `height` pixels lasting `seconds`, without drawing it. The host has fed
    // ImGui's io.
    void build_frame(int width, int height, double seconds);
    // True if the frame built last would look different from the one drawn last.
    bool needs_drawing() const;
    // After how many seconds the next frame is due even without events; infinity: no frame is. Whatever needs
    // a later frame asks for it here: a tooltip, a window that is hidden until its size is known, a frame
    // that looked different from the one before (layout settles one frame later), a walk.
    double next_frame_s() const;
    std::uint64_t frame_hash() const;  // of the frame built last: equal hashes mean equal images
    void redraw();  // the window's pixels were lost: needs_drawing() until the next draw_frame()
    // Draws the frame into the bound framebuffer (0: the window).
    void draw_frame();

  private:
    void take_key(const KeyPress& press);

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace slipface
