#include "app/app.h"

#include <glad/gl.h>
#include <imgui_internal.h>

#include <algorithm>
#include <utility>

#include "app/draw_hash.h"
#include "app/image_shelf.h"
#include "app/parts.h"
#include "app/scene_view.h"
#include "app/ui_renderer.h"
#include "panels/viewport_panel.h"
#include "tools/lab/link.h"
#include "tools/session/failed_action.h"
#include "tools/session/import_card.h"
#include "widgets/imgui_compat.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr double longest_rest_s = 3600.0;

}  // namespace

struct App::Impl {
    explicit Impl(const AppOptions& given)
        : options(given),
          scene(given.gl, editor, given.draft_from),
          preview(given.gl, editor.session),
          thumbnails(given.gl, editor.session),
          images(given.gl),
          parts(editor, frame) {
        parts.preview = &preview;
        parts.thumbnails = &thumbnails;
        parts.deterministic = given.deterministic;
        parts.hidden_folder = given.hidden_folder;
    }

    // Fonts, spacing and colours as the session wants them.
    void apply_look() {
        const float scale = options.scale * static_cast<float>(editor.session.zoom);
        const bool light = editor.session.theme == Theme::light;
        if (renderer && scale == shown_scale && light == shown_light) return;
        shown_scale = scale;
        shown_light = light;
        ui::use_light_palette(light);
        ui::set_scale(scale);
        ui::apply_theme(scale);
        ui::load_fonts(scale);
        if (!renderer) renderer = std::make_unique<UiRenderer>(options.gl);
        renderer->take_fonts();
        const auto color = [](const ImVec4& c) { return Vec3f(c.x, c.y, c.z); };
        editor.style.background_top = color(ui::palette().view_top);
        editor.style.background_bottom = color(ui::palette().view_bottom);
    }

    // False: the action threw. It has cost no more than itself.
    template <class Action>
    bool attempt(const Action& action) {
        const Checkpoint before = checkpoint(editor);
        std::string what;
        try {
            action();
            return true;
        } catch (const std::bad_alloc&) {
            what = "out of memory";
        } catch (const std::exception& error) {
            what = error.what();
        }
        cancel_viewport_gesture(editor);
        action_failed(editor, before, what.c_str());
        frame.animating = true;
        return false;
    }

    // Which images are missing is known only after the level was uploaded to the graphics card. These
    // warnings open the warnings panel, like all others from opening.
    void take_texture_warnings() {
        if (editor.texture_warnings == scene.texture_warnings()) return;
        editor.texture_warnings = scene.texture_warnings();
        if (!editor.texture_warnings.empty()) editor.layout.show(PanelId::warnings);
        frame.animating = true;  // one more frame shows it
    }

    AppOptions options;
    Editor editor;
    FrameContext frame;
    SceneView scene;
    LevelPreview preview;
    LevelThumbnails thumbnails;
    ImageShelf images;
    Parts parts;
    std::unique_ptr<UiRenderer> renderer;
    ImGuiContext* context = nullptr;
    float shown_scale = 0.0f;
    bool shown_light = false;
    std::uint64_t built_hash = 1, drawn_hash = 0;
    double next_frame_s = 0.0;
    bool window_opened = false;  // by a key, and not drawn yet: what is typed meanwhile is meant for it
};

App::App(const AppOptions& options) : impl_(std::make_unique<Impl>(options)) {
    Impl& self = *impl_;
    self.context = ImGui::CreateContext();
    ImGui::SetCurrentContext(self.context);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.MouseDoubleClickTime = 0.5f;  // s, as desktops have it; frames of a slow machine take a part of it
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard | ImGuiConfigFlags_NavNoCaptureKeyboard;
    io.ConfigInputTextCursorBlink = false;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.MouseDrawCursor = false;

    ui::set_tooltip_delay(options.deterministic ? 0.0 : 0.45);
    self.editor.session.beside = static_cast<bool>(options.wake);
    self.editor.session.wake = options.wake;
    begin_session(self.editor, options.config, options.state);
    self.apply_look();

    reset_viewport_panel();
    self.frame.viewport = &self.scene;
    self.frame.images = &self.images;
}

