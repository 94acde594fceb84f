#include "panels/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "slipface/base/counted.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr int max_rows = 12;

void draw_hatch(ImDrawList& list, ImVec2 min, ImVec2 max, Hatch hatch, ImU32 ink) {
    const float w = max.x - min.x, h = max.y - min.y, step = std::max(3.0f, w / 3.0f),
                pen = std::max(1.0f, w / 11.0f);
    const auto diagonal = [&](bool rising) {
        for (float x = -h; x < w + h; x += step * 1.2f) {
            const ImVec2 a{min.x + x, rising ? max.y : min.y}, b{min.x + x + h, rising ? min.y : max.y};
            list.AddLine(a, b, ink, pen);
        }
    };
    switch (hatch) {
        case Hatch::none: break;
        case Hatch::diagonal: diagonal(true); break;
        case Hatch::cross:
            diagonal(true);
            diagonal(false);
            break;
        case Hatch::dots:
            for (float y = step * 0.5f; y < h; y += step)
                for (float x = step * 0.5f; x < w; x += step)
                    list.AddCircleFilled({min.x + x, min.y + y}, pen * 0.9f, ink, 8);
            break;
        case Hatch::horizontal:
            for (float y = step * 0.5f; y < h; y += step)
                list.AddLine({min.x, min.y + y}, {max.x, min.y + y}, ink, pen);
            break;
        case Hatch::vertical:
            for (float x = step * 0.5f; x < w; x += step)
                list.AddLine({min.x + x, min.y}, {min.x + x, max.y}, ink, pen);
            break;
        case Hatch::checker:
            for (int row = 0; row < 4; ++row)
                for (int column = row % 2; column < 4; column += 2)
                    list.AddRectFilled(
                        {min.x + w * static_cast<float>(column) / 4, min.y + h * static_cast<float>(row) / 4},
                        {min.x + w * static_cast<float>(column + 1) / 4,
                         min.y + h * static_cast<float>(row + 1) / 4},
                        ink);
            break;
        case Hatch::rings:
            for (float radius = step * 0.5f; radius < w * 0.75f; radius += step * 0.8f)
                list.AddCircle({min.x + w / 2, min.y + h / 2}, radius, ink, 16, pen);
            break;
    }
}

}  // namespace

void draw_swatch(ImDrawList& list, ImVec2 min, ImVec2 max, const SurfaceType& type, float rounding) {
    const ImVec4 color{type.color[0], type.color[1], type.color[2], 1.0f};
    list.AddRectFilled(min, max, ui::packed(color), rounding);
    list.PushClipRect(min, max, true);
    draw_hatch(list, min, max, type.hatch, IM_COL32(16, 18, 22, 150));
    list.PopClipRect();
    list.AddRect(min, max, ui::packed(ui::with_alpha(ui::palette().muted, 0.8f)), rounding);
}

namespace {

std::string area_text(double area) {
    if (area >= 10000.0) return fmt::format("{:.1f}k m\u00b2", area * 1e-3);
    return area >= 100.0 ? fmt::format("{:.0f} m\u00b2", area) : fmt::format("{:.1f} m\u00b2", area);
}

struct SlopeRow {
    const char* text;
    ImU32 color;
    SlopeClass slope;
};
// The colours that the shader gives them.
constexpr std::array<SlopeRow, 3> walk_rows{{{"Walkable", IM_COL32(51, 143, 199, 255), SlopeClass::walkable},
                                             {"Too steep", IM_COL32(204, 51, 64, 255), SlopeClass::steep},
                                             {"Overhang", IM_COL32(92, 69, 128, 255), SlopeClass::overhang}}};

std::vector<SurfaceId> types_in_use(const Document& document) {
    std::vector<SurfaceId> shown;
    for (std::size_t i = 1; i < document.level().surfaces.size() && shown.size() < max_rows; ++i)
        if (document.face_count_of(static_cast<SurfaceId>(i)) > 0) shown.push_back(static_cast<SurfaceId>(i));
    return shown;
}

float row_height() {
    return 23 * ui::scale();
}

}  // namespace

