// The level's surface types: choosing the brush.
#include <imgui_internal.h>

#include <algorithm>
#include <string>

#include "panels/legend.h"
#include "panels/panels.h"
#include "panels/property_rows.h"
#include "panels/surface_editor.h"
#include "slipface/base/counted.h"
#include "tools/commands/icons.h"
#include "tools/selection/selecting.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

struct Row {
    const std::string& name;
    const SurfaceType* type;  // null: unset
    std::size_t faces;
    int hotkey;
    bool chosen;
};

void text_right_of(ImDrawList& list, float right, float y, ImU32 color, const std::string& text) {
    list.AddText({right - ImGui::CalcTextSize(text.c_str()).x, y}, color, text.c_str());
}

bool draw_row(const Row& row) {
    const float em = ImGui::GetFontSize();
    const float height = ImGui::GetFrameHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float right = at.x + ImGui::GetContentRegionAvail().x;
    const bool pressed = ImGui::Selectable("##row", row.chosen, 0, {0, height});
    ui::record_last_item(row.name, true, row.chosen);

    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 muted = ui::packed(ui::palette().muted);
    const float side = height - 0.4f * em;
    const ImVec2 swatch{at.x + 0.2f * em, at.y + 0.2f * em};
    const ImVec2 swatch_end{swatch.x + 1.4f * side, swatch.y + side};
    if (row.type) {
        draw_swatch(list, swatch, swatch_end, *row.type, 0.2f * em);
    } else {
        list.AddRect(swatch, swatch_end, muted, 0.2f * em);
        list.AddLine({swatch.x, swatch_end.y}, {swatch_end.x, swatch.y}, muted);
    }

    const float text_y = at.y + 0.5f * (height - em);
    const float key_left = right - 1.4f * em;
    const std::string key = row.type && row.hotkey == 0 ? "" : std::to_string(row.hotkey);
    if (!key.empty()) {
        list.AddRect({key_left, at.y + 0.18f * em}, {right - 0.2f * em, at.y + height - 0.18f * em},
                     ui::packed(ui::palette().hairline), 0.2f * em);
        text_right_of(list, key_left + 0.6f * em + 0.5f * ImGui::CalcTextSize(key.c_str()).x, text_y, muted,
                      key);
    }
    const std::string count = std::to_string(row.faces);
    const float count_right = key_left - 0.5f * em;
    if (row.faces > 0) text_right_of(list, count_right, text_y, muted, count);
    const float name_left = swatch_end.x + 0.5f * em;
    const float name_right =
        count_right - (row.faces > 0 ? ImGui::CalcTextSize(count.c_str()).x + 0.5f * em : 0.0f);
    ui::ellipsis_text(list, {name_left, text_y}, {std::max(name_left, name_right), at.y + height}, name_right,
                      row.name.c_str());
    return pressed;
}

// The context menu of a type.
void row_menu(Editor& editor, std::optional<SurfaceId> surface) {
    if (!ImGui::BeginPopupContextItem("menu")) return;
    const ui::Scope scope("Type menu");
    Document& document = *editor.document;
    const bool selected = !document.selection().empty();
    if (ui::menu_item("Select its faces", "", false, true, "Select every face of this type"))
        apply_selection(editor, surface ? faces_of_type(document, *surface) : unpainted_faces(document),
                        SelectBy::replace, "Select by type");
    if (ui::menu_item("Paint the selection with this type", "", false, selected,
                      "Give the selected faces this type"))
        paint_faces(editor, document.selection(), surface);
    if (surface && ui::begin_menu("Replace by")) {
        const std::vector<SurfaceType> surfaces = document.level().surfaces;
        for (std::size_t i = 0; i < surfaces.size(); ++i)
            if (ui::menu_item(
                    surfaces[i].name.c_str(), "", false, i != *surface,
                    "Change all faces of one type to another; only inside the selection if there is one"))
                replace_type(editor, *surface, static_cast<SurfaceId>(i));
        if (ui::menu_item("Unset", "", false, true, "Rules and suffixes decide again"))
            replace_type(editor, *surface, std::nullopt);
        ui::end_menu();
    }
    ui::end(ImGui::EndPopup);
}

std::string row_tooltip(const Row& row) {
    if (!row.type) return "Remove the paint of faces; rules and suffixes decide their type again";
    std::string text =
        row.name + ", " + counted(row.faces, "face") + "\nRight click: select its faces, replace it";
    if (row.hotkey != 0) text += "\nKey " + std::to_string(row.hotkey);
    return text;
}

std::size_t unset_faces(const Document& document) {
    static std::uint64_t revision = 0;
    static std::size_t count = 0;
    if (revision != document.face_revision()) {
        revision = document.face_revision();
        const auto& overrides = document.level().overrides;
        const std::ptrdiff_t unset = std::count(overrides.begin(), overrides.end(), std::nullopt);
        count = document.face_count() - (overrides.size() - static_cast<std::size_t>(unset));
    }
    return count;
}

}  // namespace

void palette_panel(Editor& editor) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Palette");
    const Document& document = *editor.document;
    const std::vector<SurfaceType>& surfaces = document.level().surfaces;
    static const std::string unset_name = "Unset";

    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                        {ImGui::GetStyle().ItemSpacing.x, 0.1f * ImGui::GetFontSize()});
    std::optional<std::optional<SurfaceId>> chosen;
    const auto show = [&](int id, const Row& row, std::optional<SurfaceId> surface) {
        ImGui::PushID(id);
        if (draw_row(row)) chosen = surface;
        ui::tooltip(row_tooltip(row).c_str());
        row_menu(editor, surface);
        ImGui::PopID();
    };
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const auto surface = static_cast<SurfaceId>(i);
        show(static_cast<int>(i),
             {surfaces[i].name, &surfaces[i], document.face_count_of(surface), surfaces[i].hotkey,
              editor.brush == surface},
             surface);
    }
    show(-1, {unset_name, nullptr, unset_faces(document), 0, !editor.brush}, std::nullopt);
    ImGui::PopStyleVar();
    if (chosen) choose_brush(editor, *chosen);

    surface_editor(editor);
}

}  // namespace slipface
