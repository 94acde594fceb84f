// The selected faces, or the one under the mouse.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "panels/legend.h"
#include "panels/panels.h"
#include "panels/property_rows.h"
#include "tools/commands/icons.h"
#include "tools/selection/face_summary.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

// Summarizing a large selection is slow; it is cached until the document changes.
const FaceSummary& selection_summary(const Document& document) {
    static std::uint64_t revision = 0;
    static FaceSummary summary;
    if (revision != document.revision()) {
        revision = document.revision();
        summary = summarize_faces(document, document.selection());
    }
    return summary;
}

std::string source_text(SurfaceSource source) {
    switch (source) {
        case SurfaceSource::none: return "no rule, not painted";
        case SurfaceSource::rule: return "material rule";
        case SurfaceSource::suffix: return "material suffix";
        case SurfaceSource::prop: return "its prop";
        case SurfaceSource::override_: return "painted";
    }
    return "";
}

std::string shown_name(const std::optional<std::string>& name) {
    if (!name) return "Mixed";
    return name->empty() ? "None" : *name;
}

std::string slope_text(const FaceSummary& summary) {
    if (!summary.has_slope) return "No slope: no area";
    const auto whole = [](double radians) {
        return std::round(radians * 180.0 / std::numbers::pi * 10.0) / 10.0;
    };
    const double low = whole(summary.slope_min), high = whole(summary.slope_max);
    return low == high ? fmt::format("{}°", low) : fmt::format("{}° to {}°", low, high);
}

void type_fact(const Document& document, const FaceSummary& summary) {
    if (!summary.surface) {
        fact("Type", "Mixed");
        return;
    }
    const SurfaceType& type = document.level().surfaces[*summary.surface];
    fact("Type", "");
    ImGui::SameLine(0, 0);
    const float em = ImGui::GetFontSize();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    draw_swatch(*ImGui::GetWindowDrawList(), at, {at.x + em, at.y + em}, type, 0.2f * em);
    ImGui::Dummy({em, em});
    ImGui::SameLine();
    const ImVec2 text = ImGui::GetCursorScreenPos();
    const float room = ImGui::GetContentRegionAvail().x;
    ui::ellipsis(text, text.x + room, ui::palette().text, type.name);
    ImGui::Dummy({room, ImGui::GetTextLineHeight()});
}

// The types that the painted faces would have without their paint.
std::string unpainted_text(const Document& document, const FaceSummary& summary) {
    if (!summary.unpainted || !summary.unpainted_source) return "Mixed";
    const std::string& name = document.level().surfaces[*summary.unpainted].name;
    if (*summary.unpainted_source == SurfaceSource::none) return name;
    return fmt::format("{}, by {}", name, source_text(*summary.unpainted_source));
}

void facts(const Document& document, const FaceSummary& summary) {
    type_fact(document, summary);
    fact("From", summary.source ? source_text(*summary.source) : "Mixed");
    if (summary.painted > 0) fact("Unpainted", unpainted_text(document, summary));
    fact("Material", shown_name(summary.material));
    fact("Group", shown_name(summary.group));
    fact("Slope", slope_text(summary));
    fact("Area", summary.area >= 1000.0 ? fmt::format("{:.0f} m²", summary.area)
                                        : fmt::format("{:.4g} m²", summary.area));
    fact("Triangles", std::to_string(summary.triangles));
}

float selection_buttons_width() {
    return 3.0f * ui::icon_button_side() + 2.0f * ImGui::GetStyle().ItemInnerSpacing.x;
}

// At the right end of the heading's line, or below it.
void selection_buttons(Editor& editor, const FaceSummary& summary, float top) {
    const float left = ImGui::GetCursorPosX();
    ImGui::SetCursorPos(
        {left + std::max(0.0f, ImGui::GetContentRegionAvail().x - selection_buttons_width()), top});
    if (ui::icon_button(icons::brush, "Paint", "Give these faces the brush's surface type", false))
        run_command(editor, "edit.fill_selection");
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    if (ui::icon_button(icons::eraser, "Unset",
                        "Remove the paint of these faces: rules and suffixes decide their type again", false,
                        summary.painted > 0))
        run_command(editor, "edit.unset_selection");
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    if (ui::icon_button(icons::frame, "Frame", "Move the camera to see these faces", false))
        run_command(editor, "view.frame_selected");
}

}  // namespace

void inspector_panel(Editor& editor) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Inspector");
    const Document& document = *editor.document;
    const std::size_t selected = document.selection().size();
    if (selected == 0) {
        if (editor.hovered >= document.face_count()) {
            ui::heading("Faces");
            ui::muted_text("Move the mouse over a face, or select faces");
            return;
        }
        ui::heading(("Face " + std::to_string(editor.hovered)).c_str());
        facts(document, summarize_faces(document, std::span(&editor.hovered, 1)));
        return;
    }
    const FaceSummary& summary = selection_summary(document);
    const float top = ImGui::GetCursorPosY();
    const std::string heading = selected == 1
                                    ? "Face " + std::to_string(document.selection()[0]) + ", selected"
                                    : std::to_string(selected) + " faces selected";
    ui::heading(heading.c_str());
    const float below = ImGui::GetCursorPosY();
    const bool beside =
        ImGui::GetItemRectSize().x + selection_buttons_width() + 0.5f * ImGui::GetFontSize() <=
        ImGui::GetContentRegionAvail().x;
    selection_buttons(editor, summary, beside ? top : below);
    ImGui::SetCursorPosY(std::max(below, ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y));
    facts(document, summary);
}

}  // namespace slipface
