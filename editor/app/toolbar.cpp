// The most used commands as icons, and the options of the current tool.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

#include "app/parts.h"
#include "panels/legend.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

// Ids of the table; "" separates groups.
constexpr const char* shown_commands[] = {
    "file.open",
    "file.save",
    "",
    "edit.undo",
    "edit.redo",
    "",
    "tools.select",
    "tools.paint",
    "tools.fill",
    "tools.probe",
    "",
    "view.textured",
    "view.overlay",
    "view.walkable",
    "view.wireframe",
    "view.frame_selected",
    "help.command_palette",
};

constexpr const char* select_options[] = {"select.box", "select.lasso", "select.brush", "select.through",
                                          "select.whole"};

std::string tooltip_text(const Editor& editor, const Command& command) {
    std::string text = command_name(editor, command);
    if (const std::string shortcut = shortcut_text(editor, command); !shortcut.empty())
        text += "  (" + shortcut + ")";
    return text + "\n" + command.description;
}

void group_line() {
    const float scale = ui::scale();
    ImGui::SameLine(0, 10 * scale);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight() + 4 * scale;
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 5 * scale},
                                              {at.x + scale, at.y + height - 5 * scale},
                                              ui::packed(ui::palette().hairline));
    ImGui::Dummy({scale, height});
    ImGui::SameLine(0, 10 * scale);
}

void command_button(Editor& editor, const Command& command) {
    const bool active = command.checked && command.checked(editor);
    if (ui::icon_button(command.icon, command.label, tooltip_text(editor, command).c_str(), active,
                        command.enabled(editor)))
        run_command(editor, command.id);
}

constexpr float play_width = 92, slider_width = 120, name_width = 130, window_padding = 10;  // design pixels
constexpr float line_height = 46;

// The width of all icons, their groups and the play button.
float icons_width() {
    const auto groups = std::count(std::begin(shown_commands), std::end(shown_commands), std::string_view());
    const auto icons = static_cast<float>(std::size(shown_commands)) - static_cast<float>(groups);
    return icons * (ui::icon_button_side() + 3 * ui::scale()) +
           (21 * static_cast<float>(groups) + play_width + 3 * window_padding) * ui::scale();
}

// The width of the widest tool's options.
float options_width() {
    const float icons =
        static_cast<float>(std::size(select_options)) * (ui::icon_button_side() + 3 * ui::scale());
    return icons + ImGui::CalcTextSize("Brush").x + (21 + 12 + 8 + slider_width) * ui::scale();
}

bool has_two_lines(const Editor& editor, float width) {
    return editor.document && !editor.playtest && width < icons_width() + options_width();
}

// The options of the current tool.
void tool_options(Editor& editor, bool own_line) {
    const float scale = ui::scale();
    if (!editor.document || editor.playtest || editor.tool == Tool::probe || editor.tool == Tool::props)
        return;
    if (own_line)
        ImGui::SetCursorPos({window_padding * scale, (5 + line_height - 6) * scale});
    else
        group_line();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 2 * scale);
    const ui::Scope scope("Options");
    const auto brush = [&] {
        const auto& surfaces = editor.document->level().surfaces;
        const bool unset = !editor.brush || *editor.brush >= surfaces.size();
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float side = 16 * scale, drop = (ImGui::GetFrameHeight() - side) * 0.5f;
        if (!unset)
            draw_swatch(*ImGui::GetWindowDrawList(), {at.x, at.y + drop}, {at.x + side, at.y + drop + side},
                        surfaces[*editor.brush], 3 * scale);
        ImGui::Dummy({unset ? 0 : side, side});
        ImGui::SameLine(0, 8 * scale);
        const std::string name = unset ? "unset" : surfaces[*editor.brush].name;
        const ImVec2 text = ImGui::GetCursorScreenPos();
        const float width = std::min(ImGui::CalcTextSize(name.c_str()).x, name_width * scale);
        ui::ellipsis({text.x, text.y + ImGui::GetStyle().FramePadding.y}, text.x + width, ui::palette().text,
                     name);
        ImGui::Dummy({width, ImGui::GetFrameHeight()});
        ImGui::SameLine(0, 18 * scale);
    };
    const auto number = [&](const char* label, double* value, double maximum, const char* format,
                            const char* tip) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(ui::palette().muted, "%s", label);
        ImGui::SameLine();
        ImGui::SetNextItemWidth(slider_width * scale);
        ui::number_slider((std::string("##") + label).c_str(), value, 0.0, maximum, format);
        ui::record_last_item(label);
        ui::tooltip(tip);
    };
    if (editor.tool == Tool::select) {
        ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 2 * scale);
        for (const char* id : select_options) {
            command_button(editor, *find_command(id));
            ImGui::SameLine();
        }
        if (editor.select_shape != SelectShape::brush) return;
        ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 2 * scale);
        ImGui::SameLine(0, 12 * scale);
        number("Brush", &editor.select_radius, 10.0, editor.select_radius > 0.0 ? "%.2f m" : "one face",
               "Radius of the selecting brush");
    } else if (editor.tool == Tool::paint) {
        brush();
        number("Brush", &editor.brush_radius, 10.0, editor.brush_radius > 0.0 ? "%.2f m" : "one face",
               "Brush radius in the level; at the left end only the face under the mouse");
    } else if (editor.tool == Tool::fill) {
        brush();
        double degrees = editor.fill_angle * 57.29577951308232;
        number("Angle", &degrees, 180.0, "%.0f\u00b0", "Fill crosses edges that bend less than this");
        editor.fill_angle = degrees / 57.29577951308232;
    }
}

void play_button(Editor& editor) {
    const float scale = ui::scale();
    const bool walking = editor.playtest.has_value();
    const Command* const command = find_command(walking ? "playtest.stop" : "playtest.start");
    if (!command) return;
    const char* const label = walking ? "\uf04d  Stop###Play" : "\uf04b  Play###Play";
    const float width = play_width * scale;
    ImGui::SetCursorPosX(
        std::max(ImGui::GetCursorPosX(), ImGui::GetWindowWidth() - width - window_padding * scale));
    ImGui::SetCursorPosY(5 * scale);
    const ImVec2 size{width, ImGui::GetFrameHeight() + 4 * scale};
    const bool enabled = command->enabled(editor);
    ui::push_font(ui::fonts().semibold);
    const bool pressed =
        walking ? ui::button(label, nullptr, enabled, size) : ui::primary_button(label, enabled, size);
    ImGui::PopFont();
    ui::tooltip(tooltip_text(editor, *command).c_str());
    if (pressed) run_command(editor, command->id);
}

}  // namespace

float toolbar_height_in(const Editor& editor, float width) {
    return std::round((has_two_lines(editor, width) ? 2 * line_height - 6 : line_height) * ui::scale());
}

void toolbar(Parts& parts) {
    const ui::Scope scope("Toolbar");
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {3 * ui::scale(), 4 * ui::scale()});
    for (const std::string_view id : shown_commands) {
        if (id.empty()) {
            group_line();
            continue;
        }
        const Command* const command = find_command(id);
        if (!command) continue;
        command_button(parts.editor, *command);
        ImGui::SameLine();
    }
    const bool two_lines = has_two_lines(parts.editor, ImGui::GetWindowWidth());
    if (!two_lines) tool_options(parts.editor, false);
    ImGui::SameLine();
    play_button(parts.editor);
    if (two_lines) tool_options(parts.editor, true);
    ImGui::PopStyleVar();
}

}  // namespace slipface
