#include "app/glfw_host.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "app/app.h"
#include "app/glfw_keys.h"
#include "app/parts.h"
#include "document/folders.h"
#include "process/process.h"
#include "slipface/base/text.h"
#include "tools/lab/link.h"
#include "tools/review/review.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr std::size_t draft_from = 250'000;  // triangles
constexpr int frames_after_event =
    3;  // popups, tooltips and auto-sized windows need up to this many frames to settle
constexpr double stick_dead_zone = 0.18;
constexpr double stick_look_radians_s = 2.6;

std::string last_error_text;

void remember_error(int, const char* description) {
    last_error_text = description ? description : "";
}

// A key that is pressed and released between two frames counts as down in the frame that follows, or a slow
// machine would lose what is typed. Dear ImGui queues such events by itself since 1.87.
class ShortPresses {
  public:
    void press([[maybe_unused]] int key) {
#if IMGUI_VERSION_NUM < 18700
        if (key >= 0 && key <= GLFW_KEY_LAST) pressed_.push_back(key);
#endif
    }
    void begin_frame() {
#if IMGUI_VERSION_NUM < 18700
        // What is still down needs no help.
        std::erase_if(pressed_, [](int key) { return ImGui::GetIO().KeysDown[key]; });
#endif
        set(true);
    }
    void end_frame() {
        set(false);
        pressed_.clear();
    }

