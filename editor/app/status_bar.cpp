// One line: what the mouse would do, what was done last, and what lies under the mouse.
#include <fmt/format.h>

#include "app/parts.h"
#include "panels/viewport_panel.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

std::string right_side(const Parts& parts) {
    const Editor& editor = parts.editor;
    if (!editor.document) return {};
    const Document& document = *editor.document;
    std::string text;
    const Warnings& textures = editor.texture_warnings;
    if (!textures.empty())
        text =
            fmt::format("\uf071 {} texture{} missing   ", textures.size(), textures.size() == 1 ? "" : "s");
    if (!document.selection().empty()) text += fmt::format("{} selected   ", document.selection().size());
    text += fmt::format("{} faces", document.mesh().face_count());
    return text;
}

}  // namespace

void status_bar(Parts& parts) {
    const ui::Palette& p = ui::palette();
    const Editor& editor = parts.editor;
    const std::string right = right_side(parts);
    const float right_width = ImGui::CalcTextSize(right.c_str()).x;
    const float end = ImGui::GetWindowWidth() - right_width - ImGui::GetStyle().WindowPadding.x * 2;

    ImGui::AlignTextToFramePadding();
    const ImVec2 min = ImGui::GetWindowPos();
    ImGui::PushClipRect(min, {min.x + end - 20 * ui::scale(), min.y + ImGui::GetWindowHeight()}, true);
    if (editor.document)
        ImGui::TextColored(p.muted, "%s", viewport_hint(editor).c_str());
    else
        ImGui::TextColored(p.muted, "Open a level, or drop an OBJ file onto the window");
    if (!editor.status.empty()) {
        ImGui::SameLine(0, 24 * ui::scale());
        ImGui::TextColored(p.text, "%s", editor.status.c_str());
    }
    ImGui::PopClipRect();
    if (right.empty()) return;
    ImGui::SameLine(end);
    ImGui::TextColored(p.muted, "%s", right.c_str());
    if (editor.texture_warnings.empty()) return;
    std::string list;
    for (const Diagnostic& warning : editor.texture_warnings)
        list += warning.text() + "\n";
    list.pop_back();
    ui::record_last_item("Textures");
    ui::tooltip(list.c_str());
}

}  // namespace slipface
