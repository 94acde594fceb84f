// The steps of the open document: click one to go there.
#include <string>

#include "panels/panels.h"
#include "panels/property_rows.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {

void history_panel(Editor& editor) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("History");
    Document& document = *editor.document;
    const auto steps = document.history();
    const std::size_t cursor = document.history_cursor();
    std::optional<std::size_t> wanted;

    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(steps.size() + 1));
    while (clipper.Step()) {
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
            const auto at = static_cast<std::size_t>(row);
            const std::string name = at == 0 ? "Opened" : steps[at - 1].name;
            const bool undone = at > cursor, saved = document.saved_cursor() == at;
            const float em = ImGui::GetFontSize();
            const ImVec2 position = ImGui::GetCursorScreenPos();
            const float end = position.x + ImGui::GetContentRegionAvail().x;
            const float mark = end - ImGui::CalcTextSize("saved").x;
            if (ImGui::Selectable(("##" + std::to_string(at)).c_str(), at == cursor)) wanted = at;
            ui::record_last_item(std::to_string(at), !document.in_transaction());
            ui::tooltip(undone ? "Redo up to here" : "Undo back to here");
            ui::ellipsis({position.x + 0.5f * em, position.y}, saved ? mark - 0.5f * em : end,
                         undone ? ui::palette().muted : ui::palette().text, name);
            if (saved) ui::ellipsis({mark, position.y}, end + 1.0f, ui::palette().muted, "saved");
        }
    }
    if (!wanted) return;
    document.go_to(*wanted);
    make_brush_valid(editor);
}

}  // namespace slipface
