#include "app/offscreen_host.h"

#include <algorithm>
#include <cfloat>
#include <utility>

#include "panels/panel_memory.h"
#include "widgets/imgui_compat.h"

namespace slipface {

Result<std::unique_ptr<OffscreenHost>> OffscreenHost::make(const OffscreenOptions& options) {
    if (options.width < 64 || options.height < 64 || options.width > 8192 || options.height > 8192)
        return Error{"picture", "width and height must be 64 to 8192 pixels"};
    if (!(options.scale >= 0.5f && options.scale <= 4.0f))
        return Error{"picture", "the scale must be 0.5..4"};
    Result<std::unique_ptr<OffscreenContext>> context = make_offscreen_context();
    if (!context) return context.error();
    forget_renaming();
    forget_plots();
    forget_input_lanes();
    forget_input_text();
    std::unique_ptr<OffscreenHost> host(new OffscreenHost);
    host->context_ = std::move(context).value();
    host->width_ = options.width;
    host->height_ = options.height;
    host->target_ = std::make_unique<Framebuffer>(host->context_->gl(), options.width, options.height);
    AppOptions app;
    app.gl = host->context_->gl();
    app.scale = options.scale;
    app.deterministic = true;
    app.hidden_folder = options.hidden_folder;
    app.config = options.config;
    app.state = host->state_ = options.state;
    app.draft_from = options.draft_from;
    host->app_ = std::make_unique<App>(app);
    ui::fill_key_map();
    ui::feed_without_trickling();
    host->park_mouse();
    host->frame();
    return host;
}

void OffscreenHost::frame() {
    frame_after(frame_s + std::exchange(rested_s_, 0.0));
}

void OffscreenHost::frame_after(double seconds) {
    clock_s_ += seconds;
    bool shown_changed = false;
    app_->tick(clock_s_, shown_changed);
    app_->build_frame(width_, height_, seconds);
}

void OffscreenHost::rest(double seconds) {
    for (double wait; (wait = std::max(frame_s, app_->next_frame_s())) <= seconds; seconds -= wait)
        frame_after(wait);
    rested_s_ = seconds;
}

void OffscreenHost::want_state_folder() {
    if (!state_.empty()) return;
    Result<TemporaryFolder> made = TemporaryFolder::make();
    if (!made) return;
    state_ = own_state_.emplace(std::move(*made)).path();
    editor().session.recordings = Recordings(state_ / "recordings");
    editor().session.autosave = AutosaveSession(state_ / "autosave");
}

Status OffscreenHost::autosave() {
    want_state_folder();
    Session& session = editor().session;
    if (!editor().document) return Error{"", "nothing is open"};
    if (!session.autosave.active()) return Error{state_.string(), "is no folder for autosaves"};
    const std::size_t before = session.autosave.written();
    session.autosave.tick(*editor().document, clock_s_);
    clock_s_ += 3600.0;
    session.autosave.tick(*editor().document, clock_s_);
    if (const Status status = session.autosave.finish(); !status) return status;
    if (session.autosave.written() == before) return Error{"", "there was nothing to autosave"};
    return {};
}

void OffscreenHost::crash() {
    want_state_folder();
    Session& session = editor().session;
    session.autosave.abandon();
    editor().document.reset();
    session.autosave = AutosaveSession(state_ / "autosave");
    list_left_behind(editor());
}

int OffscreenHost::settle(int maximum) {
    if (editor().playtest) maximum = 1;
    int equal = 0, built = 0;
    while (built < maximum && equal < 2) {
        const std::uint64_t before = app_->frame_hash();
        frame();
        ++built;
        equal = app_->frame_hash() == before ? equal + 1 : 0;
    }
    return built;
}

bool OffscreenHost::draw_if_needed() {
    if (!app_->needs_drawing()) return false;
    target_->bind();
    app_->draw_frame();
    return true;
}

Image OffscreenHost::screenshot() {
    draw_if_needed();
    return target_->read();
}

void OffscreenHost::move_mouse(ImVec2 to) {
    mouse_ = to;
    ui::feed_mouse_position(to);
}

void OffscreenHost::park_mouse() {
    move_mouse({-FLT_MAX, -FLT_MAX});
}
void OffscreenHost::mouse_button(int button, bool down) {
    ui::feed_mouse_button(button, down);
}
void OffscreenHost::wheel(float notches) {
    ui::feed_wheel(notches);
}
void OffscreenHost::modifiers(bool ctrl, bool shift, bool alt) {
    ui::feed_modifiers(ctrl, shift, alt);
}
void OffscreenHost::type(const std::string& utf8) {
    ui::feed_text(utf8.c_str());
}

void OffscreenHost::press_key(const Shortcut& key) {
    modifiers(key.ctrl, key.shift, key.alt);
    const ui::NamedKey* named = nullptr;
    for (const ui::NamedKey& candidate : ui::named_keys)
        if (candidate.name == key.key) named = &candidate;
    if (named) ui::feed_key(named->key, true);
    app_->key_pressed({key});
    frame();
    if (named) ui::feed_key(named->key, false);
    modifiers(false, false, false);
    frame();
}

}  // namespace slipface
