// Every hack and parameter of movement, made from the settings table.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "panels/hack_card.h"
#include "panels/panels.h"
#include "panels/property_rows.h"
#include "slipface/base/text.h"
#include "slipface/level/preset.h"
#include "tools/commands/icons.h"
#include "tools/lab/lab_actions.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

bool is_whole(const SettingInfo& info) {
    return std::holds_alternative<int MovementSettings::*>(info.member);
}

// The settings that the panel compares with: those of the nearest preset.
const MovementSettings& standard_settings(const Editor& editor) {
    return nearest_preset(editor.document->level().movement).preset->preset.settings;
}

std::string value_text(const MovementSettings& settings, const SettingInfo& info) {
    return is_switch(info) || is_choice(info) ? setting_text(settings, info)
                                              : number_text(get_setting(settings, info), info.unit);
}

std::string setting_tooltip(const SettingInfo& info) {
    const MovementSettings defaults;
    std::string text = meaning_of(info);
    text += "\n\n";
    if (is_switch(info) || is_choice(info))
        text += "Default: " + setting_text(defaults, info);
    else
        text += range_text(info.minimum, info.maximum, info.unit) + ", default " +
                number_text(get_setting(defaults, info), info.unit);
    if (*info.too_small) text += std::string("\nToo small: ") + info.too_small;
    if (*info.too_large) text += std::string("\nToo large: ") + info.too_large;
    return text;
}

void put(Editor& editor, const SettingInfo& info, double value) {
    MovementSettings movement = editor.document->level().movement;
    if (set_setting(movement, info, value))
        editor.document->set_movement(movement, "Change " + to_lower(info.label));
}

