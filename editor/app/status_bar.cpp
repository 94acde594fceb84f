// One line: what the mouse would do, the last action, and what is under the mouse.
#include <fmt/format.h>

#include <algorithm>

#include "app/parts.h"
#include "document/path_text.h"
#include "panels/viewport_panel.h"
#include "slipface/base/counted.h"
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
    if (!textures.empty()) text = fmt::format("\uf071 {} missing   ", counted(textures.size(), "texture"));
    if (!document.selection().empty()) text += fmt::format("{} selected   ", document.selection().size());
    text += counted(document.face_count(), "face");
    return text;
}

}  // namespace

void status_bar(Parts& parts) {
    const ui::Palette& p = ui::palette();
    const Editor& editor = parts.editor;
    const std::string right = right_side(parts);
    const float right_width = ImGui::CalcTextSize(right.c_str()).x;
    const float end = ImGui::GetWindowWidth() - right_width - ImGui::GetStyle().WindowPadding.x * 2;

    // The last action matters more than the hint: it gets up to two thirds of the width.
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float y = at.y + ImGui::GetStyle().FramePadding.y, gap = 24 * ui::scale();
    const float room = ImGui::GetWindowPos().x + end - 20 * ui::scale() - at.x;
    const std::string hint =
        editor.document ? viewport_hint(editor) : "Open a level, or drop its file onto the window";
    const std::string done = printable(editor.status);
    const float status =
        done.empty() ? 0.0f : std::min(ImGui::CalcTextSize(done.c_str()).x + 1.0f + gap, room * 0.66f);
    const float hint_width = std::min(ImGui::CalcTextSize(hint.c_str()).x + 1.0f, room - status);
    ui::ellipsis({at.x, y}, at.x + hint_width, p.muted, hint);
    if (status > 0.0f) ui::ellipsis({at.x + hint_width + gap, y}, at.x + hint_width + status, p.text, done);
    if (right.empty()) return;
    ImGui::SetCursorPosX(end);
    ImGui::AlignTextToFramePadding();
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
