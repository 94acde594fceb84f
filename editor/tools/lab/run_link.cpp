#include "tools/lab/run_link.h"

#include <system_error>

#include "document/folders.h"
#include "slipface/base/files.h"
#include "slipface/level/level_file.h"
#include "slipface/scenes/demo.h"
#include "slipface/sim/capsule.h"
#include "tools/lab/lab_actions.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

fs::path shipped_level(const std::string& name) {
    for (const fs::path& level : sample_levels())
        if (level.filename() == name) return level;
    return {};
}

fs::path find_level(const Editor& editor, const std::string& name) {
    if (editor.document && editor.document->level().mesh_path.filename() == name)
        return editor.document->level().mesh_path;
    if (const fs::path shipped = shipped_level(name); !shipped.empty()) return shipped;
    std::error_code error;
    for (const fs::path& recent : editor.recent.paths())
        if (recent.filename() == name && fs::exists(recent, error)) return recent;
    return {};
}

// The document with what the capsule says about it, as one step that can be undone; none if it says the same.
Result<std::unique_ptr<Document>> open_of(const fs::path& mesh, const Capsule& capsule) {
    Result<std::unique_ptr<Document>> known = Document::open(mesh);
    if (capsule.level_file.empty() || (known && level_to_json((*known)->level()) == capsule.level_file))
        return known;
    Autosave from_link;
    from_link.info.mesh_path = mesh;
    from_link.info.level_path = "link";
    from_link.json = capsule.level_file;
    return open_recovered(from_link);
}

}  // namespace

std::string link_to_run(Editor& editor) {
    if (!editor.document || !editor.lab.has_tape()) return {};
    complete_runs(editor);
    const Level& level = editor.document->level();
    Capsule capsule;
    capsule.level = level.mesh_path.filename().string();
    capsule.tick = editor.lab.cursor();
    capsule.tape = tape_to_text(editor.lab.sealed_tape());
    capsule.level_file = level_to_json(level);
    return capsule_text(capsule);
}

Status open_link(Editor& editor, std::string_view text) {
    if (text.starts_with('#')) text.remove_prefix(1);
    constexpr std::string_view demo = "demo=";
    if (text.starts_with(demo)) {
        const std::string name(text.substr(demo.size()));
        const DemoInfo* const info = find_demo(name);
        if (info == nullptr) return Error{"link", "there is no demo \"" + name + "\""};
        open_demo(editor, *info);
        return {};
    }
    const Result<Capsule> capsule = parse_capsule(text);
    if (!capsule) return capsule.error();
    Result<Tape> tape = parse_tape(capsule->tape, "link");
    if (!tape) return tape.error();
    const fs::path mesh = find_level(editor, capsule->level);
    if (mesh.empty()) {
        return Error{"link", "the run is in the level " + capsule->level +
                                 ", which is not here; open that level first, then the link again"};
    }
    if (editor.document && editor.document->dirty())
        return Error{"link",
                     "the open level has unsaved changes; save or undo them, then open the link again"};
    Result<std::unique_ptr<Document>> opened = open_of(mesh, *capsule);
    if (!opened) return opened.error();
    adopt_document(editor, std::move(opened).value(), mesh);
    if (Status status = editor.lab.open(*editor.document, std::move(*tape), "Link"); !status) return status;
    complete_runs(editor);
    editor.lab.seek(capsule->tick);
    show_lab(editor);
    look_at_cursor(editor);
    editor.status = "Opened the link at tick " + std::to_string(editor.lab.cursor());
    return {};
}

}  // namespace slipface
