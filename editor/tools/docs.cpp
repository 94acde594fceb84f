#include "tools/docs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "slipface/base/text.h"
#include "tools/commands.h"

namespace slipface {
namespace {

// A '|' would end the table's cell, and two '*' outside of code would set what is between them in italics.
std::string cell(std::string_view text) {
    std::string escaped;
    bool code = false;
    for (const char c : text) {
        if (c == '`') code = !code;
        if (c == '|' || (c == '*' && !code)) escaped += '\\';
        escaped += c;
    }
    return escaped;
}

std::string row(std::initializer_list<std::string> cells) {
    std::string line = "|";
    for (const std::string& text : cells)
        line += fmt::format(" {} |", cell(text));
    return line + "\n";
}

std::string code(const char* name) {
    return fmt::format("`{}`", name);
}

std::string shown_number(double value, std::string_view unit) {
    return to_text(unit == "deg" ? std::round(value * 180.0 / std::numbers::pi * 1e6) / 1e6 : value);
}

std::string with_unit(const std::string& number, std::string_view unit) {
    return unit.empty() ? number : number + " " + std::string(unit);
}

}  // namespace

std::string commands_markdown() {
    std::string text =
        "# Commands\n\n"
        "Made from the command table. Menus, the toolbar, tooltips and scripts use the same rows; scripts "
        "name a command "
        "by its id.\n\n"
        "Shortcuts go by the letter on the key. W A S D Q E fly while the right mouse button is down.\n\n";
    std::vector<std::string_view> menus;
    for (const Command& command : commands())
        if (std::find(menus.begin(), menus.end(), command.menu) == menus.end()) menus.push_back(command.menu);
    std::stable_partition(menus.begin(), menus.end(), [](std::string_view menu) { return !menu.empty(); });
    for (const std::string_view menu : menus) {
        std::string title(menu.empty() ? "Without a menu entry" : menu);
        if (const std::size_t slash = title.find('/'); slash != std::string::npos)
            title.replace(slash, 1, ", ");
        text += fmt::format("## {}\n\n", title);
        text += row({"Command", "Shortcut", "Id", "What it does"}) + row({"---", "---", "---", "---"});
        for (const Command& command : commands())
            if (std::string_view(command.menu) == menu)
                text += row({command.label, command.shortcut.text(), code(command.id), command.description});
        text += "\n";
    }
    text.pop_back();
    return text;
}

std::string settings_markdown() {
    std::string text =
        "# Settings\n\n"
        "Made from the settings table. The editor's movement panel, `--set name=value`, level files and "
        "tapes use the same "
        "rows. Angles are shown in degrees here and in the editor; files and `--set` hold radians.\n\n"
        "## Movement\n";
    const MovementSettings defaults;
    std::string_view group;
    for (const SettingInfo& info : settings_table()) {
        if (group != info.group) {
            group = info.group;
            text += fmt::format("\n### {}\n\n", group);
            text += row({"Setting", "Name", "Default", "Range", "Meaning", "Too small", "Too large"});
            text += row({"---", "---", "---", "---", "---", "---", "---"});
        }
        const bool number =
            !std::holds_alternative<bool MovementSettings::*>(info.member) && choice_names(info).empty();
        const std::string standard =
            number ? with_unit(shown_number(get_setting(defaults, info), info.unit), info.unit)
                   : setting_text(defaults, info);
        const std::string range =
            number ? shown_number(info.minimum, info.unit) + " to " + shown_number(info.maximum, info.unit)
                   : "";
        text +=
            row({info.label, code(info.name), standard, range, info.meaning, info.too_small, info.too_large});
    }
    text += "\n## Surface types\n\n" + row({"Parameter", "Name", "Unit", "Range", "Meaning"}) +
            row({"---", "---", "---", "---", "---"});
    for (const SurfaceField& field : surface_fields()) {
        const bool is_switch = std::holds_alternative<bool SurfaceType::*>(field.member);
        text += row({field.label, code(field.name), field.unit,
                     is_switch ? "on, off"
                               : shown_number(field.minimum, field.unit) + " to " +
                                     shown_number(field.maximum, field.unit),
                     field.meaning});
    }
    return text;
}

}  // namespace slipface