  private:
    void set([[maybe_unused]] bool down) {
#if IMGUI_VERSION_NUM < 18700
        ImGuiIO& io = ImGui::GetIO();
        for (const int key : pressed_)
            io.KeysDown[key] = down;
        const auto either = [&](int left, int right) { return io.KeysDown[left] || io.KeysDown[right]; };
        io.KeyCtrl = either(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
        io.KeyShift = either(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
        io.KeyAlt = either(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
#endif
    }
    std::vector<int> pressed_;  // since the last frame
};

struct Window {
    GLFWwindow* handle = nullptr;
    App* app = nullptr;
    int frames_due = frames_after_event;
    ShortPresses short_presses;
    bool captured = false;
    bool has_cursor = false;
    double cursor_x = 0.0, cursor_y = 0.0;
    std::string title;
    std::function<void(App&)> between_turns;
};

Window& of(GLFWwindow* handle) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(handle));
}

void wake(GLFWwindow* handle) {
    of(handle).frames_due = frames_after_event;
}

void on_key(GLFWwindow* handle, int key, int scancode, int action, int mods) {
    wake(handle);
    Window& window = of(handle);
    if (!window.app) return;
    HeldKeys& held = window.app->context().held;
    const bool typing = ui::typing();
    hold_key(held, place_of(key), action != GLFW_RELEASE && !typing && (mods & GLFW_MOD_CONTROL) == 0);
    if (action == GLFW_RELEASE) return;
    window.short_presses.press(key);
    const Shortcut shortcut = shortcut_of(key, scancode, mods);
    if (!shortcut.key.empty()) window.app->key_pressed({shortcut});
}

void on_cursor(GLFWwindow* handle, double x, double y) {
    wake(handle);
    Window& window = of(handle);
    if (window.captured && window.has_cursor && window.app)
        window.app->context().held.look_pixels += Vec2(x - window.cursor_x, y - window.cursor_y);
    window.cursor_x = x;
    window.cursor_y = y;
    window.has_cursor = true;
}

void on_focus(GLFWwindow* handle, int focused) {
    wake(handle);
    if (!focused && of(handle).app) of(handle).app->focus_lost();
}

void on_drop(GLFWwindow* handle, int count, const char** paths) {
    wake(handle);
    if (count > 0 && of(handle).app) of(handle).app->drop_file(paths[0]);
}

void on_close(GLFWwindow* handle) {
    wake(handle);
    glfwSetWindowShouldClose(handle, GLFW_FALSE);
    if (of(handle).app) request_quit(of(handle).app->editor());
}

// Dear ImGui's backend calls these before its own when it is installed after them.
void install_callbacks(GLFWwindow* handle) {
    glfwSetKeyCallback(handle, on_key);
    glfwSetCursorPosCallback(handle, on_cursor);
    glfwSetWindowFocusCallback(handle, on_focus);
    glfwSetDropCallback(handle, on_drop);
    glfwSetWindowCloseCallback(handle, on_close);
    glfwSetCharCallback(handle, [](GLFWwindow* w, unsigned) { wake(w); });
    glfwSetMouseButtonCallback(handle, [](GLFWwindow* w, int, int, int) { wake(w); });
    glfwSetScrollCallback(handle, [](GLFWwindow* w, double, double) { wake(w); });
    glfwSetCursorEnterCallback(handle, [](GLFWwindow* w, int) { wake(w); });
    glfwSetWindowRefreshCallback(handle, [](GLFWwindow* w) {
        wake(w);
        if (of(w).app) of(w).app->redraw();
    });
    glfwSetFramebufferSizeCallback(handle, [](GLFWwindow* w, int, int) {
        wake(w);
        if (of(w).app) of(w).app->redraw();
    });
    glfwSetWindowIconifyCallback(handle, [](GLFWwindow* w, int) { wake(w); });
}

double past_dead_zone(float value) {
    const double v = static_cast<double>(value);
    if (std::abs(v) < stick_dead_zone) return 0.0;
    return std::copysign((std::abs(v) - stick_dead_zone) / (1.0 - stick_dead_zone), v);
}

// A button that both hold is let go by either.
void read_gamepad(HeldKeys& held, ButtonSet& before) {
    constexpr std::array<std::pair<std::string_view, int>, 6> places{
        {{"A", GLFW_GAMEPAD_BUTTON_A},
         {"B", GLFW_GAMEPAD_BUTTON_B},
         {"X", GLFW_GAMEPAD_BUTTON_X},
         {"Y", GLFW_GAMEPAD_BUTTON_Y},
         {"LB", GLFW_GAMEPAD_BUTTON_LEFT_BUMPER},
         {"RB", GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER}}};
    GLFWgamepadstate pad;
    held.stick = held.look_stick = Vec2::Zero();
    ButtonSet now;
    if (glfwGetGamepadState(GLFW_JOYSTICK_1, &pad)) {
        held.stick = {past_dead_zone(pad.axes[GLFW_GAMEPAD_AXIS_LEFT_X]),
                      -past_dead_zone(pad.axes[GLFW_GAMEPAD_AXIS_LEFT_Y])};
        held.look_stick = Vec2(past_dead_zone(pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_X]),
                               -past_dead_zone(pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y])) *
                          stick_look_radians_s;
        for (const ButtonInfo& info : button_table())
            for (const auto& [name, place] : places)
                if (name == info.pad) now.set(info.button, pad.buttons[place] == GLFW_PRESS);
    }
    for (const ButtonInfo& info : button_table())
        if (now.has(info.button) != before.has(info.button))
            held.buttons.set(info.button, now.has(info.button));
    before = now;
}

