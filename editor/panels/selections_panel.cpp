// Named selections.
#include "panels/named_rows.h"
#include "panels/panels.h"
#include "panels/property_rows.h"
#include "tools/selection/selecting.h"
#include "widgets/ui.h"

namespace slipface {

void selections_panel(Editor& editor) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Selections");
    const bool any = !editor.document->selection().empty();
    if (ui::button("Save selection", any ? "Save the selected faces under a name" : "Nothing is selected",
                   any))
        save_selection(editor, {});
    const std::vector<SavedSelection> saved(editor.document->saved_selections().begin(),
                                            editor.document->saved_selections().end());
    if (saved.empty()) ui::muted_text("Saved selections: select faces and save them");
    ImGui::Spacing();
    for (std::size_t i = 0; i < saved.size(); ++i) {
        NamedRow row;
        row.name = saved[i].name;
        row.detail = std::to_string(saved[i].faces.size());
        row.tooltip = "Select these faces; with Ctrl to add them, a double click renames";
        row.replace_tooltip = "Replace it by the faces selected now";
        const NamedRowResult did = named_row(i, row, [&](const std::string& name) -> std::string {
            if (name.empty()) return "A selection needs a name";
            const auto found = find_selection(*editor.document, name);
            return found && *found != i ? "Another selection has this name" : "";
        });
        if (did.chosen)
            recall_selection(editor, i, ImGui::GetIO().KeyCtrl ? SelectBy::add : SelectBy::replace);
        if (!did.renamed.empty()) rename_selection(editor, i, did.renamed);
        if (did.replace) replace_selection(editor, i);
        if (did.remove) return remove_selection(editor, i);
    }
}

}  // namespace slipface
