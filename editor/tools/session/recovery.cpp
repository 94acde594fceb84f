// Autosaves of ended sessions, and recovering them.
#include <algorithm>
#include <system_error>
#include <utility>

#include "tools/editor.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    return a == b || fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error);
}

void forget(std::vector<AutosaveInfo>& rows, const AutosaveInfo& autosave) {
    std::erase_if(rows, [&](const AutosaveInfo& row) { return row.file == autosave.file; });
}

}  // namespace

void request_recovery(Editor& editor, const AutosaveInfo& autosave) {
    leave_document(editor, {.then = UnsavedDialog::Then::recover, .open_path = {}, .autosave = autosave});
}

void recover(Editor& editor, const AutosaveInfo& info) {
    Session& session = editor.session;
    const std::string title = "Cannot recover " + info.mesh_path.filename().string();
    if (!session.autosave.hold(info)) {
        editor.message = MessageDialog{title, "Another Slipface has recovered these changes meanwhile.", {}};
        look_for_autosaves(editor);
        return;
    }
    Result<Autosave> autosave = read_autosave(info.file);
    if (!autosave) {
        editor.message = MessageDialog{title, autosave.error().text(), {}};
        session.autosave.let_go(info);
        return;
    }
    session.written_before = session.autosave.written();
    Loading loading{.kind = Loading::Kind::recover, .path = info.mesh_path, .autosave = autosave->info};
    start_opening(editor, std::move(loading), [saved = std::move(*autosave)](Progress& progress) {
        return open_recovered(saved, &progress);
    });
}

void discard_autosave(Editor& editor, const AutosaveInfo& given) {
    const AutosaveInfo autosave = given;  // a copy: `given` may be an element of the lists below
    editor.session.autosave.discard(autosave);
    forget(editor.session.recoverable, autosave);
    forget(editor.session.left_behind, autosave);
}

void look_for_autosaves(Editor& editor) {
    Session& session = editor.session;
    session.recoverable = session.autosave.recoverable();
    if (session.recoverable.empty()) editor.status = "There is nothing to recover";
}

void list_left_behind(Editor& editor) {
    editor.session.left_behind = editor.session.autosave.recoverable();
    std::erase_if(editor.session.left_behind, [](const AutosaveInfo& row) { return row.saved_since; });
}

void offer_recovery(Editor& editor) {
    Session& session = editor.session;
    session.recoverable = session.autosave.recoverable();
    std::erase_if(session.recoverable, [&](const AutosaveInfo& row) {
        return !editor.document || !same_file(row.mesh_path, editor.document->level().mesh_path);
    });
    const std::size_t saved_since =
        std::erase_if(session.recoverable, [](const AutosaveInfo& row) { return row.saved_since; });
    if (saved_since > 0)
        editor.status += "; unsaved changes from before the last save: File > Recover autosaves";
    list_left_behind(editor);
}

void document_is_safe(Editor& editor) {
    Session& session = editor.session;
    if (!editor.document) return;
    session.autosave.forget(*editor.document);
    if (session.recovered) session.autosave.discard(*session.recovered);
    session.recovered.reset();
}

}  // namespace slipface
