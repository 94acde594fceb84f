// The level's cameras.
#include <fmt/format.h>

#include "panels/named_rows.h"
#include "panels/panels.h"
#include "panels/property_rows.h"
#include "tools/commands/icons.h"
#include "tools/view/cameras.h"
#include "widgets/ui.h"

namespace slipface {

void cameras_panel(Editor& editor) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Cameras");
    if (ui::button("Add camera", "Save this view as a camera (camera.add)")) save_camera(editor, {});
    const std::vector<CameraBookmark> cameras = editor.document->level().cameras;
    if (cameras.empty()) ui::muted_text("Saved views; snapshots use them");
    ImGui::Spacing();
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        NamedRow row;
        row.name = cameras[i].name;
        row.detail = i < 9 ? fmt::format("Shift+F{}", i + 1) : "";
        row.tooltip = "Go there; a double click renames it";
        row.replace_tooltip = "Replace this camera by the current view";
        row.chosen = editor.camera_shown == i;
        const NamedRowResult did = named_row(
            i, row, [&](const std::string& name) { return camera_name_problem(*editor.document, i, name); });
        if (did.chosen) go_to_camera(editor, i);
        if (!did.renamed.empty()) rename_camera(editor, i, did.renamed);
        if (did.replace) replace_camera(editor, i);
        if (did.remove) return remove_camera(editor, i);
    }
}

}  // namespace slipface