void capture_cursor(Window& window, bool wanted) {
    if (window.captured == wanted) return;
    window.captured = wanted;
    window.has_cursor = false;
    glfwSetInputMode(window.handle, GLFW_CURSOR, wanted ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    ImGuiIO& io = ImGui::GetIO();
    if (wanted)
        io.ConfigFlags |= ImGuiConfigFlags_NoMouse;
    else
        io.ConfigFlags &= ~ImGuiConfigFlags_NoMouse;
}

void show_title(Window& window) {
    std::string title = window_title(window.app->editor());
    if (title == window.title) return;
    window.title = std::move(title);
    glfwSetWindowTitle(window.handle, window.title.c_str());
}

void run_loop(Window& window) {
    using Clock = std::chrono::steady_clock;
    App& app = *window.app;
    ButtonSet gamepad;
    const Clock::time_point start = Clock::now();
    Clock::time_point before = start;
    while (!app.editor().quit) {
        if (window.between_turns) window.between_turns(app);
        bool shown_changed = false;
        const double wait =
            app.tick(std::chrono::duration<double>(Clock::now() - start).count(), shown_changed);
        if (shown_changed) window.frames_due = std::max(window.frames_due, frames_after_event);
        const auto since_frame_s = [&] {
            return std::chrono::duration<double>(Clock::now() - before).count();
        };
        const double frame_in_s = app.next_frame_s() - since_frame_s();
        if (frame_in_s <= 0.0 || window.frames_due > 0)
            glfwPollEvents();
        else
            glfwWaitEventsTimeout(std::max(0.01, std::min(wait, frame_in_s)));
        const double seconds = since_frame_s();
        if (window.frames_due <= 0 && seconds < app.next_frame_s()) continue;
        before = Clock::now();
        int width = 0, height = 0;
        glfwGetWindowSize(window.handle, &width, &height);
        if (width <= 0 || height <= 0) {
            window.frames_due = 0;
            continue;
        }
        if (app.editor().playtest) read_gamepad(app.context().held, gamepad);
        ImGui_ImplGlfw_NewFrame();
        window.short_presses.begin_frame();
        app.build_frame(width, height, seconds);
        window.short_presses.end_frame();
        --window.frames_due;
        if (app.needs_drawing()) {
            app.draw_frame();
            glfwSwapBuffers(window.handle);
        } else {
            // No frame is drawn, so no buffer swap waits for the screen: without a pause this loop would
            // spin.
            std::this_thread::sleep_for(std::chrono::milliseconds(8));
        }
        capture_cursor(
            window, app.context().wants_cursor_capture && glfwGetWindowAttrib(window.handle, GLFW_FOCUSED));
        show_title(window);
    }
}

// The window's position is stored in design pixels of the screen. It is not restored if no screen shows it
// any more.
bool on_a_screen(int x, int y, int width) {
    int count = 0;
    GLFWmonitor** const monitors = glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i) {
        int left = 0, top = 0, screen_width = 0, screen_height = 0;
        glfwGetMonitorWorkarea(monitors[i], &left, &top, &screen_width, &screen_height);
        // Enough of the title bar to grab it.
        if (y >= top && y < top + screen_height - 40 && x + width > left + 80 && x < left + screen_width - 80)
            return true;
    }
    return false;
}

struct WindowBounds {
    int width = 1440, height = 900;
    std::optional<std::pair<int, int>> at;
    bool maximized = false;
};

WindowBounds remembered_window(const Preferences& preferences, const WindowOptions& options) {
    WindowBounds bounds{options.width, options.height, {}, preferences.flag("window.maximized", false)};
    bounds.width = static_cast<int>(preferences.number("window.width", bounds.width, 480, 16384));
    bounds.height = static_cast<int>(preferences.number("window.height", bounds.height, 320, 16384));
    int left = 0, top = 0, width = 0, height = 0;
    if (GLFWmonitor* const monitor = glfwGetPrimaryMonitor()) {
        glfwGetMonitorWorkarea(monitor, &left, &top, &width, &height);
        if (width > 0) bounds.width = std::min(bounds.width, width);
        if (height > 0) bounds.height = std::min(bounds.height, height);
    }
    if (preferences.text("window.x").empty()) return bounds;
    const int x = static_cast<int>(preferences.number("window.x", 0, -32768, 32768));
    const int y = static_cast<int>(preferences.number("window.y", 0, -32768, 32768));
    if (on_a_screen(x, y, bounds.width)) bounds.at = std::pair{x, y};
    return bounds;
}

void remember_window(GLFWwindow* handle, Preferences& preferences) {
    const bool maximized = glfwGetWindowAttrib(handle, GLFW_MAXIMIZED) == GLFW_TRUE;
    preferences.set("window.maximized", maximized);
    if (maximized) return;
    int x = 0, y = 0, width = 0, height = 0;
    glfwGetWindowPos(handle, &x, &y);
    glfwGetWindowSize(handle, &width, &height);
    preferences.set("window.x", static_cast<double>(x));
    preferences.set("window.y", static_cast<double>(y));
    preferences.set("window.width", static_cast<double>(width));
    preferences.set("window.height", static_cast<double>(height));
}

