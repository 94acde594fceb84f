// Reading the open level's files again when another program has written them.
#include "tools/session/reload.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "document/selection.h"
#include "slipface/base/counted.h"
#include "slipface/level/level_sources.h"
#include "tools/editor.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_watched = 1000;  // each is checked once per second

// The file can be read again: nothing remains to be reported.
void forget_broken(Editor& editor) {
    editor.session.broken.reset();
    if (editor.message && editor.message->of_broken_file) editor.message.reset();
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

bool same_materials(const Mesh& a, const Mesh& b) {
    return std::equal(a.materials.begin(), a.materials.end(), b.materials.begin(), b.materials.end(),
                      [](const Material& one, const Material& other) {
                          return one.name == other.name && one.diffuse == other.diffuse &&
                                 one.texture == other.texture && !one.picture == !other.picture &&
                                 (!one.picture || *one.picture == *other.picture);
                      });
}

// Whether the files, read again, have the same geometry and materials.
bool same_content(const Level& a, const Level& b) {
    if (a.mesh.fingerprint() != b.mesh.fingerprint() || !same_materials(*own_mesh(a), *own_mesh(b)))
        return false;
    return std::equal(a.placed.meshes.begin(), a.placed.meshes.end(), b.placed.meshes.begin(),
                      b.placed.meshes.end(), [](const PropMesh& one, const PropMesh& other) {
                          return one.file == other.file && one.problem == other.problem &&
                                 !one.mesh == !other.mesh &&
                                 (!one.mesh || (one.mesh->fingerprint == other.mesh->fingerprint &&
                                                same_materials(*one.mesh, *other.mesh)));
                      });
}

}  // namespace

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

std::string guessed_text(const Document& document) {
    const std::size_t count = document.guessed().size();
    if (count == 0) return {};
    return "; " + counted(count, "face's", "faces'") + " paint was guessed: Select > Guessed paint";
}

void start_reload(Editor& editor, bool unasked, bool materials, std::optional<ChangedAnswer> then) {
    if (!editor.document || editor.document->in_transaction()) return;
    cancel_loading(editor);
    stop_playtest(editor);
    Loading loading{.kind = Loading::Kind::reload,
                    .path = editor.document->level().mesh_path,
                    .autosave = {},
                    .unasked = unasked,
                    .then = then};
    using Reread = Result<std::optional<LoadedLevel>>;
    // The document does not change meanwhile: the dialog is in front. The thread works on a copy.
    loading.rereading = std::make_unique<Background<Reread>>(
        [level = std::make_shared<const Level>(editor.document->snapshot()), unasked,
         materials](Progress& progress) {
            const bool other_mesh = !unasked || mesh_changed_on_disk(*level);
            if (!other_mesh && !materials) return Reread(std::nullopt);
            Result<LoadedLevel> loaded = reload_mesh(*level, &progress);
            if (!loaded) return Reread(loaded.error());
            if (!other_mesh && same_content(loaded->level, *level)) return Reread(std::nullopt);
            return Reread(std::move(loaded).value());
        },
        editor.session.wake);
    editor.session.loading = std::move(loading);
    await_loading(editor);
}

void reload_geometry(Editor& editor) {
    start_reload(editor, false, false);
}

void watch_files(Editor& editor) {
    const Level& level = editor.document->level();
    LevelSources sources = level_sources(level);
    for (std::vector<fs::path>* files : {&sources.meshes, &sources.textures})
        if (files->size() > max_watched) files->resize(max_watched);
    const Result<LevelBase> now = read_level_base(level.file_path);
    const std::optional<ChangedFiles>& asked = editor.session.changed;
    const LevelBase& known = asked && asked->level_file ? *asked->level_file : editor.document->base();
    editor.session.watch.start(level.mesh_path, level.file_path,
                               !now || now->content == known.content || now->content == 0, sources.meshes,
                               sources.textures);
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
    Document& document = *editor.document;
    if (!*loaded) {  // written again with the same bytes
        geometry_is_settled(editor);
        return watch_files(editor);
    }
    if (loading.unasked && document.dirty() && !document.annotations_stay(**loaded)) {
        ask_about_geometry(editor, **loaded);
        return watch_files(editor);
    }
    const Status status = document.take_geometry(std::move(**loaded), "Reload " + name);
    if (!status) return read_failed(editor, loading.path, status.error(), loading.unasked);
    watch_files(editor);
    geometry_changed(editor);
    const MatchSummary& match = document.match();
    const bool kept = match.by_plane == 0 && match.by_nearest == 0 && match.orphaned == 0;
    editor.status = name + " changed and was reloaded" +
                    (kept ? ". All paint kept" : ": " + match.text() + guessed_text(document)) +
                    "; can be undone";
    geometry_is_settled(editor);
    if (loading.then) answer_changed(editor, *loading.then);
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
    const bool mesh = session.watch.mesh_changed(), libraries = session.watch.libraries_changed();
    if (session.watch.textures_changed()) {
        ++editor.texture_revision;
        editor.status = "Read the changed textures again";
    }
    const bool whole = !session.watch.level_changed() || look_at_level_file(editor) != LevelFileState::broken;
    if (mesh || libraries)
        start_reload(editor, true, libraries);
    else if (whole)
        watch_files(editor);
    return true;
}

namespace {

std::vector<FaceId> guesses_among(const Document& document, std::span<const FaceId> ascending) {
    std::vector<FaceId> faces;
    std::set_intersection(document.guessed().begin(), document.guessed().end(), ascending.begin(),
                          ascending.end(), std::back_inserter(faces));
    return faces;
}

}  // namespace

std::vector<FaceId> selected_guesses(const Document& document) {
    return guesses_among(document, document.selection());
}

std::vector<FaceId> guesses_of_part(const Document& document) {
    constexpr double any_angle = 4.0;  // radians
    return guesses_among(document, connected_by_angle(document, selected_guesses(document), any_angle));
}

void settle_guesses(Editor& editor, const std::vector<FaceId>& faces, bool accept) {
    if (!editor.document || faces.empty()) return;
    Document& document = *editor.document;
    if (accept)
        document.accept_guessed(faces);
    else
        document.paint(faces, std::nullopt);
    const std::string count = counted(faces.size(), "guess", "guesses");
    if (!document.guessed().empty() && document.selection().size() <= 1) step_guessed(editor, true);
    editor.status =
        count + (accept ? " accepted, " : " dropped, ") + std::to_string(document.guessed().size()) + " left";
}

void go_to_guess(Editor& editor, std::size_t index) {
    Document& document = *editor.document;
    const std::span<const FaceId> faces = document.guessed();
    if (index >= faces.size()) return;
    const SurfaceId surface = document.surface_of(faces[index]);
    document.select({faces[index]}, "Select guessed paint");
    frame_selected(editor, editor.view_aspect);
    editor.status = "Guessed paint " + std::to_string(index + 1) + " of " + std::to_string(faces.size()) +
                    ": " + document.level().surfaces[surface].name;
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
    go_to_guess(editor, next);
}

}  // namespace slipface