App::~App() {
    store_preferences(impl_->editor);
    ImGui::SetCurrentContext(impl_->context);
    impl_->renderer.reset();
    ImGui::DestroyContext(impl_->context);
}

Editor& App::editor() {
    return impl_->editor;
}
FrameContext& App::context() {
    return impl_->frame;
}

void App::key_pressed(const KeyPress& press) {
    impl_->attempt([&] { take_key(press); });
}

void App::take_key(const KeyPress& press) {
    Editor& editor = impl_->editor;
    const ImGuiIO& io = ImGui::GetIO();
    const Shortcut& key = press.shortcut;
    const bool escape = key == Shortcut{.key = "Escape"};
    if (take_key_for_rebinding(editor, key)) return;
    if (guide_key(editor, key)) return;
    if (dialog_is_open(editor)) {
        if (escape && !GImGui->ActiveId) close_dialog(editor);
        // In a text box Enter belongs to the box; buttons with the keyboard focus react to Space.
        if (key == Shortcut{.key = "Enter"} && !io.WantTextInput && !editor.session.loading)
            ui::request_accept();
        return;
    }
    if (editor.show_command_palette) {
        if (escape || key == Shortcut{.key = "P", .ctrl = true}) editor.show_command_palette = false;
        return;
    }
    if (escape) {
        if (cancel_viewport_gesture(editor)) return;
        if (editor.playtest) {
            stop_playtest(editor);
            return;
        }
        if (!GImGui->OpenPopupStack.empty()) return;
        if (editor.show_shortcuts && (!GImGui->ActiveId || ui::typing())) {
            editor.show_shortcuts = false;
            return;
        }
        if (editor.import_card.shown && !GImGui->ActiveId) {
            close_import_card(editor);
            return;
        }
        if (editor.layout.focus && !GImGui->ActiveId) {
            editor.layout.focus = false;
            return;
        }
    }
    // While a text box is edited it gets the letters and the keys for its own undo, clipboard and selection.
    const bool plain = !key.ctrl && !key.alt &&
                       (key.key.size() == 1 || key.key == "Delete" || key.key == "Space" ||
                        key.key == "Backspace" || key.key == "Enter" || key.key == "Tab");
    static constexpr std::string_view edited_by_text_boxes = "ZYXCVA";
    const bool editing_key =
        key.ctrl && key.key.size() == 1 && edited_by_text_boxes.find(key.key[0]) != std::string_view::npos;
    const bool typing = ui::typing() || impl_->window_opened;
    if (typing && (plain || editing_key || escape)) return;
    const Command* const command = editor.session.keymap.command_for(key);
    if (!command) return;
    // Keys that move the player or the camera run no commands meanwhile.
    if (plain && viewport_is_flying()) return;
    if (editor.playtest && plain && std::string_view(command->menu) != "Playtest") return;
    const auto open_windows = [&] {
        return (editor.show_shortcuts ? 1 : 0) + (editor.show_command_palette ? 1 : 0) +
               (dialog_is_open(editor) ? 1 : 0);
    };
    const int before = open_windows();
    run_command(editor, command->id);
    if (open_windows() > before) impl_->window_opened = true;
}

void App::drop_file(const std::filesystem::path& path) {
    Editor& editor = impl_->editor;
    if (dialog_is_open(editor)) return;
    impl_->attempt([&] {
        if (!is_link(path.string())) return request_open(editor, path);
        if (const Status opened = open_link(editor, path.string()); !opened)
            editor.message = MessageDialog{"Cannot open the link", opened.error().text(), {}};
    });
}

double App::tick(double now_s, bool& shown_changed) {
    double wait = 1.0;
    const bool done = impl_->attempt([&] {
        wait = tick_session(impl_->editor, now_s, shown_changed);
        if (impl_->preview.ready() || impl_->thumbnails.ready()) shown_changed = true;
        if (!ImGui::GetIO().MouseDown[0]) store_preferences(impl_->editor);
    });
    if (!done) shown_changed = true;
    return wait;
}

