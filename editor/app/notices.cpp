// What needs the user's attention until it is settled: a row each, below the toolbar.
#include <cmath>
#include <vector>

#include "app/dialog_parts.h"
#include "app/parts.h"
#include "document/path_text.h"
#include "slipface/base/counted.h"
#include "tools/commands/commands.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

struct Notice {
    const char* name;  // of its widget
    std::string text;
    std::vector<const char*> commands;  // ids: its buttons
};

std::vector<Notice> notices_of(const Parts& parts) {
    const Session& session = parts.editor.session;
    std::vector<Notice> notices;
    if (session.changed) {
        Notice notice{"Changed", session.changed->question, {"file.keep_mine", "file.merge_by_face"}};
        if (session.changed->level_file)
            notice.commands.insert(notice.commands.begin() + 1, "file.take_theirs");
        notices.push_back(std::move(notice));
    }
    if (const Status& stored = session.autosave.problem(); !stored)
        notices.push_back({"Autosave",
                           "Unsaved changes cannot be autosaved: " +
                               shown_text(parts, stored.error().text()) + ". Trying again; saving is safe",
                           {}});
    const Document* const document = parts.editor.document.get();
    const std::size_t differ = document ? document->second_reading().faces.size() : 0;
    if (differ > 0)
        notices.push_back({"Readings",
                           "The changed geometry fits two readings of the paint, which differ in " +
                               counted(differ, "face") + ". The likelier one is shown",
                           {"select.two_readings", "select.take_reading", "select.keep_reading"}});
    return notices;
}

float row_height() {
    return std::round(34.0f * ui::scale());
}

}  // namespace

float notices_height(const Parts& parts) {
    return static_cast<float>(notices_of(parts).size()) * row_height();
}

void notices(Parts& parts) {
    const ui::Scope scope("Notices");
    const ui::Palette& p = ui::palette();
    const float scale = ui::scale(), padding = 12 * scale;
    const ImVec2 at = ImGui::GetWindowPos();
    const float width = ImGui::GetWindowWidth();
    float y = 0.0f;
    for (const Notice& notice : notices_of(parts)) {
        float right = width - padding;
        for (auto id = notice.commands.rbegin(); id != notice.commands.rend(); ++id) {
            const Command& command = *find_command(*id);
            const float button = ImGui::CalcTextSize(command.label).x + 24 * scale;
            right -= button;
            ImGui::SetCursorPos({right, y + 4 * scale});
            if (ui::button(command.label, command.description, true, {button, 26 * scale}))
                run_command(parts.editor, *id);
            right -= 8 * scale;
        }
        const std::string text = printable(notice.text);
        const float text_y = at.y + y + (row_height() - ImGui::GetTextLineHeight()) * 0.5f;
        ui::ellipsis({at.x + padding, text_y}, at.x + right - padding, p.accent, "\uf071");
        ui::ellipsis({at.x + padding + 24 * scale, text_y}, at.x + right - padding, p.text, text);
        ImGui::SetCursorPos({padding, y});
        ImGui::InvisibleButton(notice.name, {std::max(1.0f, right - 2 * padding), row_height()});
        ui::record_last_item(notice.name);
        ui::tooltip(text.c_str());
        y += row_height();
    }
}

}  // namespace slipface
