#include "tools/lab/run_link.h"

#include <fmt/format.h>

#include <system_error>

#include "document/folders.h"
#include "slipface/base/files.h"
#include "slipface/base/hash.h"
#include "slipface/base/line_difference.h"
#include "slipface/level/level_file.h"
#include "tools/lab/lab_actions.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

// The level file of a level that comes with the program, as it came; empty: there is none of this name.
std::string shipped_level_file(const Editor& editor, const std::string& level) {
    const fs::path folder =
        editor.session.shipped_levels.empty() ? data_folder() / "levels" : editor.session.shipped_levels;
    const fs::path name = fs::path(level).filename();
    if (name.string() != level) return {};
    const Result<std::string> text = read_file(folder / fs::path(name).replace_extension(".slipface.json"));
    return text ? *text : std::string();
}

std::string digest_of(std::string_view text) {
    Hasher hasher;
    hasher.text(text);
    return fmt::format("{:016x}", hasher.value());
}

// The text of the capsule's level file; empty: the level's own.
Result<std::string> level_file_of(const Editor& editor, const Capsule& capsule) {
    if (capsule.base.empty()) return capsule.level_file;
    const std::string shipped = shipped_level_file(editor, capsule.level);
    if (shipped.empty())
        return Error{"link", "the run is in the level " + capsule.level +
                                 " that comes with Slipface, and this program came without it"};
    if (digest_of(shipped) != capsule.base)
        return Error{"link", "the run is in another version of the level " + capsule.level +
                                 " than comes with this program; make the link with this version"};
    std::optional<std::string> text = apply_line_difference(shipped, capsule.level_file, max_capsule_bytes);
    if (!text) return Error{"link", "says how the level differs by rows that do not fit it"};
    return std::move(*text);
}

// Of a level whose geometry comes with the program, and so is the same.
std::string short_text(const Level& level) {
    return level_to_json(level, level.guessed.empty() ? LevelText::without_parts : LevelText::whole);
}

// The document with what the capsule says about it, as one step that can be undone; none if it says the same.
Result<std::unique_ptr<Document>> open_with(const fs::path& mesh, const std::string& level_file) {
    Result<std::unique_ptr<Document>> known = Document::open(mesh);
    if (level_file.empty()) return known;
    if (known &&
        (level_to_json((*known)->level()) == level_file || short_text((*known)->level()) == level_file))
        return known;
    Autosave from_link;
    from_link.info.mesh_path = mesh;
    from_link.info.level_path = "link";
    from_link.json = level_file;
    Result<Recovered> opened = open_recovered(from_link);
    if (!opened) return opened.error();
    return std::move(opened->document);
}

}  // namespace

fs::path find_level(const Editor& editor, const std::string& name) {
    if (editor.document && editor.document->level().mesh_path.filename() == name)
        return editor.document->level().mesh_path;
    for (const fs::path& level : sample_levels())
        if (level.filename() == name) return level;
    std::error_code error;
    for (const fs::path& recent : editor.recent.paths())
        if (recent.filename() == name && fs::exists(recent, error)) return recent;
    return {};
}

std::string link_to_run(Editor& editor) {
    if (!editor.document || !editor.lab.has_tape()) return {};
    complete_runs(editor);
    const Level& level = editor.document->level();
    Capsule capsule;
    capsule.level = level.mesh_path.filename().string();
    capsule.tick = editor.lab.cursor();
    capsule.tape = tape_to_text(editor.lab.sealed_tape());
    capsule.level_file = level_to_json(level);
    const std::string whole = capsule_text(capsule);
    const std::string shipped = shipped_level_file(editor, capsule.level);
    if (shipped.empty()) return whole;
    capsule.base = digest_of(shipped);
    capsule.level_file = line_difference(shipped, short_text(level));
    std::string difference = capsule_text(capsule);
    return difference.size() < whole.size() ? difference : whole;
}

Status open_capsule(Editor& editor, const Capsule& capsule) {
    Result<Tape> tape = parse_tape(capsule.tape, "link");
    if (!tape) return tape.error();
    const fs::path mesh = find_level(editor, capsule.level);
    if (mesh.empty()) {
        return Error{"link", "the run is in the level " + capsule.level +
                                 ", which is not here; open that level first, then the link again"};
    }
    const Result<std::string> level_file = level_file_of(editor, capsule);
    if (!level_file) return level_file.error();
    if (editor.document && editor.document->dirty())
        return Error{"link",
                     "the open level has unsaved changes; save or undo them, then open the link again"};
    Result<std::unique_ptr<Document>> opened = open_with(mesh, *level_file);
    if (!opened) return opened.error();
    adopt_document(editor, std::move(opened).value(), mesh);
    if (Status status = editor.lab.open(*editor.document, std::move(*tape), "Link"); !status) return status;
    complete_runs(editor);
    editor.lab.seek(capsule.tick);
    show_lab(editor);
    look_at_cursor(editor);
    editor.status = "Opened the link at tick " + std::to_string(editor.lab.cursor());
    return {};
}

}  // namespace slipface
