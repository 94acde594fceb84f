// The file dialog's columns: start folders, the folder's entries, and recent levels above a preview.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <system_error>

#include "app/dialog_parts.h"
#include "app/file_browser.h"
#include "document/path_text.h"
#include "tools/commands/icons.h"
#include "widgets/imgui_compat.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

std::string size_text(std::uint64_t bytes) {
    if (bytes < 1000) return fmt::format("{} B", bytes);
    constexpr const char* units[] = {"kB", "MB", "GB", "TB", "PB"};
    double amount = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (amount /= 1000.0; amount >= 999.5 && unit + 1 < std::size(units); ++unit)
        amount /= 1000.0;
    return fmt::format("{:.{}f} {}", amount, amount < 9.95 ? 1 : 0, units[unit]);
}

// "10:35" today, "23 Nov 10:35" this year, "23 Nov 2024" before.
std::string date_text(std::int64_t changed_s) {
    const auto time = static_cast<std::time_t>(changed_s);
    const std::time_t now = std::time(nullptr);
    std::tm then{}, today{};
    if (!localtime_r(&time, &then) || !localtime_r(&now, &today)) return {};
    if (then.tm_year != today.tm_year) return fmt::format("{:%d %b %Y}", then);
    return then.tm_yday == today.tm_yday ? fmt::format("{:%H:%M}", then)
                                         : fmt::format("{:%d %b %H:%M}", then);
}

void muted_at_right(const std::string& text) {
    const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (free > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + free);
    ImGui::TextColored(ui::palette().muted, "%s", text.c_str());
}

// A row of any text, which may contain "##"; true when it was clicked. Clipped at the column's end; the
// tooltip then shows all of it. `beside` follows in a muted colour if there is room.
bool named_row(const std::string& name, const std::string& shown, const std::string& tip,
               const std::string& beside = {}) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float right = at.x + ImGui::GetContentRegionAvail().x;
    const bool clicked = ImGui::Selectable("##row");
    ui::record_last_item(name);
    ui::tooltip(tip.c_str());
    ui::ellipsis(at, right, ui::palette().text, shown);
    const float next = at.x + ImGui::CalcTextSize(shown.c_str()).x + ImGui::GetStyle().ItemSpacing.x;
    if (!beside.empty() && next + ImGui::GetFontSize() < right)
        ui::ellipsis({next, at.y}, right, ui::palette().muted, beside);
    return clicked;
}

void column_headers(FileBrowser& browser) {
    static constexpr const char* names[] = {"Name", "Size", "Changed"};
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (int i = 0; i < 3; ++i) {
        ImGui::TableSetColumnIndex(i);
        ImGui::TableHeader(names[i]);
        ui::record_last_item(names[i]);
        ui::mark_as_table_row();
    }
    ImGuiTableSortSpecs* const specs = ImGui::TableGetSortSpecs();
    if (!specs || !specs->SpecsDirty || specs->SpecsCount == 0) return;
    specs->SpecsDirty = false;
    const auto order = static_cast<ListingOrder>(specs->Specs[0].ColumnIndex);
    const bool descending = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
    if (order == browser.order && descending == browser.descending) return;
    browser.order = order;
    browser.descending = descending;
    sort_rows(browser);
}

// True: it was double-clicked, or it is a folder that was clicked.
bool entry_row(Parts& parts, std::size_t row) {
    FileBrowser& browser = parts.browser;
    const FolderEntry& entry = browser.listing.entries[browser.rows[row]];
    const bool selected = entry.name == browser.chosen;
    bool wanted = false;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(static_cast<int>(row));
    constexpr int flags = ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick;
    const bool clicked = ImGui::Selectable("##row", selected, flags);
    const std::string shown = printable(entry.name);
    ui::record_last_item(entry.name, true, selected);
    ui::mark_as_table_row();
    const std::string text = (entry.folder ? "\uf07b  " : "\uf15b  ") + shown;
    if (ImGui::CalcTextSize(text.c_str()).x > ImGui::GetContentRegionAvail().x)
        ui::tooltip(shown.c_str());
    else if (entry.has_level_file)
        ui::tooltip("With a level file: surface types, spawn, cameras, settings");
    if (clicked && (entry.folder || ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)))
        wanted = true;
    else if (clicked)
        choose_row(parts, row);
    ImGui::SameLine(0, 0);
    ImGui::TextUnformatted(text.c_str(), text.c_str() + text.size());
    if (entry.has_level_file) {
        ImGui::SameLine(0, 8 * ui::scale());
        ImGui::TextColored(ui::palette().muted, "%s", icons::brush);
    }
    ImGui::TableNextColumn();
    if (!entry.folder) muted_at_right(size_text(entry.bytes));
    ImGui::TableNextColumn();
    if (!parts.deterministic && entry.changed_s != 0)
        ImGui::TextColored(ui::palette().muted, "%s", date_text(entry.changed_s).c_str());
    ImGui::PopID();
    return wanted;
}

std::string empty_text(const FileBrowser& browser) {
    if (!browser.listing.problem.empty()) return "This folder cannot be read: " + browser.listing.problem;
    if (browser.listing.entries.empty()) return "No such files here";
    return "Nothing here matches the filter";
}

void column(const char* id, float height, void (*content)(Parts&), Parts& parts) {
    ImGui::BeginChild(id, {0, height}, false, ImGuiWindowFlags_NoNav);
    content(parts);
    ui::end(ImGui::EndChild);
}

