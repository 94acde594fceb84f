#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <variant>

#include "slipface/base/markdown.h"
#include "slipface/base/text.h"
#include "slipface/movement/buttons.h"
#include "slipface/movement/settings.h"
#include "slipface/movement/surface_type.h"
#include "slipface/scenes/demo.h"
#include "tools/commands/docs.h"

namespace slipface {
namespace {

std::string shown_number(double value, std::string_view unit) {
    return to_text(unit == "deg" ? std::round(value * 180.0 / std::numbers::pi * 1e6) / 1e6 : value);
}

std::string with_unit(const std::string& number, std::string_view unit) {
    return unit.empty() ? number : number + " " + std::string(unit);
}

}  // namespace

std::string settings_markdown() {
    std::string text =
        "# Settings\n\n"
        "**What it is.** Every movement setting, button and parameter of surface types, from the "
        "tables that the program uses.\n\n"
        "**How you use it.** In the editor's movement panel, by `--set name=value`, in level files "
        "and tapes. Angles are shown in degrees here and in the editor; files and `--set` hold "
        "radians.\n\n"
        "**What it costs.** The last two columns say what goes wrong with too small and too large a "
        "value.\n\n"
        "## Movement\n";
    const MovementSettings defaults;
    std::string_view group;
    for (const SettingInfo& info : settings_table()) {
        if (group != info.group) {
            group = info.group;
            text += fmt::format("\n### {}\n\n", group);
            text +=
                markdown_row({"Setting", "Name", "Default", "Range", "Meaning", "Too small", "Too large"});
            text += markdown_row({"---", "---", "---", "---", "---", "---", "---"});
        }
        const bool number = !is_switch(info) && !is_choice(info);
        const std::string standard =
            number ? with_unit(shown_number(get_setting(defaults, info), info.unit), info.unit)
                   : setting_text(defaults, info);
        const std::string range =
            number ? shown_number(info.minimum, info.unit) + " to " + shown_number(info.maximum, info.unit)
                   : "";
        text += markdown_row({info.label, markdown_code(info.name), standard, range, meaning_of(info),
                              info.too_small, info.too_large});
    }
    text +=
        "\n## Formulas\n\nThe cards of the hacks show these with the numbers of a tick (the question mark "
        "beside a "
        "setting). `V` is the displacement or the velocity, `N` the normal of the face, `E` the position, "
        "`dt` the "
        "tick, `e` the restitution; `'` is after the step.\n\n";
    const auto add_formula = [&](const char* label, const FormulaInfo& info) {
        const std::string lecture =
            *info.lecture == '\0' ? "" : fmt::format(" (the lecture: {})", info.lecture);
        text += fmt::format("- {}{}: `{}`\n", label, lecture, info.text);
    };
    for (const DemoInfo& demo : demo_table())
        if (plays_lecture(demo)) add_formula(demo.title, demo.formula);
    for (const FormulaInfo& info : formula_table())
        add_formula(find_setting(info.hack)->label, info);
    text +=
        "\n## Buttons\n\nTapes, scripts and Python use the names; the keys, by their place on a US keyboard, "
        "and "
        "those of a gamepad hold them in a playtest. A tape keeps the names of others.\n\n" +
        markdown_row({"Button", "Name", "Key", "Gamepad", "Meaning"}) +
        markdown_row({"---", "---", "---", "---", "---"});
    for (const ButtonInfo& info : button_table())
        text += markdown_row({info.label, markdown_code(info.name), info.key, info.pad, info.meaning});
    text += "\n## Surface types\n\n" + markdown_row({"Parameter", "Name", "Unit", "Range", "Meaning"}) +
            markdown_row({"---", "---", "---", "---", "---"});
    for (const SurfaceField& field : surface_fields()) {
        const bool is_switch = std::holds_alternative<bool SurfaceType::*>(field.member);
        text += markdown_row({field.label, markdown_code(field.name), field.unit,
                              is_switch ? "on, off"
                                        : shown_number(field.minimum, field.unit) + " to " +
                                              shown_number(field.maximum, field.unit),
                              field.meaning});
    }
    return text;
}

}  // namespace slipface
