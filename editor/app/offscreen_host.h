// The editor without a window: input is fed by function calls, pictures are read back. Scripts, tests and
// goldens use it.
#pragma once

#include <imgui.h>

#include <memory>
#include <string>

#include "app/app.h"
#include "slipface/image/image.h"

namespace slipface {

struct OffscreenOptions {
    int width = 1280, height = 720;
    float scale = 1.0f;
    std::string hidden_folder;     // left out of messages
    std::filesystem::path config;  // folder for preferences and recent files; empty: nothing is remembered
    std::filesystem::path state;  // folder for autosaves; empty: one of its own when a script wants autosaves
};

class OffscreenHost {
  public:
    static constexpr double frame_s = 1.0 / 60.0;

    static Result<std::unique_ptr<OffscreenHost>> make(const OffscreenOptions& options);
    ~OffscreenHost();

    App& app() { return *app_; }
    Editor& editor() { return app_->editor(); }
    const OffscreenContext& context() const { return *context_; }
    int width() const { return width_; }
    int height() const { return height_; }

    void frame();  // builds one frame of 1/60 s, and does what is due beside the frames
    // Lets an autosave come due and writes it. The reason why not.
    Status autosave();
    // Leaves the autosaves as a crash would, and looks for what it left as the next run would.
    void crash();
    // Builds frames until two in a row are equal, at most `most`. Returns how many.
    // While somebody is walking nothing comes to rest: then it is one.
    int settle(int maximum = 60);
    Image screenshot();  // draws the frame built last
    // Draws the frame built last unless the picture shows it already. True if it drew.
    bool draw_if_needed();

    // Input as a person would give it; each takes effect in the next frame.
    void move_mouse(ImVec2 to);
    void park_mouse();  // outside the window
    void mouse_button(int button, bool down);
    void wheel(float notches);
    void modifiers(bool ctrl, bool shift, bool alt);
    void press_key(const Shortcut& key);  // down for a frame, up for a frame, with its modifiers
    void type(const std::string& utf8);
    ImVec2 mouse() const { return mouse_; }

  private:
    OffscreenHost() = default;

    // In this order: the app's GL objects go before the context.
    std::unique_ptr<OffscreenContext> context_;
    std::unique_ptr<Framebuffer> target_;
    std::unique_ptr<App> app_;
    void want_state_folder();

    int width_ = 0, height_ = 0;
    double clock_s_ = 0.0;
    std::filesystem::path state_, own_state_;
    ImVec2 mouse_{0, 0};
};

}  // namespace slipface