struct Library {
    Library() { glfwSetErrorCallback(remember_error); }
    ~Library() { glfwTerminate(); }
};

// Opens docs/symptoms.md at a section, as a page of the site if it was built, in the user's own program.
void show_symptom(const std::string& title) {
    const std::filesystem::path beside = data_folder().parent_path();
    std::error_code error;
    for (const char* name : {"out/site/docs/symptoms.html", "docs/symptoms.md", "doc/Slipface/symptoms.md",
                             "doc/slipface/symptoms.md"}) {
        if (!std::filesystem::exists(beside / name, error)) continue;
        std::string anchor;
        for (const char c : to_lower(title))
            if (c != ',') anchor += c == ' ' ? '-' : c;
        const auto opened = start_process({.words = {"-c", "xdg-open \"$0\" >/dev/null 2>&1 &",
                                                     "file://" + (beside / name).string() + "#" + anchor},
                                           .program = "sh"});
        if (opened) wait_for(*opened);
        return;
    }
}

}  // namespace

Status run_window(const WindowOptions& options) {
    const Library library;
    if (!glfwInit())
        return Error{"window", last_error_text.empty() ? "there is no display" : last_error_text};
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "slipface");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "slipface");
    const WindowBounds bounds = remembered_window(
        options.config.empty() ? Preferences() : Preferences(options.config / "preferences"), options);
    glfwWindowHint(GLFW_MAXIMIZED, bounds.maximized ? GLFW_TRUE : GLFW_FALSE);
    Window window;
    window.handle = glfwCreateWindow(bounds.width, bounds.height, "Slipface", nullptr, nullptr);
    if (!window.handle)
        return Error{"window", last_error_text.empty() ? "OpenGL 3.3 is not available" : last_error_text};
    if (bounds.at) glfwSetWindowPos(window.handle, bounds.at->first, bounds.at->second);
    glfwSetWindowUserPointer(window.handle, &window);
    glfwSetWindowSizeLimits(window.handle, 480, 320, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwMakeContextCurrent(window.handle);
    glfwSwapInterval(1);
    Result<GlTable> gl = load_gl_table(glfwGetProcAddress);
    if (!gl) {
        glfwDestroyWindow(window.handle);
        return gl.error();
    }
    float scale = options.scale;
    if (scale <= 0.0f) {
        glfwGetWindowContentScale(window.handle, &scale, nullptr);
        scale = std::clamp(std::isfinite(scale) ? scale : 1.0f, 0.75f, 4.0f);
    }
    install_callbacks(window.handle);
    {
        AppOptions app_options;
        app_options.gl = std::move(gl).value();
        app_options.scale = scale;
        app_options.config = options.config;
        app_options.state = options.state;
        app_options.draft_from = draft_from;
        app_options.wake = glfwPostEmptyEvent;  // may be called from any thread
        app_options.show_symptom = show_symptom;
        App app(app_options);
        ImGui_ImplGlfw_InitForOpenGL(window.handle, true);
        window.app = &app;
        window.between_turns = options.between_turns;
        if (!options.level.empty()) start_loading(app.editor(), options.level);
        if (!options.link.empty())
            if (const Status opened = open_link(app.editor(), options.link); !opened)
                app.editor().message = MessageDialog{"Cannot open the link", opened.error().text(), {}};
        if (!options.review.empty()) open_review(app.editor(), options.review);
        run_loop(window);
        remember_window(window.handle, app.editor().session.preferences);
        window.frames_due = 0;
        window.app = nullptr;
        ImGui_ImplGlfw_Shutdown();
    }
    glfwDestroyWindow(window.handle);
    return {};
}

}  // namespace slipface
