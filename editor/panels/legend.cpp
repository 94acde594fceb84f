#include "panels/legend.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr int most_rows = 12;

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
        case Hatch::none:
            break;
        case Hatch::diagonal:
            diagonal(true);
            break;
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

void count_faces(const Document& document, ViewportState& state) {
    if (state.counted == &document && state.counted_revision == document.face_revision()) return;
    state.counted = &document;
    state.counted_revision = document.face_revision();
    state.face_counts.assign(document.level().surfaces.size(), 0);
    for (const SurfaceId surface : document.resolved().surface)
        if (surface < state.face_counts.size()) ++state.face_counts[surface];
}

}  // namespace

void draw_swatch(ImDrawList& list, ImVec2 min, ImVec2 max, const SurfaceType& type, float rounding) {
    const ImVec4 color{type.color[0], type.color[1], type.color[2], 1.0f};
    list.AddRectFilled(min, max, ui::packed(color), rounding);
    list.PushClipRect(min, max, true);
    draw_hatch(list, min, max, type.hatch, IM_COL32(16, 18, 22, 150));
    list.PopClipRect();
}

void legend(const Editor& editor, ViewportState& state) {
    const Document& document = *editor.document;
    if (editor.style.overlay <= 0.0f || editor.playtest) return;
    count_faces(document, state);
    const auto& surfaces = document.level().surfaces;
    std::vector<SurfaceId> shown;
    for (std::size_t i = 1; i < surfaces.size() && shown.size() < most_rows; ++i)
        if (state.face_counts[i] > 0) shown.push_back(static_cast<SurfaceId>(i));
    const float scale = ui::scale(), row = 23 * scale, side = 15 * scale;
    if (shown.empty() || state.size.x < 300 * scale ||
        state.size.y < 160 * scale + static_cast<float>(shown.size()) * row)
        return;

    float name_width = 0.0f, count_width = 0.0f;
    for (const SurfaceId id : shown) {
        name_width = std::max(name_width, ImGui::CalcTextSize(surfaces[id].name.c_str()).x);
        count_width =
            std::max(count_width, ImGui::CalcTextSize(std::to_string(state.face_counts[id]).c_str()).x);
    }
    name_width = std::min(name_width, 160 * scale);
    const ImVec2 padding{12 * scale, 9 * scale};
    const float width = 2 * padding.x + side + 9 * scale + name_width + 18 * scale + count_width;
    const float height = 2 * padding.y + static_cast<float>(shown.size()) * row - (row - side);
    const ImVec2 min{state.min.x + 14 * scale, state.min.y + state.size.y - 14 * scale - height};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, {min.x + width, min.y + height},
                       ui::packed(ui::with_alpha(ui::palette().window, 0.82f)), 6 * scale);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const SurfaceType& type = surfaces[shown[i]];
        const ImVec2 at{min.x + padding.x, min.y + padding.y + static_cast<float>(i) * row};
        const float text_y = at.y + (side - ImGui::GetTextLineHeight()) * 0.5f;
        draw_swatch(list, at, {at.x + side, at.y + side}, type, 3 * scale);
        const float name_x = at.x + side + 9 * scale;
        const ImVec4 clip{name_x, at.y - row, name_x + name_width, at.y + row};
        list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {name_x, text_y}, ui::packed(ui::palette().text),
                     type.name.c_str(), nullptr, 0.0f, &clip);
        const std::string count = std::to_string(state.face_counts[shown[i]]);
        list.AddText({min.x + width - padding.x - ImGui::CalcTextSize(count.c_str()).x, text_y},
                     ui::packed(ui::palette().muted), count.c_str());
    }
}

}  // namespace slipface
