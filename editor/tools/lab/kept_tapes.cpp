// Recorded runs that outlive the document they were recorded in.
#include <algorithm>

#include "tools/lab/lab_actions.h"

namespace slipface {
namespace {

constexpr std::size_t max_kept = 16;

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code error;
    return a == b || std::filesystem::equivalent(a, b, error);
}

}  // namespace

void keep_tape(Editor& editor) {
    if (!editor.document || !editor.lab.has_tape() || !editor.lab.unsaved) return;
    complete_runs(editor);
    editor.kept_tapes.push_back(
        {editor.document->level().mesh_path, editor.lab.sealed_tape(), editor.lab.name()});
    if (editor.kept_tapes.size() > max_kept) editor.kept_tapes.erase(editor.kept_tapes.begin());
}

void bring_back_tape(Editor& editor) {
    if (!editor.document) return;
    std::vector<KeptTape>& kept = editor.kept_tapes;
    const auto found = std::find_if(kept.rbegin(), kept.rend(), [&](const KeptTape& one) {
        return same_file(one.level, editor.document->level().mesh_path);
    });
    // A tape that the present level cannot run stays in the list.
    if (found == kept.rend() || !editor.lab.open(*editor.document, found->tape, found->name)) return;
    kept.erase(std::next(found).base());
    editor.lab.unsaved = true;
    show_lab(editor);
    editor.status += "; the run recorded here is back in the lab";
}

}  // namespace slipface
