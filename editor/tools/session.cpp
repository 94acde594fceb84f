#include "tools/session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "slipface/base/files.h"
#include "tools/commands.h"
#include "tools/editor.h"
#include "tools/lab_actions.h"

namespace slipface {
namespace {

constexpr double watch_interval_s = 1.0;
constexpr std::uint64_t most_level_file_bytes = std::uint64_t{256} << 20;
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
    load_layout(editor);
    if (!config.empty() && !session.preferences.flag("tour.done", false)) session.tour = 0;
    if (state.empty()) return;
    session.recordings = Recordings(state / "recordings");
    session.autosave = AutosaveSession(state / "autosave");
    session.recoverable = session.autosave.recoverable();
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
    session.keymap.store(to);
    store_layout(editor, to);
    to.save();
}

namespace {

void finish_loading(Editor& editor) {
    Loading loading = std::move(*editor.session.loading);
    editor.session.loading.reset();
    const std::string name = loading.path.filename().string();
    const auto failed = [&](const Error& error) {
        if (loading.progress().cancelled())
            editor.status = "Cancelled: " + name + " was not opened";
        else
            editor.message = MessageDialog{"Cannot open " + name, error.text(), {}};
    };
    if (loading.kind == Loading::Kind::reload) {
        Result<LoadedLevel> loaded = loading.rereading->take();
        if (!loaded) return failed(loaded.error());
        const Status status = editor.document->take_geometry(std::move(loaded).value(), "Reload " + name);
        if (!status) return failed(status.error());
        editor.session.watch.start(editor.document->level().mesh_path, editor.document->level().file_path);
        geometry_changed(editor);
        editor.status = "Reloaded " + name + ": " + editor.document->match().text();
        return;
    }
    Result<std::unique_ptr<Document>> opened = loading.opening->take();
    if (!opened) return failed(opened.error());
    adopt_document(editor, std::move(opened).value(), loading.path);
    bring_back_tape(editor);
    if (loading.kind != Loading::Kind::recover) return;
    editor.session.recovered = loading.autosave;
    std::erase_if(editor.session.recoverable,
                  [&](const AutosaveInfo& info) { return info.file == loading.autosave.file; });
    editor.status = "Recovered " + name + "; undo goes back to the state on disk";
}

// Small levels are there before a progress bar could be drawn.
void wait_a_moment(Editor& editor) {
    constexpr auto moment = std::chrono::milliseconds(120);
    const auto end = std::chrono::steady_clock::now() + moment;
    const bool beside = editor.session.beside;
    while (!editor.session.loading->ready() && (!beside || std::chrono::steady_clock::now() < end))
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (editor.session.loading->ready()) finish_loading(editor);
}

void start_opening(Editor& editor, Loading loading,
                   std::function<Result<std::unique_ptr<Document>>(Progress&)> work) {
    cancel_loading(editor);
    loading.opening =
        std::make_unique<Background<Result<std::unique_ptr<Document>>>>(std::move(work), editor.session.wake);
    editor.session.loading = std::move(loading);
    wait_a_moment(editor);
}

void files_changed(Editor& editor) {
    const FileWatch& watch = editor.session.watch;
    if (editor.document->dirty()) {
        editor.session.reload = ReloadQuestion{watch.mesh_changed(), watch.level_changed()};
        return;
    }
    if (watch.level_changed()) reload_annotations(editor);
    if (watch.mesh_changed()) reload_geometry(editor);
}

}  // namespace

double tick_session(Editor& editor, double now_s, bool& shown_changed) {
    Session& session = editor.session;
    if (session.loading && session.loading->ready()) {
        finish_loading(editor);
        shown_changed = true;
    }
    if (session.doctor && session.doctor->ready()) {
        session.report = session.doctor->take();
        session.doctor.reset();
        session.problem.reset();
        shown_changed = true;
    }
    double wait = watch_interval_s;
    if (session.loading || session.doctor) {
        wait = 0.1;
        shown_changed = true;  // the bar moves
    }
    if (!editor.document) return wait;
    const Document& document = *editor.document;
    session.autosave.tick(document, now_s);
    if (session.recovered && session.autosave.written() > session.written_before &&
        session.autosave.finish().ok()) {
        session.autosave.discard(*session.recovered);
        session.recovered.reset();
    }
    if (const std::optional<double> due = session.autosave.due_in(document, now_s))
        wait = std::min(wait, std::max(0.02, *due));
    const bool looks = now_s >= session.next_look_s;
    if (looks) session.next_look_s = now_s + watch_interval_s;
    if (looks && !session.loading && !session.reload && !document.in_transaction() && !editor.playtest &&
        session.watch.poll()) {
        files_changed(editor);
        shown_changed = true;
    }
    return wait;
}

void start_loading(Editor& editor, const std::filesystem::path& path) {
    start_opening(editor, {.kind = Loading::Kind::open, .path = path},
                  [path](Progress& progress) { return Document::open(path, &progress); });
}

void cancel_loading(Editor& editor) {
    if (!editor.session.loading) return;
    editor.status = "Cancelled: " + editor.session.loading->path.filename().string() + " was not opened";
    editor.session.loading->cancel();
    editor.session.loading.reset();  // waits for the thread, which ends at its next step
}

void reload_geometry(Editor& editor) {
    if (!editor.document || editor.document->in_transaction()) return;
    cancel_loading(editor);
    stop_playtest(editor);
    Loading loading{.kind = Loading::Kind::reload, .path = editor.document->level().mesh_path};
    // The document is not touched while this reads it: the dialog is in front, and it is a copy.
    loading.rereading = std::make_unique<Background<Result<LoadedLevel>>>(
        [level = std::make_shared<const Level>(editor.document->snapshot())](Progress& progress) {
            return reload_mesh(*level, &progress);
        },
        editor.session.wake);
    editor.session.loading = std::move(loading);
    wait_a_moment(editor);
}

void reload_annotations(Editor& editor) {
    if (!editor.document || editor.document->in_transaction()) return;
    Document& document = *editor.document;
    const std::filesystem::path file = document.level().file_path;
    const std::string name = file.filename().string();
    const Result<std::string> text = read_file(file, most_level_file_bytes);
    const Result<LoadedLevel> loaded = text ? level_from_json(*text, file.string(), document.level().mesh)
                                            : Result<LoadedLevel>(text.error());
    editor.session.watch.start(document.level().mesh_path, file);
    if (!loaded) {
        editor.message = MessageDialog{"Cannot read " + name + " again", loaded.error().text(), {}};
        return;
    }
    stop_playtest(editor);
    document.restore(loaded->level, "Reload " + name);
    document.mark_saved();
    keep_brush_valid(editor);
    document_is_safe(editor);
    editor.status = "Reloaded " + name + ": " + loaded->match.text();
    if (!loaded->warnings.empty()) editor.status += "; " + loaded->warnings.front().message;
}

void answer_reload(Editor& editor, ReloadChoice choice) {
    if (!editor.session.reload) return;
    const ReloadQuestion asked = *editor.session.reload;
    editor.session.reload.reset();
    if (!editor.document) return;
    editor.session.watch.start(editor.document->level().mesh_path, editor.document->level().file_path);
    if (choice == ReloadChoice::keep) return;
    if (asked.level_file) reload_annotations(editor);
    if (asked.mesh) reload_geometry(editor);
}

void recover(Editor& editor, std::size_t row) {
    if (row >= editor.session.recoverable.size()) return;
    const AutosaveInfo info = editor.session.recoverable[row];
    Result<Autosave> autosave = read_autosave(info.file);
    if (!autosave) {
        editor.message = MessageDialog{
            "Cannot recover " + info.mesh_path.filename().string(), autosave.error().text(), {}};
        return;
    }
    editor.session.written_before = editor.session.autosave.written();
    start_opening(editor, {.kind = Loading::Kind::recover, .path = info.mesh_path, .autosave = info},
                  [saved = std::move(autosave).value()](Progress& progress) {
                      return open_recovered(saved, &progress);
                  });
}

void discard_recoverable(Editor& editor, std::size_t row) {
    std::vector<AutosaveInfo>& rows = editor.session.recoverable;
    if (row >= rows.size()) return;
    editor.session.autosave.discard(rows[row]);
    rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(row));
}

void look_for_autosaves(Editor& editor) {
    editor.session.recoverable = editor.session.autosave.recoverable();
    if (editor.session.recoverable.empty()) editor.status = "There is nothing to recover";
}

void document_is_safe(Editor& editor) {
    Session& session = editor.session;
    if (!editor.document) return;
    session.autosave.forget(*editor.document);
    if (session.recovered) session.autosave.discard(*session.recovered);
    session.recovered.reset();
}

void set_zoom(Editor& editor, double zoom) {
    // Steps of a twentieth, so that going up and down again arrives where it began.
    editor.session.zoom = std::clamp(std::round(zoom * 20.0) / 20.0, smallest_zoom, largest_zoom);
    editor.status =
        "Interface at " + std::to_string(static_cast<int>(std::lround(editor.session.zoom * 100.0))) + " %";
}

void set_theme(Editor& editor, Theme theme) {
    editor.session.theme = theme;
}

}  // namespace slipface
