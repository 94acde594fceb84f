// Rules: types for materials by their names.
#include <fmt/format.h>

#include <algorithm>

#include "panels/legend.h"
#include "panels/panels.h"
#include "panels/property_rows.h"
#include "slipface/base/counted.h"
#include "tools/commands/icons.h"
#include "tools/selection/material_rules.h"
#include "tools/selection/selecting.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

std::string shown_name(const std::string& name) {
    return name.empty() ? "(no name)" : name;
}

// A line with the type's swatch, a name, and a number at the right end. True: pressed.
bool line(const std::string& id, const SurfaceType* type, const std::string& name, const std::string& detail,
          bool chosen, const std::string& tooltip) {
    const float em = ImGui::GetFontSize(), height = ImGui::GetFrameHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float right = at.x + ImGui::GetContentRegionAvail().x - 0.3f * em;
    const bool pressed = ImGui::Selectable(("##" + id).c_str(), chosen, 0, {0, height});
    ui::record_last_item(id, true, chosen);
    ui::tooltip(tooltip.c_str());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float side = height - 0.5f * em;
    const ImVec2 swatch{at.x + 0.2f * em, at.y + 0.25f * em}, end{swatch.x + 1.4f * side, swatch.y + side};
    if (type)
        draw_swatch(list, swatch, end, *type, 0.2f * em);
    else
        list.AddRect(swatch, end, ui::packed(ui::palette().muted), 0.2f * em);
    const float width = ImGui::CalcTextSize(detail.c_str()).x, y = at.y + 0.5f * (height - em);
    list.AddText({right - width, y}, ui::packed(ui::palette().muted), detail.c_str());
    ui::ellipsis({end.x + 0.5f * em, y}, right - width - 0.5f * em, ui::palette().text, name);
    return pressed;
}

const SurfaceType* type_named(const Level& level, const std::string& name) {
    const auto surface = find_surface(level, name);
    return surface ? &level.surfaces[*surface] : nullptr;
}

// Pattern, type, and what the rule does, below its line.
void open_rule(Editor& editor, std::size_t index) {
    const Level& level = editor.document->level();
    const MaterialRule rule = level.rules[index];
    const RuleReport& report = rule_report(*editor.document);
    const RuleEffect effect = report.rules[index];
    if (begin_property_rows("rule", label_width_of("Material"))) {
        const char* const help =
            "Name of a material; * stands for any text, ? for one character. Case, spaces and endings "
            "such as .001 make no difference";
        std::string pattern = rule.pattern;
        property_row("Pattern", help);
        ImGui::SetNextItemWidth(-1.0f);
        if (ui::input_text("##Pattern", &pattern, "stone*")) {
            live_edit(editor, "Change rule " + rule.pattern);
            change_rule(editor, index, {pattern, rule.type});
        }
        ui::tooltip(help);
        std::vector<std::string> names;
        for (const MaterialUse& use : report.materials)
            names.push_back(editor.document->mesh().materials[use.material].name);
        // The first row says what a pattern that is no material's name matches.
        const bool exact = std::find(names.begin(), names.end(), rule.pattern) != names.end();
        const std::string matched = fmt::format("({})", counted(effect.materials, "material"));
        std::vector<const char*> labels;
        if (!exact) labels.push_back(matched.c_str());
        int chosen = 0;
        for (const std::string& name : names) {
            if (name == rule.pattern) chosen = static_cast<int>(labels.size());
            labels.push_back(name.empty() ? "(no name)" : name.c_str());
        }
        property_row("Material", "Takes the name of one of the level's materials as the pattern");
        ImGui::SetNextItemWidth(-1.0f);
        if (ui::combo("##Material", &chosen, labels.data(), static_cast<int>(labels.size())) &&
            (exact || chosen > 0))
            change_rule(editor, index,
                        {names[static_cast<std::size_t>(chosen - (exact ? 0 : 1))], rule.type});
        std::vector<const char*> types;
        int type = -1;
        for (std::size_t i = 0; i < level.surfaces.size(); ++i) {
            if (level.surfaces[i].name == rule.type) type = static_cast<int>(i);
            types.push_back(level.surfaces[i].name.c_str());
        }
        property_row("Type", "What faces of these materials get");
        ImGui::SetNextItemWidth(-1.0f);
        if (ui::combo("##Type", &type, types.data(), static_cast<int>(types.size()))) {
            const std::string name = types[static_cast<std::size_t>(type)];
            change_rule(editor, index, {rule.pattern, name});
        }
        end_property_rows();
    }
    if (!effect.knows_type)
        ui::muted_text(fmt::format("The level has no type \"{}\": the rule does nothing", rule.type).c_str());
    ui::muted_text(fmt::format("Matches {}, {}; {} have their type from it",
                               counted(effect.materials, "material"), counted(effect.faces, "face"),
                               effect.deciding)
                       .c_str());
    if (ui::button("Up", "Rules below count before it", index > 0))
        return move_rule(editor, index, index - 1);
    ImGui::SameLine();
    if (ui::button("Down", "Counts before the rules above",
                   index + 1 < editor.document->level().rules.size()))
        return move_rule(editor, index, index + 1);
    ui::flow(ui::button_width("Select"));
    if (ui::button("Select", "Select the faces whose material matches", effect.faces > 0))
        apply_selection(editor, faces_of_rule(*editor.document, rule), SelectBy::replace, "Select by rule");
    ui::flow(ui::button_width("Remove"));
    if (ui::button("Remove", "Remove this rule")) remove_rule(editor, index);
    ImGui::Spacing();
}

