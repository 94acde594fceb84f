// The editor without a window: function calls give the input and read images back. For scripts, tests and
// goldens.
#pragma once

#include <imgui.h>

#include <memory>
#include <optional>
#include <string>

#include "app/app.h"
#include "slipface/base/temporary_folder.h"
#include "slipface/image/image.h"

namespace slipface {

struct OffscreenOptions {
    int width = 1280, height = 720;
    float scale = 1.0f;
    std::string hidden_folder;     // left out of messages
    std::filesystem::path config;  // folder for preferences and recent files; empty: nothing is stored
    std::filesystem::path state;   // folder for autosaves; empty: a temporary one if a script uses autosaves
    std::size_t draft_from = AppOptions().draft_from;
};

class OffscreenHost {
  public:
    static constexpr double frame_s = 1.0 / 60.0;

    static Result<std::unique_ptr<OffscreenHost>> make(const OffscreenOptions& options);

    App& app() { return *app_; }
    Editor& editor() { return app_->editor(); }
    const OffscreenContext& context() const { return *context_; }
    int width() const { return width_; }
    int height() const { return height_; }

    void frame();  // builds one frame of 1/60 s, with the background work that is due
    // Lets the time for an autosave pass and writes it. Returns its error.
    Status autosave();
    // Leaves the autosaves as a crash would, and finds them as the next run would.
    void crash();
    // Time passes without events, as in a window that nobody touches: only frames that are asked for
    // (App::next_frame_s) are built.
    void rest(double seconds);
    // Builds frames until two in a row change nothing, at most `maximum`, and returns their number. During a
    // playtest every frame differs: then it builds one.
    int settle(int maximum = 60);
    Image screenshot();  // draws the frame built last
    // Draws the last frame unless the image shows it already. True if it drew.
    bool draw_if_needed();

    // Input as from a person; each takes effect in the next frame.
    void move_mouse(ImVec2 to);
    void park_mouse();  // outside the window
    void mouse_button(int button, bool down);
    void wheel(float notches);
    void modifiers(bool ctrl, bool shift, bool alt);
    void press_key(const Shortcut& key);  // with its modifiers; down for one frame, up for one
    void type(const std::string& utf8);
    ImVec2 mouse() const { return mouse_; }

  private:
    OffscreenHost() = default;

    std::optional<TemporaryFolder> own_state_;
    // In this order: the app's GL objects are destroyed before the context.
    std::unique_ptr<OffscreenContext> context_;
    std::unique_ptr<Framebuffer> target_;
    std::unique_ptr<App> app_;
    void want_state_folder();
    void frame_after(double seconds);

    int width_ = 0, height_ = 0;
    double clock_s_ = 0.0;
    double rested_s_ = 0.0;  // since the last frame; the next one takes as long
    std::filesystem::path state_;
    ImVec2 mouse_{0, 0};
};

}  // namespace slipface
