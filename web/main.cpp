// What the page's script (web/page/page.js) calls.
#include <emscripten.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/parts.h"
#include "host.h"
#include "slipface/scenes/demo.h"
#include "tools/lab/audit_job.h"
#include "tools/lab/lab_actions.h"
#include "tools/lab/link.h"
#include "tools/lab/reach_job.h"
#include "tools/lab/run_link.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

// Valid until the next call.
const char* answer(std::string text) {
    static std::string kept;
    kept = std::move(text);
    return kept.c_str();
}

nlohmann::json state_of(Editor& editor) {
    nlohmann::json state{{"status", editor.status},
                         {"playing", editor.playtest.has_value()},
                         {"autosaves", editor.session.autosave.written()},
                         {"recoverable", editor.session.left_behind.size()},
                         {"dialog", dialog_is_open(editor)},
                         {"unsaved", false}};
    if (editor.message) state["message"] = editor.message->title + ": " + editor.message->text;
    if (editor.playtest) {
        const Vec3& at = editor.playtest->shown_position();
        state["player"] = {at.x(), at.y(), at.z()};
    }
    if (editor.lab.has_tape()) {
        state["tick"] = editor.lab.cursor();
        state["ticks"] = editor.lab.ticks();
        if (const auto repeats = editor.lab.repeats()) state["repeats"] = *repeats;
    }
    const auto work = [](bool running, double fraction, std::size_t found) {
        return nlohmann::json{{"running", running}, {"fraction", fraction}, {"found", found}};
    };
    if (const AuditJob* const job = editor.audit.get())
        state["audit"] =
            work(job->running(), job->progress(), job->report() ? job->report()->findings.size() : 0);
    if (const ReachJob* const job = editor.reach.get())
        state["reach"] =
            work(job->running(), job->progress(), job->report() ? job->report()->reached.size() : 0);
    if (editor.probe.placed)
        state["probe"] = {editor.probe.move.x(), editor.probe.move.y(), editor.probe.move.z()};
    if (!editor.document) return state;
    const Document& document = *editor.document;
    state["level"] = document.level().mesh_path.string();
    state["level_file"] = document.level().file_path.string();
    state["unsaved"] = document.dirty();
    std::size_t painted = 0;
    for (const auto& face : document.level().overrides)
        painted += face ? 1 : 0;
    state["painted"] = painted;
    return state;
}

}  // namespace
}  // namespace slipface

extern "C" {

// Returns an error's text, or null.
EMSCRIPTEN_KEEPALIVE const char* slipface_start(const char* home, double scale) {
    const slipface::Status started = slipface::start_page({static_cast<float>(scale), home});
    return started ? nullptr : slipface::answer(started.error().text());
}

// As a file dropped onto a window.
EMSCRIPTEN_KEEPALIVE void slipface_open(const char* path) {
    if (slipface::page_app() == nullptr) return;
    slipface::page_app()->drop_file(path);
    slipface::page_needs_frames();
}

EMSCRIPTEN_KEEPALIVE void slipface_autosave() {
    slipface::autosave_now();
}

EMSCRIPTEN_KEEPALIVE void slipface_pasted(const char* text) {
    slipface::page_pasted(text);
}

EMSCRIPTEN_KEEPALIVE int slipface_unsaved() {
    slipface::App* const app = slipface::page_app();
    return app != nullptr && app->editor().document && app->editor().document->dirty() ? 1 : 0;
}

// What the editor shows, as JSON, for scripts/check_web.sh.
EMSCRIPTEN_KEEPALIVE const char* slipface_state() {
    slipface::App* const app = slipface::page_app();
    return slipface::answer(app == nullptr ? "{}" : slipface::state_of(app->editor()).dump());
}

// Opens a link's part behind the '#'. Returns an error's text, or null.
EMSCRIPTEN_KEEPALIVE const char* slipface_open_link(const char* text) {
    slipface::App* const app = slipface::page_app();
    if (app == nullptr) return nullptr;
    slipface::page_needs_frames();
    app->editor().session.tour = -1;  // who follows a link wants to see what it shows
    const slipface::Status opened = slipface::open_link(app->editor(), text);
    return opened ? nullptr : slipface::answer(opened.error().text());
}

// The lab's run as the part of an address behind the '#'; empty: there is none.
EMSCRIPTEN_KEEPALIVE const char* slipface_link() {
    slipface::App* const app = slipface::page_app();
    return slipface::answer(app == nullptr ? "" : slipface::link_to_run(app->editor()));
}

// Plays the lab's run over and over, for a page that has this one in a frame.
EMSCRIPTEN_KEEPALIVE void slipface_loop() {
    slipface::App* const app = slipface::page_app();
    if (app == nullptr) return;
    app->editor().lab.loop = true;
    app->editor().lab.motion = slipface::LabMotion::forward;
    slipface::page_needs_frames();
}

// "name=value", as slipface_setting() gives it; the lab's run follows.
EMSCRIPTEN_KEEPALIVE void slipface_set(const char* assignment) {
    slipface::App* const app = slipface::page_app();
    if (app == nullptr) return;
    slipface::apply_setting(app->editor(), assignment);
    slipface::page_needs_frames();
}

// The switch of a demo's hack: "step_up=on"; empty: there is no such demo, it has no
// switch, or there is no level.
EMSCRIPTEN_KEEPALIVE const char* slipface_switch(const char* demo) {
    slipface::App* const app = slipface::page_app();
    const slipface::DemoInfo* const info = slipface::find_demo(demo);
    if (app == nullptr || info == nullptr || !app->editor().document) return slipface::answer("");
    for (const slipface::SettingInfo& row : slipface::settings_table())
        if (std::string_view(row.name) == info->hack && slipface::is_switch(row))
            return slipface::answer(fmt::format(
                "{}={}", row.name, slipface::setting_text(app->editor().document->level().movement, row)));
    return slipface::answer("");
}

// Where a widget is, in pixels of the canvas: "x y width height"; empty: it is not shown.
EMSCRIPTEN_KEEPALIVE const char* slipface_widget(const char* path) {
    const auto& widgets = slipface::ui::widgets();
    const auto found = widgets.find(std::string_view(path));
    if (found == widgets.end() || !found->second.visible) return slipface::answer("");
    const auto& [min, max] = std::pair(found->second.min, found->second.max);
    return slipface::answer(fmt::format("{} {} {} {}", min.x, min.y, max.x - min.x, max.y - min.y));
}
}

int main() {}
