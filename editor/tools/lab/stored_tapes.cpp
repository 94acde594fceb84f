// Recorded runs that outlive the document they were recorded in.
#include <algorithm>

#include "tools/lab/lab_actions.h"

namespace slipface {
namespace {

constexpr std::size_t max_stored = 16;

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code error;
    return a == b || std::filesystem::equivalent(a, b, error);
}

}  // namespace

void store_tape(Editor& editor) {
    if (!editor.document || !editor.lab.has_tape() || !editor.lab.unsaved) return;
    complete_runs(editor);
    editor.stored_tapes.push_back(
        {editor.document->level().mesh_path, editor.lab.sealed_tape(), editor.lab.name()});
    if (editor.stored_tapes.size() > max_stored) editor.stored_tapes.erase(editor.stored_tapes.begin());
}

void restore_tape(Editor& editor) {
    if (!editor.document) return;
    std::vector<StoredTape>& stored = editor.stored_tapes;
    const auto found = std::find_if(stored.rbegin(), stored.rend(), [&](const StoredTape& one) {
        return same_file(one.level, editor.document->level().mesh_path);
    });
    // A tape that the present level cannot run stays in the list.
    if (found == stored.rend() || !editor.lab.open(*editor.document, found->tape, found->name)) return;
    stored.erase(std::next(found).base());
    editor.lab.unsaved = true;
    show_lab(editor);
    editor.status += "; the run recorded here is back in the lab";
}

}  // namespace slipface
