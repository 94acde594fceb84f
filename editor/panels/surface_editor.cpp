#include "panels/surface_editor.h"

#include <algorithm>
#include <array>
#include <optional>

#include "panels/property_rows.h"
#include "slipface/base/text.h"
#include "tools/commands/icons.h"
#include "tools/selection/surface_types.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

const SurfaceType plain_type;

struct Target {
    Editor& editor;
    SurfaceId surface;
    const SurfaceType& type() const { return editor.document->level().surfaces[surface]; }
    void put(const SurfaceType& changed, const std::string& what) const {
        const std::string step_name = "Change " + what + " of " + type().name;
        live_edit(editor, step_name);
        change_surface_type(*editor.document, surface, changed, step_name);
    }
};

std::string field_tooltip(const SurfaceField& field) {
    std::string text = field.meaning;
    if (!std::holds_alternative<bool SurfaceType::*>(field.member))
        text += "\n\n" + range_text(field.minimum, field.maximum, field.unit);
    return text;
}

void name_row(const Target& target) {
    const bool fixed = target.surface == default_surface;
    std::string name = target.type().name;
    property_row("Name", nullptr);
    ImGui::BeginDisabled(fixed);
    if (ui::input_text("##Name", &name)) {
        live_edit(target.editor, "Rename " + target.type().name);
        target.editor.document->rename_surface(target.surface, name);
    }
    ImGui::EndDisabled();
    if (const std::string problem = target.editor.document->rename_problem(target.surface, name);
        !problem.empty())
        ui::muted_text(problem.c_str());
}

// Small squares to choose from.
std::optional<std::array<float, 3>> swatch_color(const std::array<float, 3>& now) {
    std::optional<std::array<float, 3>> chosen;
    const float side = 0.95f * ImGui::GetFontSize(), gap = 0.25f * ImGui::GetFontSize();
    const float end = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    const auto colors = safe_surface_colors();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t i = 0; i < colors.size(); ++i) {
        if (i > 0 && ImGui::GetItemRectMax().x + gap + side <= end) ImGui::SameLine(0, gap);
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::InvisibleButton("swatch", {side, side})) chosen = colors[i];
        ui::record_last_item("Swatch " + std::to_string(i + 1), true, colors[i] == now);
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        list.AddRectFilled(min, max, ui::packed({colors[i][0], colors[i][1], colors[i][2], 1.0f}),
                           0.2f * side);
        // Without a border white would be lost on a light panel and black on a dark one.
        list.AddRect(min, max, ui::packed(ui::palette().muted), 0.2f * side);
        if (ImGui::IsItemHovered() || colors[i] == now)
            list.AddRect({min.x - 1, min.y - 1}, {max.x + 1, max.y + 1}, ui::packed(ui::palette().text),
                         0.2f * side);
        ImGui::PopID();
    }
    return chosen;
}

void look_rows(const Target& target) {
    SurfaceType changed = target.type();
    property_row("Colour", "How the overlay draws faces of this type");
    ImGui::SetNextItemWidth(-1.0f);
    const bool recolored = ImGui::ColorEdit3("##Colour", changed.color.data(),
                                             ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoOptions);
    ui::record_last_item("Colour");
    if (recolored) target.put(changed, "colour");

    changed = target.type();
    property_row("Swatches", "Colours that colour-blind people can distinguish");
    if (const auto safe = swatch_color(changed.color)) {
        changed.color = *safe;
        target.put(changed, "colour");
    }

    changed = target.type();
    std::array<std::string, hatch_names.size()> hatches;
    std::array<const char*, hatch_names.size()> hatch_labels{};
    for (std::size_t i = 0; i < hatches.size(); ++i) {
        hatches[i] = sentence_case(hatch_names[i]);
        hatch_labels[i] = hatches[i].c_str();
    }
    int hatch = static_cast<int>(changed.hatch);
    property_row("Hatch", "Makes the type recognizable without colour");
    if (ui::combo("##Hatch", &hatch, hatch_labels.data(), static_cast<int>(hatch_labels.size()))) {
        changed.hatch = static_cast<Hatch>(hatch);
        target.put(changed, "hatch");
    }

    static constexpr std::array<const char*, 10> keys{"None", "1", "2", "3", "4", "5", "6", "7", "8", "9"};
    changed = target.type();
    int key = std::clamp(changed.hotkey, 0, 9);
    property_row("Key", "Digit key that makes this type the brush; it is removed from any other type");
    if (ui::combo("##Key", &key, keys.data(), static_cast<int>(keys.size()))) {
        changed.hotkey = key;
        target.put(changed, "key");
    }
}

