// Reading the open level's files again when another program has written them.
#include <algorithm>
#include <utility>

#include "slipface/base/files.h"
#include "tools/editor.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_level_file_bytes = std::uint64_t{256} << 20;

// The file can be read again: nothing remains to be reported.
void forget_broken(Editor& editor) {
    editor.session.broken.reset();
    if (editor.message && editor.message->of_broken_file) editor.message.reset();
}

// When read unasked, a file that is broken now may be complete in a moment.
void read_failed(Editor& editor, const fs::path& file, const Error& error, bool unasked) {
    const std::string name = file.filename().string();
    if (!unasked) {
        editor.message = MessageDialog{"Cannot read " + name + " again", error.text(), {}};
        return;
    }
    std::optional<BrokenFile>& broken = editor.session.broken;
    const bool reported = broken && broken->reported;
    broken = BrokenFile{file, error.text(), editor.session.now_s, reported};
    if (reported && editor.message && editor.message->of_broken_file) editor.message->text = error.text();
    editor.status = name + " cannot be read; it may still be incomplete, trying again";
}

// Reports it after the delay. The level stays as it was, and is read again as soon as the file is complete.
bool report_broken(Editor& editor) {
    std::optional<BrokenFile>& broken = editor.session.broken;
    if (!broken || broken->reported || editor.message ||
        editor.session.now_s - broken->since_s < broken_patience_s)
        return false;
    broken->reported = true;
    editor.message = MessageDialog{
        broken->file.filename().string() + " has changed and cannot be read", broken->text, {}, true};
    return true;
}

std::string guessed_text(const Document& document) {
    const std::size_t count = document.guessed().size();
    if (count == 0) return {};
    return "; " + std::to_string(count) + (count == 1 ? " face's" : " faces'") +
           " paint was guessed: Select > Guessed paint";
}

bool reload_annotations(Editor& editor) {
    Document& document = *editor.document;
    const fs::path file = document.level().file_path;
    const std::string name = file.filename().string();
    const Result<std::string> text = read_file(file, max_level_file_bytes);
    const Result<LoadedLevel> loaded = text ? level_from_json(*text, file.string(), document.level().mesh)
                                            : Result<LoadedLevel>(text.error());
    if (!loaded) {
        read_failed(editor, file, loaded.error(), true);
        return false;
    }
    // The unsaved changes are now one undo away. Until they are discarded the level counts as unsaved and its
    // autosaves stay, so that the user cannot lose them unnoticed.
    const bool unsaved = document.dirty();
    stop_playtest(editor);
    document.restore(loaded->level, "Reload " + name, loaded->guessed);
    if (!unsaved) {
        document.mark_saved();
        document_is_safe(editor);
    }
    keep_brush_valid(editor);
    editor.status = "Reloaded " + name + ": " + loaded->match.text() + guessed_text(document);
    if (!loaded->warnings.empty()) editor.status += "; " + loaded->warnings.front().message;
    editor.status += unsaved ? "; undo restores your unsaved changes" : "; can be undone";
    return true;
}

void start_reload(Editor& editor, bool unasked) {
    if (!editor.document || editor.document->in_transaction()) return;
    cancel_loading(editor);
    stop_playtest(editor);
    Loading loading{.kind = Loading::Kind::reload,
                    .path = editor.document->level().mesh_path,
                    .autosave = {},
                    .unasked = unasked};
    using Reread = Result<std::optional<LoadedLevel>>;
    // The document does not change meanwhile: the dialog is in front. The thread works on a copy.
    loading.rereading = std::make_unique<Background<Reread>>(
        [level = std::make_shared<const Level>(editor.document->snapshot()), unasked](Progress& progress) {
            if (unasked && !mesh_changed_on_disk(*level)) return Reread(std::nullopt);
            Result<LoadedLevel> loaded = reload_mesh(*level, &progress);
            return loaded ? Reread(std::move(loaded).value()) : Reread(loaded.error());
        },
        editor.session.wake);
    editor.session.loading = std::move(loading);
    await_loading(editor);
}

}  // namespace

void reload_geometry(Editor& editor) {
    start_reload(editor, false);
}

void watch_files(Editor& editor) {
    editor.session.watch.start(editor.document->level().mesh_path, editor.document->level().file_path);
    forget_broken(editor);
}

void finish_reload(Editor& editor, Loading loading) {
    const std::string name = loading.path.filename().string();
    Result<std::optional<LoadedLevel>> loaded = loading.rereading->take();
    if (!loaded && loading.progress().cancelled()) {
        editor.status = "Cancelled: " + name + " was not read again";
        return;
    }
    if (!loaded) return read_failed(editor, loading.path, loaded.error(), loading.unasked);
    if (!*loaded) return watch_files(editor);  // written again with the same bytes
    Document& document = *editor.document;
    const Status status = document.take_geometry(std::move(**loaded), "Reload " + name);
    if (!status) return read_failed(editor, loading.path, status.error(), loading.unasked);
    watch_files(editor);
    geometry_changed(editor);
    editor.status =
        "Reloaded " + name + ": " + document.match().text() + guessed_text(document) + "; can be undone";
}

bool look_at_files(Editor& editor) {
    Session& session = editor.session;
    if (!editor.document || session.loading || editor.document->in_transaction() || editor.playtest)
        return false;
    // A dialog with a question stays; the error of the last attempt is replaced.
    if (editor.unsaved || !session.recoverable.empty() || editor.file_dialog != FileDialogKind::none)
        return false;
    if (!session.watch.poll()) {
        if (session.broken && !session.watch.at_rest()) session.broken->since_s = session.now_s;
        return report_broken(editor);
    }
    const bool mesh = session.watch.mesh_changed();
    bool level_file = session.watch.level_changed();
    if (level_file && session.watch.level_gone()) {
        level_file = false;
        editor.status = editor.document->level().file_path.filename().string() +
                        " no longer exists on disk; saving writes it again";
    } else if (level_file && !session.watch.level_has_other_content()) {
        level_file = false;
    }
    const bool whole = !level_file || reload_annotations(editor);
    if (mesh)
        start_reload(editor, true);
    else if (whole)
        watch_files(editor);
    return true;
}

void step_guessed(Editor& editor, bool forward) {
    if (!editor.document || editor.document->guessed().empty()) return;
    Document& document = *editor.document;
    const std::span<const FaceId> faces = document.guessed();
    // Starts at the selected face, wherever it lies between them.
    const FaceId from = document.selection().size() == 1 ? document.selection()[0] : no_id;
    std::size_t next = forward ? 0 : faces.size() - 1;
    if (from != no_id && forward)
        next = static_cast<std::size_t>(std::upper_bound(faces.begin(), faces.end(), from) - faces.begin()) %
               faces.size();
    else if (from != no_id)
        next = (static_cast<std::size_t>(std::lower_bound(faces.begin(), faces.end(), from) - faces.begin()) +
                faces.size() - 1) %
               faces.size();
    document.select({faces[next]}, "Select guessed paint");
    frame_selected(editor, editor.view_aspect);
    const SurfaceId surface = document.resolved().surface[faces[next]];
    editor.status = "Guessed paint " + std::to_string(next + 1) + " of " + std::to_string(faces.size()) +
                    ": " + document.level().surfaces[surface].name;
}

}  // namespace slipface
