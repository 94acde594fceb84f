// Help on top of the window: the first tour, attached to real widgets, and the keys that work now.
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "app/parts.h"
#include "panels/viewport_panel.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

struct Step {
    const char* anchor;  // path of a widget; "" or missing: the card is in the middle
    const char* title;
    const char* text;
    const char* command;                          // whose key is shown; "": none
    std::optional<PanelId> panel = std::nullopt;  // that has to be open
};
constexpr std::array<Step, 8> steps{{
    {"", "Welcome to Slipface",
     "Paint surface types, walk the level, and see why the player moved as it did. This takes a minute; Esc "
     "ends it, and Help > Tour brings it back.",
     ""},
    {"Toolbar/Paint", "Paint",
     "Drag over faces in the view to give them the brush's type. Fill, beside it, paints a whole connected "
     "patch.",
     "tools.paint"},
    {"Palette/ice", "Surface types",
     "Ice, ladders, sticky walls: click one to take it as the brush, or press its number. Every parameter "
     "can be "
     "changed, and you can add your own.",
     "brush.2", PanelId::palette},
    {"Tabs/Movement", "Movement",
     "Every movement hack has a switch here. Switch one off while you walk and feel the difference.", "",
     PanelId::movement},
    {"Toolbar/Probe", "Probe",
     "Place the player's ellipsoid and drag it through the geometry. Each contact and its response are drawn "
     "and listed.",
     "tools.probe"},
    {"Toolbar/Play", "Play", "Walk and jump the level from the spawn point. Esc comes back to editing.",
     "playtest.start"},
    {"Tabs/Why", "Why",
     "Every walk is recorded. Afterwards this panel says what stopped the player, by which rule, and what "
     "would "
     "have helped; the timeline goes to any tick.",
     "panel.why", PanelId::why},
    {"Menu/Help", "Everything else",
     "All commands and their keys are in the menus. Help shows what you can do right now.", "help.overlay"},
}};

constexpr ImGuiWindowFlags card_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize;

struct Hole {
    ImVec2 min, max;
};

// Dims the window except `hole`. Takes the mouse, so that nothing below is clicked by accident.
void shade(const std::optional<Hole>& hole) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(screen);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::Begin("##shade", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleVar();
    ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRectFullScreen();
    const ImU32 dark = ui::packed(ui::palette().shade);
    if (!hole) {
        list.AddRectFilled({0, 0}, screen, dark);
    } else {
        list.AddRectFilled({0, 0}, {screen.x, hole->min.y}, dark);
        list.AddRectFilled({0, hole->max.y}, screen, dark);
        list.AddRectFilled({0, hole->min.y}, {hole->min.x, hole->max.y}, dark);
        list.AddRectFilled({hole->max.x, hole->min.y}, {screen.x, hole->max.y}, dark);
        const float line = std::max(1.0f, 2.0f * ui::scale());
        list.AddRect(hole->min, hole->max, ui::packed(ui::palette().accent), 5 * ui::scale(), 0, line);
    }
    list.PopClipRect();
    ui::end(ImGui::End);
}

void push_card_style() {
    const float scale = ui::scale();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {20 * scale, 16 * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 9 * scale);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, std::max(1.0f, scale));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ui::palette().popup);
}
void pop_card_style() {
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
}

// A key as a key cap.
void key_cap(const std::string& text) {
    const float scale = ui::scale();
    const ui::Font& font = ui::fonts().small;
    const ImVec2 size = ui::text_size(font, text.c_str());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetTextLineHeight() + 2 * scale, width = size.x + 12 * scale;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + width, at.y + height}, ui::packed(ui::palette().raised), 4 * scale);
    list.AddRect(at, {at.x + width, at.y + height}, ui::packed(ui::palette().hairline), 4 * scale);
    list.AddText(font.face, font.pixels, {at.x + 6 * scale, at.y + (height - size.y) * 0.5f},
                 ui::packed(ui::palette().text), text.c_str());
    ImGui::Dummy({width, height});
}

void go_to_step(Editor& editor, int step) {
    if (step < static_cast<int>(steps.size())) {
        editor.session.tour = std::max(0, step);
        const std::optional<PanelId> panel = steps[static_cast<std::size_t>(editor.session.tour)].panel;
        if (panel && !editor.layout.visible(*panel)) editor.layout.show(*panel);
        return;
    }
    editor.session.tour = -1;
    editor.session.preferences.set("tour.done", true);
}

