#include "tools/lab/run_file.h"

#include <fmt/format.h>

#include "slipface/base/files.h"
#include "slipface/base/hash.h"
#include "slipface/base/text.h"
#include "slipface/sim/capsule_file.h"
#include "tools/lab/lab_actions.h"
#include "tools/lab/run_link.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

void refuse(Editor& editor, const fs::path& path, const Error& error) {
    editor.message = MessageDialog{"Cannot open " + path.filename().string(), error.text(), {}};
}

bool has_ending(const fs::path& path, std::string_view ending) {
    return to_lower(path.extension().string()) == ending;
}

// A folder for what is in the capsule, the same for the same bytes.
fs::path folder_for(const Editor& editor, const fs::path& path) {
    const Result<std::string> bytes = read_file(path);
    Hasher hasher;
    hasher.text(bytes ? *bytes : std::string());
    const fs::path& recordings = editor.session.recordings.folder();
    const fs::path state =
        recordings.empty() ? fs::temp_directory_path() / "slipface" : recordings.parent_path();
    return state / "capsules" / fmt::format("{} {:016x}", path.stem().string(), hasher.value());
}

void await(Editor& editor, const fs::path& level, AwaitedRun run) {
    // The level of the run may be open already, as it is to be.
    std::error_code error;
    const bool here = editor.document && fs::equivalent(editor.document->level().mesh_path, level, error);
    editor.awaited_run = std::move(run);
    editor.awaited_run->level = level;
    if (here && !editor.awaited_run->from_capsule) return open_awaited_run(editor);
    leave_document(editor, {.then = UnsavedDialog::Then::open, .open_path = level});
}

void open_tape_with_level(Editor& editor, const fs::path& path) {
    Result<Tape> tape = load_tape(path);
    if (!tape) return refuse(editor, path, tape.error());
    std::error_code error;
    const std::string name = fs::path(tape->level_name).filename().string();
    fs::path level = path.parent_path() / name;
    if (name.empty() || !fs::is_regular_file(level, error)) level = find_level(editor, name);
    if (level.empty() && editor.document) return open_tape(editor, path);
    if (level.empty())
        return refuse(editor, path,
                      {path.string(), name.empty() ? "names no level; open the level first"
                                                   : "was recorded in " + name +
                                                         ", which is not beside it; open that level first"});
    await(editor, level, {.tape = std::move(*tape), .name = path.filename().string(), .file = path});
}

void open_capsule_file(Editor& editor, const fs::path& path) {
    Result<CapsuleFile> capsule = read_capsule_file(path);
    if (!capsule) return refuse(editor, path, capsule.error());
    const Result<fs::path> level = unpack_level(*capsule, folder_for(editor, path));
    if (!level) return refuse(editor, path, level.error());
    await(editor, *level,
          {.tape = std::move(capsule->tape),
           .name = path.filename().string(),
           .tick = capsule->tick,
           .note = capsule->note,
           .from_capsule = true});
}

}  // namespace

bool is_run_file(const fs::path& path) {
    return has_ending(path, ".tape") || has_ending(path, ".capsule");
}

void open_run_file(Editor& editor, const fs::path& path) {
    has_ending(path, ".tape") ? open_tape_with_level(editor, path) : open_capsule_file(editor, path);
}

void open_awaited_run(Editor& editor) {
    if (!editor.document || !editor.awaited_run) return;
    AwaitedRun run = std::move(*editor.awaited_run);
    editor.awaited_run.reset();
    std::error_code error;
    if (!fs::equivalent(editor.document->level().mesh_path, run.level, error)) return;
    if (!run.file.empty()) return open_tape(editor, run.file);
    if (const Status status = editor.lab.open(*editor.document, std::move(run.tape), run.name); !status) {
        editor.message = MessageDialog{"Cannot open " + run.name, status.error().text(), {}};
        return;
    }
    complete_runs(editor);
    editor.lab.seek(run.tick);
    show_lab(editor);
    look_at_cursor(editor);
    editor.status = run.note.empty() ? "Opened " + run.name : run.name + ": " + run.note;
}

void save_capsule(Editor& editor, const fs::path& path) {
    if (!editor.document || !editor.lab.has_tape()) return;
    complete_runs(editor);
    std::size_t left_out = 0;
    const Result<CapsuleFile> capsule = make_capsule_file(editor.document->level(), editor.lab.sealed_tape(),
                                                          editor.lab.cursor(), {}, &left_out);
    const Status status = capsule ? write_capsule_file(*capsule, path) : capsule.error();
    if (!status) {
        editor.message = MessageDialog{.title = "Cannot save " + path.filename().string(),
                                       .text = status.error().text(),
                                       .details = {},
                                       .of_refused_write = true};
        return;
    }
    editor.status = "Saved " + path.filename().string() + ": opens this run on any machine";
    if (left_out > 0) editor.status += fmt::format(", without {} pictures that are too large", left_out);
}

}  // namespace slipface
