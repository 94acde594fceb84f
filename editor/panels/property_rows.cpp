#include "panels/property_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/commands/icons.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

bool is_angle(const char* unit) {
    return std::string_view(unit) == "deg";
}

// What follows the number.
std::string suffix(const char* unit) {
    const std::string_view name(unit);
    if (name.empty()) return "";
    if (name == "deg") return "°";
    if (name == "m/s2") return " m/s²";
    return " " + std::string(name);
}

}  // namespace

void settle_live_edit(Editor& editor) {
    if (!editor.live_edit || ImGui::IsAnyItemActive()) return;
    editor.live_edit = false;
    if (editor.document) editor.document->commit();
}

void live_edit(Editor& editor, const std::string& step_name) {
    if (editor.live_edit || !editor.document || !ImGui::IsAnyItemActive()) return;
    editor.document->begin(step_name);
    editor.live_edit = true;
}

float label_width_of(const char* label) {
    return ImGui::CalcTextSize(label, nullptr, true).x;
}

bool begin_property_rows(const char* id, float label_width, float control_em) {
    const float em = ImGui::GetFontSize();
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {0.15f * em, 0.1f * em});
    const float maximum = ImGui::GetContentRegionAvail().x - control_em * em;
    if (!ImGui::BeginTable(id, 4, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings)) {
        ImGui::PopStyleVar();
        return false;
    }
    ImGui::TableSetupColumn("modified", ImGuiTableColumnFlags_WidthFixed, 0.5f * em);
    ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthFixed,
                            std::max(4.0f * em, std::min(label_width, maximum)));
    ImGui::TableSetupColumn("control", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("reset", ImGuiTableColumnFlags_WidthFixed, 1.4f * em);
    return true;
}

void end_property_rows() {
    ImGui::EndTable();
    ImGui::PopStyleVar();
}

void property_row(const char* label, const char* tooltip, bool modified, float indent) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const float em = ImGui::GetFontSize();
    if (modified) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddCircleFilled(
            {at.x + 0.22f * em, at.y + 0.5f * ImGui::GetFrameHeight()}, 0.17f * em,
            ui::packed(ui::palette().accent));
    }
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    if (indent > 0.0f) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + indent);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(label);
    ImGui::PopTextWrapPos();
    ui::tooltip(tooltip);
    ImGui::TableNextColumn();
}

bool reset_cell(const char* label, bool modified) {
    ImGui::TableNextColumn();
    if (!modified) return false;
    const ui::Scope scope(label);
    ImGui::PushID(label);
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0, 0, 0, 0));
    ImGui::PushStyleColor(ImGuiCol_Text, ui::palette().muted);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0f, ImGui::GetStyle().FramePadding.y});
    const bool pressed = ImGui::Button(icons::undo, {1.4f * ImGui::GetFontSize(), 0.0f});
    ImGui::PopStyleVar();
    ImGui::PopStyleColor(2);
    ui::record_last_item("Reset");
    ui::tooltip("Reset to the default");
    ImGui::PopID();
    return pressed;
}

bool number_slider(const char* label, double* value, double minimum, double maximum, const char* unit,
                   const char* tooltip, bool whole) {
    const double factor = is_angle(unit) ? degrees_per_radian : 1.0;
    double shown = *value * factor;
    const double low = minimum * factor, high = maximum * factor;
    // Most values of a range such as 0 to 1000 lie near its lower end.
    const bool from_zero = minimum == 0.0 && maximum >= 500.0;
    const bool decades = minimum > 0.0 && maximum >= 100.0 * minimum;
    const bool logarithmic = !whole && !is_angle(unit) && (from_zero || decades);
    const std::string format = (whole ? "%.0f" : from_zero ? "%.1f" : "%.4g") + suffix(unit);
    ImGui::SetNextItemWidth(-1.0f);
    const bool changed = ui::number_slider((std::string("##") + label).c_str(), &shown, low, high,
                                           format.c_str(), logarithmic);
    ui::record_last_item(label);
    ui::tooltip(tooltip);
    // Converting degrees to radians may round beyond the limit.
    if (changed) *value = std::clamp(shown / factor, minimum, maximum);
    return changed;
}

std::string number_text(double value, const char* unit) {
    return fmt::format("{:.4g}{}", value * (is_angle(unit) ? degrees_per_radian : 1.0), suffix(unit));
}

std::string range_text(double minimum, double maximum, const char* unit) {
    return number_text(minimum, is_angle(unit) ? unit : "") + " to " + number_text(maximum, unit);
}

std::string sentence_case(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

float fact_column(const char* longest_name) {
    return ImGui::CalcTextSize(longest_name).x + 0.8f * ImGui::GetFontSize();
}

void fact(const char* name, const std::string& value, float wanted) {
    const float em = ImGui::GetFontSize();
    const float x = ImGui::GetCursorPosX(), width = ImGui::GetContentRegionAvail().x;
    const float name_width = ImGui::CalcTextSize(name).x;
    ImGui::PushTextWrapPos(0.0f);
    ImGui::PushStyleColor(ImGuiCol_Text, ui::palette().muted);
    ImGui::TextUnformatted(name);
    ImGui::PopStyleColor();
    // The values form a column. After a longer name the value follows if there is room, else it is below.
    const float usual = std::max(5.0f * em, wanted);
    const float column = std::max(usual, name_width + 0.8f * em);
    const bool beside =
        name_width + 0.4f * em <= 5.0f * em || column + ImGui::CalcTextSize(value.c_str()).x <= width;
    if (beside) ImGui::SameLine();
    ImGui::SetCursorPosX(x + (beside ? column : em));
    ImGui::TextUnformatted(value.data(), value.data() + value.size());
    ImGui::PopTextWrapPos();
}

void symptom_button(Editor& editor, const char* title) {
    const std::string tip = std::string("Symptoms and cures: ") + title;
    if (ui::button("Read more", tip.c_str())) editor.symptom = title;
}

}  // namespace slipface