LegendLayout legend_layout(const Editor& editor, ImVec2 min, ImVec2 max) {
    const Document& document = *editor.document;
    LegendLayout layout;
    const bool by_slope = editor.style.colors != FaceColors::types;
    if (editor.playtest || (editor.style.overlay <= 0.0f && !by_slope)) return layout;
    // The Types panel says the same.
    if (!by_slope && editor.layout.visible(PanelId::palette)) return layout;
    const float scale = ui::scale();
    const auto add = [&](std::string name, std::size_t faces, std::string area) {
        layout.name_width = std::max(layout.name_width, ImGui::CalcTextSize(name.c_str()).x);
        layout.count_width =
            std::max(layout.count_width, ImGui::CalcTextSize(std::to_string(faces).c_str()).x);
        layout.area_width = std::max(layout.area_width, ImGui::CalcTextSize(area.c_str()).x);
        layout.rows.push_back({std::move(name), std::move(area), faces, std::nullopt});
    };
    if (by_slope) {
        const SlopeCounts counts = slope_counts(document);
        for (const SlopeRow& row : walk_rows) {
            const auto i = static_cast<std::size_t>(row.slope);
            add(row.text, counts.faces[i], area_text(counts.area[i]));
        }
    } else {
        for (const SurfaceId id : types_in_use(document)) {
            add(document.level().surfaces[id].name, document.face_count_of(id),
                area_text(document.area_of(id)));
            layout.rows.back().surface = id;
        }
    }
    layout.name_width = std::min(layout.name_width, 160 * scale);
    const float side = 15 * scale;
    const ImVec2 padding{12 * scale, 9 * scale};
    const float width = 2 * padding.x + side + 9 * scale + layout.name_width + 18 * scale +
                        layout.count_width + 16 * scale + layout.area_width;
    const float height =
        2 * padding.y + static_cast<float>(layout.rows.size()) * row_height() - (row_height() - side);
    if (max.x - min.x < width + 28 * scale || max.y - min.y < height + 160 * scale) layout.rows.clear();
    layout.min = {min.x + 14 * scale, max.y - 14 * scale - height};
    layout.max = {layout.min.x + width, layout.min.y + height};
    return layout;
}

void legend_buttons(Editor& editor, const LegendLayout& layout) {
    const ui::Scope scope("Legend");
    const float scale = ui::scale();
    for (std::size_t i = 0; i < layout.rows.size(); ++i) {
        const LegendLayout::Row& row = layout.rows[i];
        ImGui::SetCursorScreenPos(
            {layout.min.x + 4 * scale, layout.min.y + 5 * scale + static_cast<float>(i) * row_height()});
        ImGui::PushID(static_cast<int>(i));
        const bool pressed =
            ImGui::InvisibleButton("row", {layout.max.x - layout.min.x - 8 * scale, row_height()});
        ImGui::PopID();
        ui::record_last_item(row.name);
        layout.lit = ImGui::IsItemHovered() ? std::optional(i) : layout.lit;
        ui::tooltip(("Select " + counted(row.faces, "face") + "; with Ctrl to add them").c_str());
        if (!pressed) continue;
        const SelectBy by = ImGui::GetIO().KeyCtrl ? SelectBy::add : SelectBy::replace;
        std::vector<FaceId> faces = row.surface ? faces_of_type(*editor.document, *row.surface)
                                                : faces_with_slope(*editor.document, walk_rows[i].slope);
        apply_selection(editor, std::move(faces), by, "Select " + row.name);
    }
}

void draw_legend(const Editor& editor, const LegendLayout& layout) {
    if (layout.rows.empty()) return;
    const float scale = ui::scale(), side = 15 * scale;
    const ImVec2 padding{12 * scale, 9 * scale};
    const ui::Palette& p = ui::palette();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(layout.min, layout.max, ui::packed(ui::with_alpha(p.window, 0.86f)), 6 * scale);
    for (std::size_t i = 0; i < layout.rows.size(); ++i) {
        const LegendLayout::Row& row = layout.rows[i];
        const ImVec2 at{layout.min.x + padding.x,
                        layout.min.y + padding.y + static_cast<float>(i) * row_height()};
        if (layout.lit == i)
            list.AddRectFilled({layout.min.x + 4 * scale, at.y - 4 * scale},
                               {layout.max.x - 4 * scale, at.y + side + 4 * scale}, ui::packed(p.hovered),
                               4 * scale);
        const float text_y = at.y + (side - ImGui::GetTextLineHeight()) * 0.5f;
        if (row.surface)
            draw_swatch(list, at, {at.x + side, at.y + side}, editor.document->level().surfaces[*row.surface],
                        3 * scale);
        else
            list.AddRectFilled(at, {at.x + side, at.y + side}, walk_rows[i].color, 3 * scale);
        const float name_x = at.x + side + 9 * scale;
        ui::ellipsis({name_x, text_y}, name_x + layout.name_width + 1.0f, p.text, row.name);
        const auto right = [&](float x, const std::string& text) {
            list.AddText({x - ImGui::CalcTextSize(text.c_str()).x, text_y}, ui::packed(p.muted),
                         text.c_str());
        };
        right(layout.max.x - padding.x, row.area);
        right(layout.max.x - padding.x - layout.area_width - 16 * scale, std::to_string(row.faces));
    }
}

}  // namespace slipface