std::string words_of(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

void choice_control(Editor& editor, const SettingInfo& info, double value, const std::string& tooltip) {
    std::vector<std::string> texts;
    for (const auto& [name, meaning] : choices_of(info))
        texts.push_back(sentence_case(words_of(name)));
    std::vector<const char*> names;
    for (const std::string& text : texts)
        names.push_back(text.c_str());
    int index = static_cast<int>(value);
    const std::string id = std::string("##") + info.label;
    if (ui::combo(id.c_str(), &index, names.data(), static_cast<int>(names.size()), tooltip.c_str()))
        put(editor, info, static_cast<double>(index));
}

// A choice takes the whole width, so that its words are never cut: beside its label if both fit, else below.
void choice_row(Editor& editor, const SettingInfo& info) {
    const double value = get_setting(editor.document->level().movement, info);
    const double standard = get_setting(standard_settings(editor), info);
    const float em = ImGui::GetFontSize(), indent = *info.switch_name ? 1.2f * em : 0.0f;
    const std::string tooltip = setting_tooltip(info);
    float words = 0.0f;
    for (const auto& [name, meaning] : choices_of(info))
        words = std::max(words, ImGui::CalcTextSize(words_of(name).c_str()).x);
    const float box = words + 2.5f * ImGui::GetStyle().FramePadding.x + ImGui::GetFrameHeight();
    ImGui::PushID(info.name);
    if (begin_property_rows("choice", ImGui::GetContentRegionAvail().x, 3.2f)) {
        property_row("", nullptr, value != standard);
        ImGui::TableSetColumnIndex(1);
        const float x = ImGui::GetCursorPosX() + indent, room = ImGui::GetContentRegionAvail().x - indent;
        ImGui::SetCursorPosX(x);
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(info.label);
        ui::tooltip(tooltip.c_str());
        if (label_width_of(info.label) + 0.6f * em + box <= room)
            ImGui::SameLine(0, 0.6f * em);
        else
            ImGui::SetCursorPosX(x);
        ImGui::SetNextItemWidth(-1.0f);
        choice_control(editor, info, value, tooltip);
        ImGui::TableSetColumnIndex(2);
        if (reset_cell(info.label, value != standard)) put(editor, info, standard);
        end_property_rows();
    }
    ImGui::PopID();
}

void setting_row(Editor& editor, const SettingInfo& info) {
    const MovementSettings& movement = editor.document->level().movement;
    double value = get_setting(movement, info);
    const double standard = get_setting(standard_settings(editor), info);
    const bool modified = value != standard;
    const std::string tooltip = setting_tooltip(info);
    const float indent = *info.switch_name ? 1.2f * ImGui::GetFontSize() : 0.0f;
    ImGui::PushID(info.name);
    property_row(info.label, tooltip.c_str(), modified, indent);
    if (number_slider(info.label, &value, info.minimum, info.maximum, info.unit, tooltip.c_str(),
                      is_whole(info))) {
        live_edit(editor, "Change " + to_lower(info.label));
        put(editor, info, value);
    }
    if (reset_cell(info.label, modified)) put(editor, info, standard);
    ImGui::PopID();
}

// A switch takes the whole width, so that its name is never cut.
void switch_row(Editor& editor, FrameContext& frame, const SettingInfo& info) {
    const MovementSettings& movement = editor.document->level().movement;
    const double standard = get_setting(standard_settings(editor), info);
    bool on = get_setting(movement, info) != 0.0;
    const bool modified = (on ? 1.0 : 0.0) != standard;
    const std::string tooltip = setting_tooltip(info);
    ImGui::PushID(info.name);
    if (begin_property_rows("switch", ImGui::GetContentRegionAvail().x)) {
        property_row("", nullptr, modified);
        ImGui::TableSetColumnIndex(1);
        if (ui::checkbox(info.label, &on, tooltip.c_str()))
            run_command(editor, std::string("movement.") + info.name);
        ImGui::TableSetColumnIndex(2);
        hack_cell(editor, frame, info);
        if (reset_cell(info.label, modified)) put(editor, info, standard);
        end_property_rows();
    }
    ImGui::PopID();
}

// The shipped presets, which of them is active, and presets in files.
void preset_row(Editor& editor) {
    const std::vector<ShippedPreset>& presets = shipped_presets();
    const MovementSettings& movement = editor.document->level().movement;
    std::vector<const char*> names;
    int current = static_cast<int>(presets.size());
    for (std::size_t i = 0; i < presets.size(); ++i) {
        names.push_back(presets[i].preset.name.c_str());
        if (presets[i].preset.settings == movement) current = static_cast<int>(i);
    }
    const int own = static_cast<int>(presets.size());
    const std::string changed = nearest_preset(movement).preset->preset.name + ", changed";
    names.insert(names.end(), {current < own ? "Own settings" : changed.c_str(), "Open preset\u2026",
                               "Save preset\u2026"});
    const char* const about = current < own ? presets[static_cast<std::size_t>(current)].preset.about.c_str()
                                            : "Change all settings at once, as one step of history";
    int chosen = current;
    ImGui::SetNextItemWidth(-1.0f);
    if (!ui::combo("##Preset", &chosen, names.data(), static_cast<int>(names.size()), about)) return;
    if (chosen < own)
        use_preset(editor, presets[static_cast<std::size_t>(chosen)].preset);
    else if (chosen > own)
        run_command(editor, chosen == own + 1 ? "movement.open_preset" : "movement.save_preset");
}

// "Step height 0.4 -> 0.5" for each setting that differs from the preset; a click resets it.
void changed_rows(Editor& editor, const PresetMatch& match) {
    constexpr std::size_t maximum = 6;
    const MovementSettings movement = editor.document->level().movement;
    const MovementSettings& preset = match.preset->preset.settings;
    const ui::Scope scope("Changed");
    for (std::size_t i = 0; i < std::min(maximum, match.changed.size()); ++i) {
        const SettingInfo& info = *match.changed[i];
        const std::string from = value_text(preset, info);
        const std::string text =
            std::string(info.label) + " " + from + " \u2192 " + value_text(movement, info);
        ImGui::PushID(info.name);
        ImGui::PushStyleColor(ImGuiCol_Text, ui::palette().muted);
        const bool taken_back = ImGui::Selectable(text.c_str());
        ImGui::PopStyleColor();
        ui::record_last_item(info.label);
        ui::tooltip(("Reset it to " + from).c_str());
        ImGui::PopID();
        if (taken_back) put(editor, info, get_setting(preset, info));
    }
    if (match.changed.size() > maximum)
        ui::muted_text(("and " + std::to_string(match.changed.size() - maximum) + " more").c_str());
}

// The nearest preset, and what differs.
void header(Editor& editor) {
    const PresetMatch match = nearest_preset(editor.document->level().movement);
    const std::size_t changed = match.changed.size();
    const std::string line =
        match.preset->preset.name +
        (changed == 0 ? ", nothing changed" : ", " + std::to_string(changed) + " changed");
    const bool resets = !(editor.document->level().movement == MovementSettings{});
    const float width = ImGui::CalcTextSize("Reset all").x + 2.0f * ImGui::GetStyle().FramePadding.x;
    const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ui::ellipsis({at.x, at.y + ImGui::GetStyle().FramePadding.y},
                 at.x + ImGui::GetContentRegionAvail().x - width - ImGui::GetStyle().ItemSpacing.x,
                 ui::palette().muted, line);
    ImGui::SetCursorPosX(right - width);
    if (ui::button("Reset all", "Set every hack and parameter to its default, the preset Platformer", resets))
        run_command(editor, "movement.reset");
    changed_rows(editor, match);
}

bool has_words(const SettingInfo& info, const std::string& search) {
    const std::string text =
        to_lower(std::string(info.label) + " " + info.name + " " + info.group + " " + meaning_of(info));
    const std::string wanted = to_lower(search);
    for (const std::string_view word : split(wanted, ' '))
        if (text.find(word) == std::string::npos) return false;
    return true;
}

// A switch is also found by what it switches, which shows only while it is on.
bool is_found(const SettingInfo& info, const std::string& search) {
    if (search.empty()) return true;
    const auto& all = settings_table();
    return has_words(info, search) || std::any_of(all.begin(), all.end(), [&](const SettingInfo& other) {
               return is_switch(info) && std::string_view(other.switch_name) == info.name &&
                      has_words(other, search);
           });
}

void group_rows(Editor& editor, FrameContext& frame, std::string_view group, float label_width) {
    const MovementSettings& movement = editor.document->level().movement;
    bool open = false;
    const auto close = [&] {
        if (std::exchange(open, false)) end_property_rows();
    };
    int tables = 0;
    for (const SettingInfo& info : settings_table()) {
        if (group != info.group || !is_found(info, editor.movement_search)) continue;
        const SettingInfo* owner = find_setting(info.switch_name);
        if (owner && get_setting(movement, *owner) == 0.0) continue;
        if (is_switch(info) || is_choice(info)) {
            close();
            is_switch(info) ? switch_row(editor, frame, info) : choice_row(editor, info);
            continue;
        }
        if (!open)
            open = begin_property_rows((std::string(group) + std::to_string(tables++)).c_str(), label_width);
        if (open) setting_row(editor, info);
    }
    close();
}

}  // namespace

void movement_panel(Editor& editor, FrameContext& frame) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Movement");
    preset_row(editor);
    header(editor);
    ui::search_box("##Search", &editor.movement_search, "Find a setting");
    float label_width = 0.0f;
    for (const SettingInfo& info : settings_table())
        if (!is_switch(info))
            label_width = std::max(label_width, label_width_of(info.label) +
                                                    (*info.switch_name ? 1.2f * ImGui::GetFontSize() : 0.0f));
    std::string_view group;
    for (const SettingInfo& info : settings_table()) {
        if (group == info.group || !is_found(info, editor.movement_search)) continue;
        group = info.group;
        ui::heading(info.group);
        group_rows(editor, frame, group, label_width);
    }
    if (group.empty()) ui::muted_text("No setting has these words");
}

}  // namespace slipface