void places(Parts& parts) {
    FileBrowser& browser = parts.browser;
    ui::heading("Places");
    fs::path chosen;
    const auto row = [&](const char* icon, const std::string& name, const fs::path& folder) {
        ImGui::PushID(folder.c_str());
        const std::string tip = parts.deterministic ? name : with_tilde(folder);
        if (named_row(name, std::string(icon) + "  " + name, tip)) chosen = folder;
        ImGui::PopID();
    };
    for (const StartFolder& start : browser.places)
        row(start.folder == "/"    ? "\uf0a0"
            : start.name == "Home" ? "\uf015"
                                   : "\uf07b",
            printable(start.name), start.folder);
    const std::vector<fs::path> folders = folders_of(parts.editor.recent.paths());
    if (!folders.empty()) ui::heading("Recent folders");
    std::vector<fs::path> inside;
    for (const fs::path& folder : folders)
        inside.push_back(folder / "level");
    const std::vector<std::string> names = distinguishing_folders(inside);
    for (std::size_t i = 0; i < folders.size(); ++i)
        row("\uf07b", names[i], folders[i]);
    if (!chosen.empty()) show_folder(parts, chosen);
}

void recents(Parts& parts) {
    ui::heading("Recent");
    const std::vector<fs::path> paths = parts.editor.recent.paths();
    const std::vector<std::string> folders = distinguishing_folders(paths);
    fs::path chosen;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const std::string name = printable(paths[i].filename().string());
        if (named_row(name, name, shown_text(parts, with_tilde(paths[i])), folders[i])) chosen = paths[i];
        ImGui::PopID();
    }
    if (paths.empty()) ui::muted_text("Nothing yet");
    if (!chosen.empty()) choose(parts, chosen, false);
}

}  // namespace

void folder_list(Parts& parts, float height) {
    const ui::Scope scope("Places");
    column("places", height, places, parts);
}

void recent_list(Parts& parts, float height) {
    const ui::Scope scope("Recent");
    column("recent", height, recents, parts);
}

void entry_list(Parts& parts, float height) {
    FileBrowser& browser = parts.browser;
    const ui::Scope scope("List");
    const float scale = ui::scale();
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ui::palette().panel);
    ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, 6 * scale);
    ImGui::BeginChild("list", {0, height}, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoNav);
    fs::path chosen;
    const float left_out = browser.listing.left_out > 0 ? ImGui::GetTextLineHeightWithSpacing() : 0.0f;
    constexpr int flags = ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY |
                          ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings;
    if (!browser.rows.empty() &&
        ImGui::BeginTable("entries", 3, flags, {0, ImGui::GetContentRegionAvail().y - left_out})) {
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableSetupColumn("Name",
                                ImGuiTableColumnFlags_WidthStretch | ImGuiTableColumnFlags_DefaultSort);
        ImGui::TableSetupColumn("Size", ImGuiTableColumnFlags_WidthFixed, 62 * scale);
        ImGui::TableSetupColumn("Changed",
                                ImGuiTableColumnFlags_WidthFixed | ImGuiTableColumnFlags_PreferSortDescending,
                                94 * scale);
        column_headers(browser);
        const float row_height = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
        if (browser.scroll_to >= 0)
            ImGui::SetScrollY(static_cast<float>(browser.scroll_to) * row_height - 0.4f * height);
        browser.scroll_to = -1;
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(browser.rows.size()));
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
                if (entry_row(parts, static_cast<std::size_t>(i)))
                    chosen = browser.folder /
                             browser.listing.entries[browser.rows[static_cast<std::size_t>(i)]].name;
        ImGui::EndTable();
    } else if (browser.rows.empty()) {
        ui::muted_text(empty_text(browser).c_str());
    }
    if (left_out > 0)
        ui::muted_text(fmt::format("and {} more; type a path", browser.listing.left_out).c_str());
    ui::end(ImGui::EndChild);
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
    if (!chosen.empty()) choose(parts, chosen, false);
}

void level_preview(Parts& parts, float height) {
    FileBrowser& browser = parts.browser;
    const fs::path typed = typed_path(parts);
    std::error_code error;
    if (is_level_name(typed.filename().string()) && fs::exists(typed, error)) browser.previewed = typed;
    if (browser.previewed.empty() || !parts.preview) return;
    const float width = ImGui::GetContentRegionAvail().x;
    const float image = std::min(width / 1.5f, height - 2.0f * ImGui::GetTextLineHeightWithSpacing());
    if (image < 40 * ui::scale()) return;
    const LevelPreview::Shown shown =
        parts.preview->show(browser.previewed, static_cast<int>(image * 1.5f), static_cast<int>(image));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 end{at.x + image * 1.5f, at.y + image};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (shown.texture != 0)
        list.AddImageRounded(ui::texture_id(shown.texture), at, end, {0, 1}, {1, 0}, IM_COL32_WHITE,
                             6 * ui::scale());
    else
        list.AddRectFilled(at, end, ui::packed(ui::palette().panel), 6 * ui::scale());
    ImGui::Dummy({width, image});
    ui::record_last_item("Preview");
    ImGui::TextUnformatted(printable(browser.previewed.filename().string()).c_str());
    ui::muted_text(printable(shown_text(parts, shown.facts)).c_str());
}

}  // namespace slipface
