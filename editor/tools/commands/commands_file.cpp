// Commands on files and documents.
#include "tools/commands/command_actions.h"
#include "tools/commands/command_rows.h"
#include "tools/commands/icons.h"

namespace slipface {
namespace {

using namespace command_actions;

bool files_changed(const Editor& editor) {
    return editor.session.changed.has_value();
}

template <ChangedAnswer Answer>
void answer(Editor& editor) {
    answer_changed(editor, Answer);
}

bool import_card_is_shown(const Editor& editor) {
    return editor.import_card.shown;
}

void name_materials_by_type(Editor& editor) {
    if (!editor.document || editor.document->in_transaction()) return;
    stop_playtest(editor);
    if (saving_must_wait(editor)) return;
    const Result<std::string> named = editor.document->name_materials();
    if (!named) {
        editor.message = MessageDialog{.title = "Cannot write the types",
                                       .text = named.error().text(),
                                       .details = {},
                                       .of_refused_write = true};
        return;
    }
    geometry_changed(editor);
    document_is_safe(editor);
    watch_files(editor);
    editor.status = *named;
}

}  // namespace

std::vector<Command> file_commands() {
    return {
        {"file.open", icons::folder_open, "Open…", "File",
         "Open a level file, or geometry in any of the formats that can be read", "load import level obj",
         ctrl("O"), always, nullptr, open_file},
        {"file.save", icons::save, "Save", "File",
         "Write the level file next to the OBJ file, which does not change", "write store", ctrl("S"),
         has_document, nullptr, save},
        {"file.save_as", icons::save, "Save as…", "File", "Write the level file under another name",
         "write store copy", ctrl_shift("S"), has_document, nullptr, save_as},
        {"file.reload", icons::refresh, "Reload geometry", "File",
         "Read the geometry again and find the painted faces in it; can be undone", "refresh again hot",
         ctrl("R"), has_document, nullptr, reload_geometry},
        {"file.import_card", icons::expand, "Scale, axis and size…", "File",
         "Show how the geometry's file was read, and change its scale and upward axis",
         "import unit metres up transform spawn holes", no_key(), has_document, import_card_is_shown,
         toggle_import_card},
        {"file.recover", icons::life_ring, "Recover autosaves…", "File",
         "List the unsaved changes of sessions that ended unexpectedly", "crash backup restore autosave",
         no_key(), always, nullptr, look_for_autosaves},
        {"file.keep_mine", icons::save, "Keep mine", "File/Changed on disk",
         "Keep the unsaved changes; the next save replaces the file that another program changed",
         "conflict changed on disk overwrite", no_key(), files_changed, nullptr,
         answer<ChangedAnswer::keep_mine>},
        {"file.take_theirs", icons::refresh, "Take theirs", "File/Changed on disk",
         "Replace the unsaved changes by the files that another program changed; can be undone",
         "conflict changed on disk reload discard", no_key(), files_changed, nullptr,
         answer<ChangedAnswer::take_theirs>},
        {"file.merge_by_face", icons::share, "Merge by face", "File/Changed on disk",
         "Join the unsaved changes and those of the other program; where both changed the same, yours stay; "
         "can be undone",
         "conflict changed on disk join three way", no_key(), files_changed, nullptr,
         answer<ChangedAnswer::merge>},
        {"file.name_materials", icons::save, "Write types into material names", "File",
         "Write the painted types into the OBJ file's material names, which modelling tools preserve; the "
         "old file becomes NAME.bak",
         "export write obj suffix blender hand over", no_key(), has_document, nullptr,
         name_materials_by_type},
        {"file.export_obj", icons::share, "Export OBJ…", "File/Export",
         "Write OBJ and MTL with every face's type in its material's name",
         "write convert blender materials suffix", no_key(), has_document, nullptr,
         ask_for_file<FileDialogKind::export_obj>},
        {"file.export_gltf", icons::share, "Export glTF…", "File/Export",
         "Write glTF 2.0 with the types in its extras; a name ending in .glb gives one file",
         "write convert glb engine", no_key(), has_document, nullptr,
         ask_for_file<FileDialogKind::export_gltf>},
        {"file.export_game", icons::share, "Export for a game…", "File/Export",
         "Write one flat file of types and triangles that a game can read with a few lines of code",
         "write convert flat binary engine", no_key(), has_document, nullptr,
         ask_for_file<FileDialogKind::export_game>},
        {"file.quit", icons::sign_out, "Quit", "File",
         "Quit Slipface; asks first if there are unsaved changes", "exit close leave", ctrl("Q"), always,
         nullptr, request_quit},
    };
}

}  // namespace slipface