void number_row(const Target& target, const SurfaceField& field, double SurfaceType::*member) {
    SurfaceType changed = target.type();
    const std::string what = to_lower(field.label);
    const std::string tooltip = field_tooltip(field);
    const bool modified = changed.*member != plain_type.*member;
    property_row(field.label, tooltip.c_str());
    if (number_slider(field.label, &(changed.*member), field.minimum, field.maximum, field.unit,
                      tooltip.c_str()))
        target.put(changed, what);
    if (reset_cell(field.label, modified)) {
        changed.*member = plain_type.*member;
        target.put(changed, what);
    }
}

void switch_row(const Target& target, const SurfaceField& field, bool SurfaceType::*member) {
    SurfaceType changed = target.type();
    const std::string tooltip = field_tooltip(field);
    property_row(field.label, tooltip.c_str());
    if (ui::checkbox((std::string("##") + field.label).c_str(), &(changed.*member), tooltip.c_str()))
        target.put(changed, to_lower(field.label));
}

void optional_row(const Target& target, const SurfaceField& field,
                  std::optional<double> SurfaceType::*member) {
    SurfaceType changed = target.type();
    const std::string what = to_lower(field.label);
    const std::string tooltip = field_tooltip(field);
    bool set = (changed.*member).has_value();
    property_row(field.label, tooltip.c_str());
    if (ui::checkbox((std::string("##Own ") + to_lower(field.label)).c_str(), &set, tooltip.c_str())) {
        // A new limit starts from the player's own.
        changed.*member = set ? std::optional(std::clamp(target.editor.document->level().movement.max_slope,
                                                         field.minimum, field.maximum))
                              : std::nullopt;
        target.put(changed, what);
    }
    if (!set || !(changed.*member)) return;
    ImGui::SameLine();
    double value = *(changed.*member);
    if (number_slider(field.label, &value, field.minimum, field.maximum, field.unit, tooltip.c_str())) {
        changed.*member = value;
        target.put(changed, what);
    }
}

// Three numbers need the panel's whole width.
void vector_lines(const Target& target, const SurfaceField& field, Vec3 SurfaceType::*member) {
    SurfaceType changed = target.type();
    const std::string tooltip = field_tooltip(field);
    ImGui::TextUnformatted(
        (std::string(field.label) + (*field.unit ? std::string(", ") + field.unit : "")).c_str());
    ui::tooltip(tooltip.c_str());
    if (!ui::drag_vec3((std::string("##") + field.label).c_str(), (changed.*member).data(), 0.05f, "%.4g",
                       tooltip.c_str()))
        return;
    changed.*member = (changed.*member).cwiseMax(field.minimum).cwiseMin(field.maximum);
    if ((changed.*member).allFinite()) target.put(changed, to_lower(field.label));
}

void fields(const Target& target) {
    float label_width = 0.0f;
    for (const SurfaceField& field : surface_fields())
        label_width = std::max(label_width, label_width_of(field.label));
    if (begin_property_rows("look", label_width_of("Swatches") + 0.4f * ImGui::GetFontSize())) {
        name_row(target);
        look_rows(target);
        end_property_rows();
    }
    if (begin_property_rows("type", label_width)) {
        for (const SurfaceField& field : surface_fields()) {
            ImGui::PushID(field.name);
            if (const auto* number = std::get_if<double SurfaceType::*>(&field.member))
                number_row(target, field, *number);
            else if (const auto* flag = std::get_if<bool SurfaceType::*>(&field.member))
                switch_row(target, field, *flag);
            else if (const auto* optional = std::get_if<std::optional<double> SurfaceType::*>(&field.member))
                optional_row(target, field, *optional);
            ImGui::PopID();
        }
        end_property_rows();
    }
    for (const SurfaceField& field : surface_fields())
        if (const auto* vector = std::get_if<Vec3 SurfaceType::*>(&field.member))
            vector_lines(target, field, *vector);
}

}  // namespace

void surface_editor(Editor& editor) {
    const Document& document = *editor.document;
    const bool full = document.level().surfaces.size() >= max_surface_types;
    ImGui::Spacing();
    if (ui::button(
            "Add type",
            full ? "The level has the maximum number of types" : "Add a surface type and paint with it",
            !full))
        add_surface_type(editor);
    if (!editor.brush || *editor.brush >= document.level().surfaces.size()) return;
    const std::string problem = document.removal_problem(*editor.brush);
    ui::flow(ui::button_width("Remove type"));
    const std::string tooltip =
        problem.empty() ? "Remove this type from the level" : "Cannot be removed: " + problem;
    if (ui::button("Remove type", tooltip.c_str(), problem.empty())) {
        remove_brush_type(editor);
        return;
    }
    if (!problem.empty() && *editor.brush != default_surface) ui::muted_text(("In use: " + problem).c_str());

    const Target target{editor, *editor.brush};
    ui::heading(target.type().name.c_str());
    ImGui::PushID(static_cast<int>(*editor.brush));
    fields(target);
    ImGui::PopID();
}

}  // namespace slipface
