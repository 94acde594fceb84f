// The window while nothing is open: ways to begin.
#include <algorithm>
#include <cmath>

#include "app/dialog_parts.h"
#include "app/parts.h"
#include "document/folders.h"
#include "document/path_text.h"
#include "slipface/mesh/formats.h"
#include "tools/commands/icons.h"
#include "widgets/imgui_compat.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

// An image with the level's name below it. True when it was clicked.
bool sample_card(Parts& parts, const fs::path& level, float width) {
    const float scale = ui::scale();
    const float image = std::round(width / 1.6f);
    const float height = image + ImGui::GetTextLineHeight() + 10 * scale;
    const std::string name = level.stem().string();
    ImGui::PushID(level.c_str());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool clicked = ImGui::InvisibleButton("card", {width, height});
    ui::record_last_item(name);
    const bool lit = ImGui::IsItemHovered() || ImGui::IsItemFocused();
    LevelThumbnails::Shown shown;
    if (parts.thumbnails)
        shown = parts.thumbnails->show(level, static_cast<int>(width), static_cast<int>(image));
    ui::tooltip(shown.facts.c_str());
    ImGui::PopID();

    const ui::Palette& p = ui::palette();
    const float rounding = 6 * scale;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end{at.x + width, at.y + image};
    if (shown.texture != 0)
        list.AddImageRounded(ui::texture_id(shown.texture), at, end, {0, 1}, {1, 0}, IM_COL32_WHITE,
                             rounding);
    else
        list.AddRectFilled(at, end, ui::packed(p.raised), rounding);
    list.AddRect(at, end, ui::packed(lit ? p.accent : p.hairline), rounding, 0, (lit ? 2.0f : 1.0f) * scale);
    list.AddText({at.x + 2 * scale, end.y + 6 * scale}, ui::packed(lit ? p.accent : p.text), name.c_str());
    return clicked;
}

void samples(Parts& parts) {
    if (!parts.samples) parts.samples = sample_levels();
    const std::vector<fs::path>& levels = *parts.samples;
    if (levels.empty()) return;
    const ui::Scope scope("Samples");
    ui::heading("Sample levels");
    const float gap = 12 * ui::scale();
    const float width = ImGui::GetContentRegionAvail().x;
    const auto fitting = static_cast<std::size_t>(std::max(1.0f, (width + gap) / (150 * ui::scale() + gap)));
    const std::size_t columns = std::min(levels.size(), fitting);
    const float card =
        std::floor((width - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns));
    fs::path chosen;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        if (i % columns != 0) ImGui::SameLine(0, gap);
        if (sample_card(parts, levels[i], card)) chosen = levels[i];
    }
    if (!chosen.empty()) request_open(parts.editor, chosen);
}

// A file's name, followed by muted text that distinguishes it from others. True when it was clicked.
bool file_row(const char* icon, const std::string& name, const std::string& about, const std::string& tip) {
    const float x = ImGui::GetCursorPosX();
    const bool clicked =
        ImGui::Selectable("##row", false, 0, {ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight()});
    ui::record_last_item(name);
    ui::tooltip(tip.c_str());
    ImGui::SameLine(0, 0);
    ImGui::SetCursorPosX(x);
    ImGui::Text("%s  %s", icon, name.c_str());
    ImGui::SameLine(0, 12 * ui::scale());
    ImGui::TextColored(ui::palette().muted, "%s", about.c_str());
    return clicked;
}

void unsaved_rows(Parts& parts) {
    const std::vector<AutosaveInfo> rows = parts.editor.session.left_behind;
    if (rows.empty()) return;
    const ui::Scope scope("Unsaved");
    ui::heading("Unsaved changes of sessions that ended");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const std::string name = printable(rows[i].mesh_path.filename().string());
        const std::string folder = shown_folder(parts, rows[i].mesh_path);
        if (file_row(icons::life_ring, name, folder + "   " + autosave_facts(parts, rows[i]),
                     "Open the level with these changes as one step, which can be undone"))
            request_recovery(parts.editor, rows[i]);
        ImGui::PopID();
    }
}

void recent_rows(Parts& parts) {
    const std::vector<fs::path> recent = parts.editor.recent.paths();
    if (recent.empty()) return;
    const ui::Scope scope("Recent");
    ui::heading("Recent");
    const std::vector<std::string> folders = distinguishing_folders(recent);
    for (std::size_t i = 0; i < recent.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const std::string name = printable(recent[i].filename().string());
        const bool chosen = file_row("\uf15b", name, folders[i], shown_text(parts, with_tilde(recent[i])));
        ImGui::PopID();
        if (chosen) request_open(parts.editor, recent[i]);
    }
}

}  // namespace

void welcome(Parts& parts) {
    const ui::Scope scope("Welcome");
    const float scale = ui::scale();
    const ImVec2 size = ImGui::GetWindowSize();
    const float width = std::min(760 * scale, size.x - 40 * scale);
    const float top = std::max(16 * scale, size.y * 0.08f);
    ImGui::SetCursorPos({(size.x - width) * 0.5f, top});
    ImGui::BeginChild("welcome", {width, size.y - top}, false, ImGuiWindowFlags_NoSavedSettings);
    ui::push_font(ui::fonts().title);
    ImGui::TextUnformatted("Slipface");
    ImGui::PopFont();
    ui::muted_text("Paint surface types, walk the level, and see why the player moved as it did");
    ImGui::Dummy({0, 8 * scale});
    if (ui::primary_button("\uf07c  Open a level\u2026###Open", true, {180 * scale, 34 * scale}))
        run_command(parts.editor, "file.open");
    const Command& open = *find_command("file.open");
    // A program that lacks the formats of other programs is the page in a browser.
    const bool page = mesh_format_of("level.gltf") == nullptr;
    ui::muted_text(
        (page ? "Your own level: drop its OBJ or Quake 3 map onto this page, with its MTL, textures and "
                "level file at once. They are stored in this browser and sent nowhere."
              : "Your own level: drop its file onto this window, press " + shortcut_text(parts.editor, open) +
                    ", or name it on the command line. OBJ, glTF, FBX, COLLADA, Quake 3 maps and more are "
                    "read.")
            .c_str());
    ImGui::Dummy({0, 6 * scale});
    unsaved_rows(parts);
    samples(parts);
    ImGui::Dummy({0, 6 * scale});
    recent_rows(parts);
    ui::end(ImGui::EndChild);
}

}  // namespace slipface
