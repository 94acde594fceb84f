#include "host.h"

#include <emscripten.h>
#include <emscripten/html5.h>
#include <imgui.h>

#include <algorithm>
#include <deque>
#include <set>
#include <utility>

#include "app/parts.h"
#include "keys.h"
#include "widgets/imgui_compat.h"

extern "C" int page_suspends_calls();  // one_thread.cpp

namespace slipface {
namespace {

constexpr const char* canvas = "#canvas";
constexpr int frames_after_event = 3;   // as in a window
constexpr double wheel_pixels = 100.0;  // of one notch

// What happened since the last frame, in order. A press and a release between two frames need a frame each,
// or a slow machine would lose them.
struct Event {
    enum class Kind { move, button, key, text, wheel } kind;
    ImVec2 position{};
    int index = 0;  // button, or ImGuiKey
    bool down = false;
    float notches = 0.0f;
    std::string text{};
    bool ctrl = false, shift = false, alt = false;
};

struct Page {
    std::unique_ptr<App> app;
    std::deque<Event> events;
    std::set<int> keys_down;  // as fed to Dear ImGui
    int frames_due = frames_after_event;
    bool locked = false;  // the browser gave the pointer to the page
    bool wants_lock = false;
    double before_s = 0.0, next_tick_s = 0.0;
    int width = 0, height = 0;
    float scale = 1.0f;
    int cursor = -1;
    std::string title, pasted;
};

Page& page() {
    static Page instance;
    return instance;
}

double seconds_now() {
    return emscripten_get_now() * 1e-3;
}

EM_JS(void, show_title, (const char* title), { document.title = UTF8ToString(title); });
EM_JS(void, show_cursor, (const char* name),
      { document.getElementById("canvas").style.cursor = UTF8ToString(name); });
EM_JS(void, copy_text, (const char* text), { Slipface.copy(UTF8ToString(text)); });
EM_JS(void, show_symptom, (const char* title), { Slipface.read(UTF8ToString(title)); });
EM_JS(void, page_ended, (), { Slipface.ended(); });
EM_JS(void, first_frame_shown, (), { Slipface.shown(); });
EM_JS(void, canvas_size, (int* width, int* height, double* scale), {
    const box = document.getElementById("canvas").getBoundingClientRect();
    setValue(width, Math.round(box.width * devicePixelRatio), "i32");
    setValue(height, Math.round(box.height * devicePixelRatio), "i32");
    setValue(scale, devicePixelRatio, "double");
});
EM_JS(double, canvas_top, (), { return document.getElementById("canvas").getBoundingClientRect().top; });

void push(Event event) {
    page().events.push_back(std::move(event));
    page_needs_frames();
}

ImVec2 pixels(long x, long y) {
    const float scale = page().scale;
    return {static_cast<float>(x) * scale, static_cast<float>(static_cast<double>(y) - canvas_top()) * scale};
}

EM_BOOL on_key(int type, const EmscriptenKeyboardEvent* event, void*) {
    App* const app = page_app();
    if (app == nullptr) return EM_FALSE;
    const bool down = type == EMSCRIPTEN_EVENT_KEYDOWN;
    const std::string code = event->code, key = event->key;
    const bool ctrl = event->ctrlKey != 0 || event->metaKey != 0, typing = ImGui::GetIO().WantTextInput;
    const Shortcut shortcut{key_label(code, key), ctrl, event->shiftKey != 0, event->altKey != 0};
    hold_key(app->context().held, place_of(code), down && !typing && !ctrl);
    const auto made = [&](Event::Kind kind) {
        return Event{.kind = kind, .down = down, .ctrl = ctrl, .shift = shortcut.shift, .alt = shortcut.alt};
    };
    for (const ui::NamedKey& named : ui::named_keys) {
        if (named.name != shortcut.key) continue;
        Event each = made(Event::Kind::key);
        each.index = named.key;
        push(each);
    }
    push(made(Event::Kind::text));  // the modifiers alone
    if (!down) return taken_from_browser(shortcut);
    if (!shortcut.key.empty()) app->key_pressed({shortcut});
    // One character, however many bytes it has; names of keys are longer.
    const bool one = !key.empty() && (static_cast<unsigned char>(key[0]) >= 0x80 || key.size() == 1);
    if (one && (!ctrl || shortcut.alt)) {
        Event text = made(Event::Kind::text);
        text.text = key;
        push(text);
    }
    return taken_from_browser(shortcut);
}

EM_BOOL on_mouse(int type, const EmscriptenMouseEvent* event, void*) {
    App* const app = page_app();
    if (app == nullptr) return EM_FALSE;
    if (page().locked) {
        if (type == EMSCRIPTEN_EVENT_MOUSEMOVE)
            app->context().held.look_pixels +=
                Vec2(static_cast<double>(event->movementX), static_cast<double>(event->movementY)) *
                static_cast<double>(page().scale);
        page_needs_frames();
        return EM_TRUE;
    }
    push({.kind = Event::Kind::move, .position = pixels(event->clientX, event->clientY)});
    if (type == EMSCRIPTEN_EVENT_MOUSEMOVE) return EM_FALSE;
    constexpr int imgui_button[] = {0, 2, 1};  // browsers count the middle button before the right one
    if (event->button > 2) return EM_FALSE;
    push({.kind = Event::Kind::button,
          .index = imgui_button[event->button],
          .down = type == EMSCRIPTEN_EVENT_MOUSEDOWN,
          .ctrl = event->ctrlKey != 0 || event->metaKey != 0,
          .shift = event->shiftKey != 0,
          .alt = event->altKey != 0});
    return EM_FALSE;  // the canvas shall take the keyboard's focus
}

EM_BOOL on_wheel(int, const EmscriptenWheelEvent* event, void*) {
    const double notch = event->deltaMode == DOM_DELTA_PIXEL ? wheel_pixels : 3.0;
    push({.kind = Event::Kind::wheel, .notches = static_cast<float>(-event->deltaY / notch)});
    return EM_TRUE;
}

EM_BOOL on_blur(int, const EmscriptenFocusEvent*, void*) {
    App* const app = page_app();
    if (app == nullptr) return EM_FALSE;
    app->focus_lost();
    for (const int key : page().keys_down)
        push({.kind = Event::Kind::key, .index = key});
    for (int button = 0; button < 3; ++button)
        push({.kind = Event::Kind::button, .index = button});
    return EM_FALSE;
}

// Escape takes the pointer from the page without telling it of the key.
EM_BOOL on_lock(int, const EmscriptenPointerlockChangeEvent* event, void*) {
    page().locked = event->isActive != 0;
    page_needs_frames();
    if (!page().locked && page().wants_lock && page_app() != nullptr)
        page_app()->key_pressed({{.key = "Escape"}});
    return EM_TRUE;
}

EM_BOOL on_resize(int, const EmscriptenUiEvent*, void*) {
    page_needs_frames();
    return EM_TRUE;
}

void feed_events() {
    Page& self = page();
    std::set<int> changed;
    while (!self.events.empty()) {
        const Event& event = self.events.front();
        const bool switches = event.kind == Event::Kind::button || event.kind == Event::Kind::key;
        const int name = event.index + (event.kind == Event::Kind::key ? 100 : 0);
        if (switches && !changed.insert(name).second) break;
        // The pointer must be where it was pressed for one frame.
        if (event.kind == Event::Kind::move && changed.contains(0)) break;
        switch (event.kind) {
            case Event::Kind::move: ui::feed_mouse_position(event.position); break;
            case Event::Kind::button: ui::feed_mouse_button(event.index, event.down); break;
            case Event::Kind::key:
                ui::feed_key(static_cast<ImGuiKey>(event.index), event.down);
                event.down ? void(self.keys_down.insert(event.index))
                           : void(self.keys_down.erase(event.index));
                break;
            case Event::Kind::text:
                if (!event.text.empty()) ui::feed_text(event.text.c_str());
                break;
            case Event::Kind::wheel: ui::feed_wheel(event.notches); break;
        }
        if (event.kind != Event::Kind::move && event.kind != Event::Kind::wheel)
            ui::feed_modifiers(event.ctrl, event.shift, event.alt);
        self.events.pop_front();
    }
    if (!self.events.empty()) self.frames_due = std::max(self.frames_due, frames_after_event);
}

void follow_cursor() {
    Page& self = page();
    const bool wanted = self.app->context().wants_cursor_capture;
    if (wanted != self.wants_lock) {
        self.wants_lock = wanted;
        ImGuiIO& io = ImGui::GetIO();
        if (wanted) {
            io.ConfigFlags |= ImGuiConfigFlags_NoMouse;
            emscripten_request_pointerlock(canvas, EM_TRUE);
        } else {
            io.ConfigFlags &= ~ImGuiConfigFlags_NoMouse;
            if (self.locked) emscripten_exit_pointerlock();
        }
    }
    constexpr const char* names[] = {"default",     "text",        "move",    "ns-resize",  "ew-resize",
                                     "nesw-resize", "nwse-resize", "pointer", "not-allowed"};
    const int cursor = ImGui::GetMouseCursor();
    if (cursor == self.cursor) return;
    self.cursor = cursor;
    show_cursor(cursor < 0
                    ? "none"
                    : names[std::min<std::size_t>(static_cast<std::size_t>(cursor), std::size(names) - 1)]);
}

void fit_canvas() {
    Page& self = page();
    int width = 0, height = 0;
    double scale = 1.0;
    canvas_size(&width, &height, &scale);
    if (width == self.width && height == self.height && static_cast<float>(scale) == self.scale) return;
    self.width = width;
    self.height = height;
    self.scale = static_cast<float>(scale);
    emscripten_set_canvas_element_size(canvas, width, height);
    self.app->set_scale(self.scale);
    self.app->redraw();
}

void frame() {
    Page& self = page();
    App& app = *self.app;
    const double now = seconds_now();
    if (now >= self.next_tick_s || self.frames_due > 0) {
        bool shown_changed = false;
        self.next_tick_s = now + app.tick(now, shown_changed);
        if (shown_changed) page_needs_frames();
    }
    if (self.frames_due <= 0 && now - self.before_s < app.next_frame_s()) return;
    const double seconds = now - self.before_s;
    self.before_s = now;
    fit_canvas();
    if (self.width <= 0 || self.height <= 0) return;
    feed_events();
    app.build_frame(self.width, self.height, seconds);
    --self.frames_due;
    if (app.needs_drawing()) app.draw_frame();
    follow_cursor();
    if (std::string title = window_title(app.editor()); title != self.title) {
        self.title = std::move(title);
        show_title(self.title.c_str());
    }
    static bool shown = false;
    if (!std::exchange(shown, true)) first_frame_shown();
    if (!app.editor().quit) return;
    emscripten_cancel_main_loop();
    self.app.reset();
    page_ended();
}

}  // namespace

App* page_app() {
    return page().app.get();
}

void page_needs_frames() {
    page().frames_due = frames_after_event;
}

void page_pasted(std::string text) {
    page().pasted = std::move(text);
}

void autosave_now() {
    if (page_app() == nullptr) return;
    Editor& editor = page_app()->editor();
    store_preferences(editor);
    if (!editor.document || !editor.session.autosave.active()) return;
    const double now = seconds_now();
    editor.session.autosave.tick(*editor.document, now);
    editor.session.autosave.tick(*editor.document, now + 3600.0);
    static_cast<void>(editor.session.autosave.finish());
}

Status start_page(const PageOptions& options) {
    EmscriptenWebGLContextAttributes attributes;
    emscripten_webgl_init_context_attributes(&attributes);
    attributes.majorVersion = 2;
    attributes.alpha = attributes.depth = attributes.stencil = attributes.antialias = EM_FALSE;
    const EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context = emscripten_webgl_create_context(canvas, &attributes);
    if (context <= 0 || emscripten_webgl_make_context_current(context) != EMSCRIPTEN_RESULT_SUCCESS)
        return Error{"WebGL", "this browser gives no WebGL 2 context"};
    Result<GlTable> gl = load_gl_table(nullptr);
    if (!gl) return gl.error();

    Page& self = page();
    AppOptions app;
    app.gl = std::move(gl).value();
    app.scale = options.scale;
    if (!options.home.empty()) {
        app.config = options.home / ".config";
        app.state = options.home / ".state";
    }
    app.show_symptom = [](const std::string& title) { show_symptom(title.c_str()); };
    self.scale = options.scale;
    // Without `wake` work is done at once.
    if (page_suspends_calls() != 0) app.wake = page_needs_frames;
    self.app = std::make_unique<App>(app);
    self.app->editor().session.shipped_levels = "/assets/levels";  // those below ~ may have been changed
    ui::fill_key_map();
    ui::feed_without_trickling();
    ImGuiIO& io = ImGui::GetIO();
    io.SetClipboardTextFn = [](void*, const char* text) { copy_text(text); };
    io.GetClipboardTextFn = [](void*) { return page().pasted.c_str(); };

    emscripten_set_keydown_callback(EMSCRIPTEN_EVENT_TARGET_WINDOW, nullptr, EM_TRUE, on_key);
    emscripten_set_keyup_callback(EMSCRIPTEN_EVENT_TARGET_WINDOW, nullptr, EM_TRUE, on_key);
    emscripten_set_mousedown_callback(canvas, nullptr, EM_TRUE, on_mouse);
    emscripten_set_mouseup_callback(EMSCRIPTEN_EVENT_TARGET_WINDOW, nullptr, EM_TRUE, on_mouse);
    emscripten_set_mousemove_callback(EMSCRIPTEN_EVENT_TARGET_WINDOW, nullptr, EM_TRUE, on_mouse);
    emscripten_set_wheel_callback(canvas, nullptr, EM_TRUE, on_wheel);
    emscripten_set_blur_callback(EMSCRIPTEN_EVENT_TARGET_WINDOW, nullptr, EM_TRUE, on_blur);
    emscripten_set_resize_callback(EMSCRIPTEN_EVENT_TARGET_WINDOW, nullptr, EM_TRUE, on_resize);
    emscripten_set_pointerlockchange_callback(EMSCRIPTEN_EVENT_TARGET_DOCUMENT, nullptr, EM_TRUE, on_lock);
    self.before_s = seconds_now();
    emscripten_set_main_loop(frame, 0, EM_FALSE);
    return {};
}

}  // namespace slipface