void step_buttons(Editor& editor, int step, float width) {
    const float scale = ui::scale();
    const float button = 84 * scale;
    const bool last = step + 1 == static_cast<int>(steps.size());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int i = 0; i < static_cast<int>(steps.size()); ++i)
        list.AddCircleFilled(
            {at.x + (4 + 13 * static_cast<float>(i)) * scale, at.y + ImGui::GetFrameHeight() * 0.5f},
            3.5f * scale, ui::packed(i == step ? ui::palette().accent : ui::palette().pressed), 16);
    const float x = ImGui::GetCursorPosX() + width - 2 * button - ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetCursorPosX(x);
    if (step == 0) {
        if (ui::button("Skip", nullptr, true, {button, 0}))
            go_to_step(editor, static_cast<int>(steps.size()));
    } else if (ui::button("Back", nullptr, true, {button, 0})) {
        go_to_step(editor, step - 1);
    }
    ImGui::SameLine();
    if (ui::primary_button(last ? "Done" : "Next", true, {button, 0})) go_to_step(editor, step + 1);
}

// Next to the hole where there is room: below, else at the right, else at the left.
ImVec2 card_position(const std::optional<Hole>& hole, ImVec2 size) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float gap = 14 * ui::scale();
    ImVec2 at{(screen.x - size.x) * 0.5f, (screen.y - size.y) * 0.42f};
    if (hole) {
        at = {hole->min.x, hole->max.y + gap};
        if (at.y + size.y > screen.y) at = {hole->max.x + gap, hole->min.y};
        if (at.x + size.x > screen.x) at.x = hole->max.x - size.x;
    }
    return {std::round(std::clamp(at.x, gap, std::max(gap, screen.x - size.x - gap))),
            std::round(std::clamp(at.y, gap, std::max(gap, screen.y - size.y - gap)))};
}

void tour(Editor& editor) {
    const int number = std::min(editor.session.tour, static_cast<int>(steps.size()) - 1);
    const Step& step = steps[static_cast<std::size_t>(number)];
    const float scale = ui::scale();
    std::optional<Hole> hole;
    const auto& widgets = ui::widgets();
    if (const auto found = widgets.find(std::string_view(step.anchor));
        found != widgets.end() && found->second.visible) {
        const float air = 5 * scale;
        hole = Hole{{found->second.min.x - air, found->second.min.y - air},
                    {found->second.max.x + air, found->second.max.y + air}};
    }
    shade(hole);
    const float width = 340 * scale;
    const ImGuiWindow* const before = ImGui::FindWindowByName("##tour");
    const ImVec2 size = before ? before->Size : ImVec2{width + 40 * scale, 180 * scale};
    push_card_style();
    ImGui::SetNextWindowPos(card_position(hole, size));
    ImGui::Begin("##tour", nullptr, card_flags);
    pop_card_style();
    ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
    const ui::Scope scope("Tour");
    ui::push_font(ui::fonts().semibold);
    ImGui::TextUnformatted(step.title);
    ui::record_last_item(step.title);
    ImGui::PopFont();
    if (const Command* const command = find_command(step.command))
        if (const std::string key = shortcut_text(editor, *command); !key.empty()) {
            ImGui::SameLine(0, 10 * scale);
            key_cap(key);
        }
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    ImGui::TextColored(ui::palette().muted, "%s", step.text);
    ImGui::PopTextWrapPos();
    ImGui::Dummy({width, 6 * scale});
    step_buttons(editor, number, width);
    ui::end(ImGui::End);
}

struct Hint {
    std::string keys, what;
};

// "Click: paint ice · Drag: keep painting" as rows.
std::vector<Hint> hints_of(const std::string& text) {
    std::vector<Hint> hints;
    static constexpr std::string_view separator = " \u00b7 ";
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(separator, at), text.size());
        const std::string part = text.substr(at, end - at);
        const std::size_t colon = part.find(": ");
        if (colon != std::string::npos) {
            std::string what = part.substr(colon + 2);
            if (!what.empty() && what[0] >= 'a' && what[0] <= 'z')
                what[0] = static_cast<char>(what[0] - 'a' + 'A');
            hints.push_back({part.substr(0, colon), std::move(what)});
        }
        at = end + separator.size();
    }
    return hints;
}

void hint_rows(const char* title, const std::vector<Hint>& hints) {
    const float scale = ui::scale();
    ui::heading(title);
    for (const Hint& hint : hints) {
        const float x = ImGui::GetCursorPosX();
        key_cap(hint.keys);
        ImGui::SameLine();
        ImGui::SetCursorPosX(x + 128 * scale);
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted(hint.what.c_str());
        ui::record_last_item(hint.what);
        ImGui::PopTextWrapPos();
    }
}