void rule_rows(Editor& editor) {
    const RuleReport& report = rule_report(*editor.document);
    const auto draw = [&](std::size_t i) {
        const Level& level = editor.document->level();
        if (i >= level.rules.size()) return;  // removed in this frame
        const MaterialRule& rule = level.rules[i];
        ImGui::PushID(static_cast<int>(i));
        const ui::Scope scope(fmt::format("Rule {}", i + 1));
        const bool open = editor.rule == i;
        if (line("Row", type_named(level, rule.type), shown_name(rule.pattern),
                 std::to_string(report.rules[i].faces), open,
                 fmt::format("{} gives {} to {}", shown_name(rule.pattern), rule.type,
                             counted(report.rules[i].faces, "face"))))
            editor.rule = open ? std::nullopt : std::optional(i);
        if (open) open_rule(editor, i);
        ImGui::PopID();
    };
    const std::size_t count = editor.document->level().rules.size();
    if (count < 200 || editor.rule) {
        for (std::size_t i = 0; i < count; ++i)
            draw(i);
        return;
    }
    // Lines of equal height can be skipped while they are not visible.
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(count));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            draw(static_cast<std::size_t>(i));
}

void material_rows(Editor& editor) {
    const ui::Scope scope("Materials");
    ui::heading("Materials");
    const std::string type = editor.brush ? editor.document->level().surfaces[*editor.brush].name : "";
    const std::vector<MaterialUse> uses = rule_report(*editor.document).materials;
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(uses.size()));
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const MaterialUse& use = uses[static_cast<std::size_t>(i)];
            const Level& level = editor.document->level();
            const std::string& name = level.mesh->materials[use.material].name;
            const std::string from = use.suffix ? "by its suffix"
                                     : use.rule ? fmt::format("by rule {}", *use.rule + 1)
                                                : "by no rule";
            ImGui::PushID(i);
            if (line(shown_name(name), &level.surfaces[use.type], shown_name(name), std::to_string(use.faces),
                     use.rule && use.rule == editor.rule,
                     fmt::format("{}: {}, {}\n{}", shown_name(name), level.surfaces[use.type].name, from,
                                 use.rule       ? "Click to see the rule"
                                 : use.suffix   ? "No rule can change it"
                                 : type.empty() ? "Choose a type as the brush to add a rule"
                                                : "Click to add a rule: " + type))) {
                if (use.rule)
                    editor.rule = use.rule;
                else if (!use.suffix && !type.empty())
                    add_rule(editor, {name, type});
            }
            ImGui::PopID();
        }
    }
}

}  // namespace

void rules_panel(Editor& editor) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Rules");
    if (editor.rule && *editor.rule >= editor.document->level().rules.size()) editor.rule.reset();
    const bool brush = editor.brush.has_value();
    if (ui::button("Add rule",
                   brush ? "Add a rule that gives the brush's type to materials" : "The brush is unset",
                   brush))
        add_rule(editor, {"new material", editor.document->level().surfaces[*editor.brush].name});
    if (editor.document->level().rules.empty())
        ui::muted_text("None: a rule gives a type to the materials whose names match its pattern");
    else
        ui::muted_text("The last rule that matches counts; a suffix and paint come before it");
    ImGui::Spacing();
    rule_rows(editor);
    material_rows(editor);
}

}  // namespace slipface
