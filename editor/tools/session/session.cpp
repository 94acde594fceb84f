#include "tools/session/session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "tools/commands/commands.h"
#include "tools/editor.h"
#include "tools/lab/lab_actions.h"
#include "tools/lab/reach_job.h"
#include "tools/lab/run_file.h"

namespace slipface {
namespace {

constexpr double watch_interval_s = 1.0;
constexpr const char* back_face_names[] = {"automatic", "always", "never"};  // [BackFaces]
constexpr const char* dock_names[] = {"left", "left_lower", "right", "bottom"};

std::string panel_key(const PanelInfo& info) {
    return std::string("panel.") + info.name;
}

void load_layout(Editor& editor) {
    const Preferences& from = editor.session.preferences;
    PanelLayout& layout = editor.layout;
    const PanelLayout usual;
    layout.left = static_cast<float>(from.number("layout.left", usual.left, 160, 520));
    layout.right = static_cast<float>(from.number("layout.right", usual.right, 200, 640));
    layout.left_lower = static_cast<float>(from.number("layout.left_lower", usual.left_lower, 80, 600));
    layout.bottom = static_cast<float>(from.number("layout.bottom", usual.bottom, 90, 700));
    for (const PanelInfo& info : panel_table()) {
        PanelState& state = layout.panels[static_cast<std::size_t>(info.id)];
        const std::string text = from.text(panel_key(info));
        for (std::size_t dock = 0; dock < dock_count; ++dock) {
            if (!text.starts_with(std::string(dock_names[dock]) + " ")) continue;
            state.dock = static_cast<Dock>(dock);
            state.shown = text.ends_with(" shown") || text.ends_with(" front");
            if (text.ends_with(" front")) layout.front[dock] = info.id;
        }
    }
}

void store_layout(const Editor& editor, Preferences& to) {
    const PanelLayout& layout = editor.layout;
    const PanelLayout usual;
    const auto size = [&](const char* name, float value, float usual_value) {
        if (value == usual_value)
            to.remove(name);
        else
            to.set(name, std::round(static_cast<double>(value)));
    };
    size("layout.left", layout.left, usual.left);
    size("layout.right", layout.right, usual.right);
    size("layout.left_lower", layout.left_lower, usual.left_lower);
    size("layout.bottom", layout.bottom, usual.bottom);
    for (const PanelInfo& info : panel_table()) {
        const auto row = static_cast<std::size_t>(info.id);
        const bool front = layout.front[static_cast<std::size_t>(layout.panels[row].dock)] == info.id;
        if (layout.panels[row] == usual.panels[row] && !front) {
            to.remove(panel_key(info));
            continue;
        }
        const PanelState& state = layout.panels[row];
        to.set(panel_key(info),
               std::string(dock_names[static_cast<std::size_t>(state.dock)]) + (!state.shown ? " hidden"
                                                                                : front      ? " front"
                                                                                             : " shown"));
    }
}

}  // namespace

void begin_session(Editor& editor, const std::filesystem::path& config, const std::filesystem::path& state) {
    Session& session = editor.session;
    if (!config.empty()) {
        session.preferences = Preferences(config / "preferences");
        editor.recent = RecentFiles(config / "recent");
    }
    session.theme = session.preferences.text("theme") == "light" ? Theme::light : Theme::dark;
    session.zoom = session.preferences.number("zoom", 1.0, smallest_zoom, largest_zoom);
    session.keymap.load(session.preferences);
    for (int i = 0; i < 3; ++i)
        if (session.preferences.text("back_faces") == back_face_names[i])
            editor.back_faces = static_cast<BackFaces>(i);
    load_layout(editor);
    if (!config.empty() && !session.preferences.flag("tour.done", false)) session.tour = 0;
    if (state.empty()) return;
    session.recordings = Recordings(state / "recordings");
    session.autosave = AutosaveSession(state / "autosave");
    list_left_behind(editor);
}

void store_preferences(Editor& editor) {
    Session& session = editor.session;
    Preferences& to = session.preferences;
    if (session.theme == Theme::dark)
        to.remove("theme");
    else
        to.set("theme", "light");
    if (session.zoom == 1.0)
        to.remove("zoom");
    else
        to.set("zoom", session.zoom);
    if (editor.back_faces == BackFaces::automatic)
        to.remove("back_faces");
    else
        to.set("back_faces", back_face_names[static_cast<int>(editor.back_faces)]);
    session.keymap.store(to);
    store_layout(editor, to);
    to.save();
}

namespace {

void finish_loading(Editor& editor) {
    Loading loading = std::move(*editor.session.loading);
    editor.session.loading.reset();
    if (loading.kind == Loading::Kind::reload) return finish_reload(editor, std::move(loading));
    const std::string name = loading.path.filename().string();
    Result<Recovered> opened = loading.opening->take();
    if (!opened) {
        if (loading.progress().cancelled())
            editor.status = "Cancelled: " + name + " was not opened";
        else
            editor.message = MessageDialog{"Cannot open " + name, opened.error().text(), {}};
        if (loading.kind == Loading::Kind::recover) editor.session.autosave.let_go(loading.autosave);
        return;
    }
    adopt_document(editor, std::move(opened->document), loading.path);
    restore_tape(editor);
    open_awaited_run(editor);
    if (loading.kind != Loading::Kind::recover) return offer_recovery(editor);
    editor.session.recovered = loading.autosave;
    editor.session.autosave.go_on_from(loading.autosave);
    editor.session.recoverable.clear();
    editor.status = "Recovered " + name + "; undo returns to the saved state";
    report_conflicts(editor, opened->conflicts, opened->other_conflicts, "as saved");
}

}  // namespace

// Small levels load before a progress bar could be drawn.
void await_loading(Editor& editor) {
    constexpr auto moment = std::chrono::milliseconds(120);
    const auto end = std::chrono::steady_clock::now() + moment;
    const bool beside = editor.session.beside;
    while (!editor.session.loading->ready() && (!beside || std::chrono::steady_clock::now() < end))
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (editor.session.loading->ready()) finish_loading(editor);
}

double tick_session(Editor& editor, double now_s, bool& shown_changed) {
    Session& session = editor.session;
    session.now_s = now_s;
    if (session.loading && session.loading->ready()) {
        finish_loading(editor);
        shown_changed = true;
    }
    if (session.doctor && session.doctor->ready()) {
        finish_examination(editor);
        shown_changed = true;
    }
    tick_reach(editor);
    double wait = watch_interval_s;
    if (session.loading || session.doctor || reach_runs(editor)) {
        wait = 0.1;
        shown_changed = true;  // the bar moves
    }
    if (!editor.document) return wait;
    const Document& document = *editor.document;
    const bool asked = session.changed && session.changed->level_file;
    const bool stored = session.autosave.problem().ok();
    session.autosave.tick(document, now_s,
                          asked ? session.changed->level_file->content : document.base().content);
    if (session.autosave.problem().ok() != stored) shown_changed = true;
    if (session.recovered && session.autosave.written() > session.written_before &&
        session.autosave.finish().ok()) {
        session.autosave.discard(*session.recovered);
        session.recovered.reset();
    }
    if (const std::optional<double> due = session.autosave.due_in(document, now_s))
        wait = std::min(wait, std::max(0.02, *due));
    const bool looks = now_s >= session.next_look_s;
    if (looks) session.next_look_s = now_s + watch_interval_s;
    if (looks && look_at_files(editor)) shown_changed = true;
    if (looks && look_at_tape_file(editor)) shown_changed = true;
    return wait;
}

void start_opening(Editor& editor, Loading loading, std::function<Result<Recovered>(Progress&)> work) {
    cancel_loading(editor);
    loading.opening = std::make_unique<Background<Result<Recovered>>>(std::move(work), editor.session.wake);
    editor.session.loading = std::move(loading);
    await_loading(editor);
}

void start_loading(Editor& editor, const std::filesystem::path& path) {
    start_opening(editor, {.kind = Loading::Kind::open, .path = path},
                  [path](Progress& progress) -> Result<Recovered> {
                      Result<std::unique_ptr<Document>> opened = Document::open(path, &progress);
                      if (!opened) return opened.error();
                      return Recovered{std::move(*opened), {}, {}};
                  });
}

void cancel_loading(Editor& editor) {
    if (!editor.session.loading) return;
    editor.status = "Cancelled: " + editor.session.loading->path.filename().string() + " was not opened";
    editor.session.loading->cancel();
    if (editor.session.loading->kind == Loading::Kind::recover)
        editor.session.autosave.let_go(editor.session.loading->autosave);
    editor.session.loading.reset();  // waits for the thread, which stops at its next check
}

void set_zoom(Editor& editor, double zoom) {
    // Steps of a twentieth, so that zooming in and out again returns to the same value.
    editor.session.zoom = std::clamp(std::round(zoom * 20.0) / 20.0, smallest_zoom, largest_zoom);
    editor.status =
        "Interface at " + std::to_string(static_cast<int>(std::lround(editor.session.zoom * 100.0))) + " %";
}

void set_theme(Editor& editor, Theme theme) {
    editor.session.theme = theme;
}

}  // namespace slipface