std::vector<Hint> commands_of(const Editor& editor, std::string_view menu, std::size_t maximum) {
    std::vector<Hint> hints;
    for (const Command& command : commands()) {
        const std::string_view its = command.menu;
        if (its.substr(0, its.find('/')) != menu || hints.size() == maximum || !command.enabled(editor))
            continue;
        if (const std::string key = shortcut_text(editor, command); !key.empty())
            hints.push_back({key, command_name(editor, command)});
    }
    return hints;
}

void help_overlay(Editor& editor) {
    const float scale = ui::scale();
    shade(std::nullopt);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    push_card_style();
    ImGui::SetNextWindowSizeConstraints({0, 0}, {screen.x * 0.96f, screen.y * 0.94f});
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("##help", nullptr, card_flags & ~ImGuiWindowFlags_NoScrollbar);
    pop_card_style();
    ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
    const ui::Scope scope("Help");
    ui::push_font(ui::fonts().semibold);
    ImGui::TextUnformatted(editor.playtest ? "While you walk" : "What you can do here");
    ImGui::PopFont();
    // As many columns as fit into the window; the rest is below and scrolls.
    const float column = 300 * scale;
    const int columns =
        std::clamp(static_cast<int>((screen.x * 0.96f - 70 * scale) / (column + 8 * scale)), 1, 3);
    if (ImGui::BeginTable("columns", columns, ImGuiTableFlags_SizingFixedFit)) {
        for (int i = 0; i < columns; ++i)
            ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, column);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const std::vector<Hint> now = hints_of(viewport_hint(editor));
        if (!now.empty()) hint_rows("Mouse", now);
        hint_rows("Camera",
                  {{"Wheel", "Zoom to the point"}, {"Shift+MMB", "Pan"}, {"RMB+Wheel", "Speed of flying"}});
        hint_rows("Playtest", commands_of(editor, "Playtest", 4));
        std::vector<Hint> why = commands_of(editor, "Lab", 4);
        if (const Command* const panel = find_command("panel.why"))
            why.insert(why.begin(), {shortcut_text(editor, *panel), "What stopped the player, and why"});
        hint_rows("After a walk", why);
        ImGui::TableNextColumn();
        hint_rows("Tools", commands_of(editor, "Tools", 10));
        hint_rows("Select", commands_of(editor, "Select", 8));
        ImGui::TableNextColumn();
        hint_rows("View", commands_of(editor, "View", 10));
        hint_rows("Edit and file", [&] {
            std::vector<Hint> both = commands_of(editor, "Edit", 4);
            for (Hint& hint : commands_of(editor, "File", 4))
                both.push_back(std::move(hint));
            return both;
        }());
        ImGui::EndTable();
    }
    ImGui::Dummy({0, 4 * scale});
    const float width = 90 * scale;
    const Command* const all = find_command("help.shortcuts");
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(ui::palette().muted, "%s lists and changes every key",
                       all ? shortcut_text(editor, *all).c_str() : "");
    ImGui::SameLine();
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, ImGui::GetContentRegionAvail().x - width));
    if (ui::primary_button("Close", true, {width, 0})) editor.session.help = false;
    ui::end(ImGui::End);
}

bool tour_is_shown(const Editor& editor) {
    return editor.session.tour >= 0 && editor.document && !dialog_is_open(editor) && !editor.playtest;
}

}  // namespace

void guide(Parts& parts) {
    if (dialog_is_open(parts.editor)) return;
    if (parts.editor.session.help)
        help_overlay(parts.editor);
    else if (tour_is_shown(parts.editor))
        tour(parts.editor);
}

bool guide_key(Editor& editor, const Shortcut& key) {
    if (key.ctrl || key.alt || key.shift || dialog_is_open(editor)) return false;
    if (editor.session.help) {
        if (key.key == "Escape" || key.key == "Enter") {
            editor.session.help = false;
            return true;
        }
        return false;
    }
    if (!tour_is_shown(editor)) return false;
    if (key.key == "Escape")
        go_to_step(editor, static_cast<int>(steps.size()));
    else if (key.key == "Enter" || key.key == "Right" || key.key == "Space")
        go_to_step(editor, editor.session.tour + 1);
    else if (key.key == "Left" || key.key == "Backspace")
        go_to_step(editor, editor.session.tour - 1);
    return true;
}

}  // namespace slipface