void App::focus_lost() {
    impl_->frame.held = {};
    cancel_viewport_gesture(impl_->editor);
}

void App::set_scale(float scale) {
    impl_->options.scale = scale;
}

void App::build_frame(int width, int height, double seconds) {
    Impl& self = *impl_;
    ImGui::SetCurrentContext(self.context);
    ImGuiIO& io = ImGui::GetIO();
    const ImVec2 size{static_cast<float>(std::max(1, width)), static_cast<float>(std::max(1, height))};
    self.frame.seconds = std::clamp(seconds, 1e-4, 0.05);
    // Dear ImGui's clock goes by this: with less than the real time, two slow clicks would be a double click.
    const double real_s = std::clamp(seconds, 1e-4, longest_rest_s);
    self.frame.animating = false;
    self.frame.wants_cursor_capture = false;
    io.DisplaySize = size;
    io.DeltaTime = static_cast<float>(real_s);

    self.apply_look();
    ui::begin_widget_frame();
    self.scene.begin_frame();
    self.preview.begin_frame();
    self.thumbnails.begin_frame();
    ImGui::NewFrame();
    const ui::FrameRecovery recovery;
    // The message about a frame that failed is shown in that frame, lest the next one fails before it.
    if (!self.attempt([&] { layout(self.parts, size); })) {
        recovery.recover();
        if (!self.attempt([&] { dialogs(self.parts); })) recovery.recover();
    }
    if (self.editor.clipboard) ImGui::SetClipboardText(std::exchange(self.editor.clipboard, {})->c_str());
    if (const auto symptom = std::exchange(self.editor.symptom, {})) {
        self.editor.status = "docs/symptoms.md: " + *symptom;
        if (self.options.show_symptom) self.options.show_symptom(*symptom);
    }
    ImGui::Render();
    ui::end_widget_frame();
    self.window_opened = false;
    self.take_texture_warnings();

    if (self.scene.next_is_draft()) self.frame.animating = true;  // one more frame replaces it
    self.frame.held.look_pixels = Vec2::Zero();

    Hasher hasher;
    hasher.u64(hash_draw_data(*ImGui::GetDrawData()));
    hasher.u64(self.scene.wanted_hash());
    hasher.u64(self.preview.hash());
    hasher.u64(self.thumbnails.hash());
    const bool settled = self.built_hash == hasher.value();
    self.built_hash = hasher.value();
    const float dim = self.context->DimBgRatio;
    const bool fading = dim > 0.0f && dim < 1.0f;
    const bool now = self.frame.animating || !settled || fading || ui::windows_are_settling();
    self.next_frame_s = now ? 0.0 : ui::tooltip_due_in_s();
}

double App::next_frame_s() const {
    return impl_->next_frame_s;
}
std::uint64_t App::frame_hash() const {
    return impl_->built_hash;
}
void App::redraw() {
    impl_->drawn_hash = 0;
}
bool App::needs_drawing() const {
    return impl_->built_hash != impl_->drawn_hash;
}

void App::draw_frame() {
    Impl& self = *impl_;
    ImGui::SetCurrentContext(self.context);
    const GladGLContext& gl = *self.options.gl;
    GLint window_framebuffer = 0;
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &window_framebuffer);
    const bool draft = self.scene.next_is_draft();
    self.attempt([&] {
        self.scene.draw();
        self.preview.draw();
        self.thumbnails.draw();
    });
    gl.BindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(window_framebuffer));
    const ImDrawData& data = *ImGui::GetDrawData();
    gl.Viewport(0, 0, static_cast<GLsizei>(data.DisplaySize.x * data.FramebufferScale.x),
                static_cast<GLsizei>(data.DisplaySize.y * data.FramebufferScale.y));
    const ImVec4 ground = ui::palette().window;
    gl.Disable(GL_SCISSOR_TEST);
    gl.ClearColor(ground.x, ground.y, ground.z, 1.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    self.renderer->draw(*ImGui::GetDrawData());
    self.drawn_hash = draft ? 0 : self.built_hash;
}

}  // namespace slipface
