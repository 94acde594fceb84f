// Dialogs about background work: opening, recovering, files that changed on disk.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "app/dialog_parts.h"
#include "app/parts.h"
#include "document/path_text.h"
#include "slipface/base/counted.h"
#include "tools/commands/icons.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

std::string age_text(std::int64_t written_s) {
    const std::int64_t now =
        std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch())
            .count();
    const std::int64_t minutes = std::max<std::int64_t>(0, now - written_s) / 60;
    if (minutes < 1) return "just now";
    if (minutes < 60) return fmt::format("{} min ago", minutes);
    if (minutes < 48 * 60) return fmt::format("{} h ago", minutes / 60);
    return fmt::format("{} days ago", minutes / (24 * 60));
}

// "Paint ice (3), Unset faces, Set spawn point"
std::string steps_text(const std::vector<std::string>& steps) {
    std::string text;
    for (std::size_t i = 0; i < steps.size();) {
        std::size_t last = i + 1;
        while (last < steps.size() && steps[last] == steps[i])
            ++last;
        text += (text.empty() ? "" : ", ") + steps[i];
        if (last - i > 1) text += fmt::format(" ({})", last - i);
        i = last;
    }
    return text.empty() ? "Changes without a name" : text;
}

// "23 Nov 10:35, 5 min ago"
std::string time_text(std::int64_t written_s) {
    const auto time = static_cast<std::time_t>(written_s);
    std::tm local{};
    localtime_r(&time, &local);
    return fmt::format("{:%d %b %H:%M}, {}", local, age_text(written_s));
}

void recoverable_row(Parts& parts, const AutosaveInfo& info, std::size_t row) {
    Editor& editor = parts.editor;
    const float scale = ui::scale();
    const std::string name = printable(info.mesh_path.filename().string());
    ImGui::PushID(static_cast<int>(row));
    const ui::Scope scope(name);
    const float width = 92 * scale;
    const ImVec2 at = ImGui::GetCursorPos();
    ImGui::BeginGroup();
    ui::push_font(ui::fonts().semibold);
    ImGui::TextUnformatted(name.c_str());
    ImGui::PopFont();
    ImGui::SameLine();
    ImGui::TextColored(ui::palette().muted, "%s", autosave_facts(parts, info).c_str());
    const float text_width = ImGui::GetContentRegionAvail().x - 2 * width - 24 * scale;
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + std::max(80 * scale, text_width));
    ImGui::TextColored(ui::palette().muted, "%s", shown_folder(parts, info.mesh_path).c_str());
    ImGui::TextColored(ui::palette().muted, "%s", printable(steps_text(info.steps)).c_str());
    ImGui::PopTextWrapPos();
    ui::end(ImGui::EndGroup);
    ui::tooltip(shown_text(parts, info.mesh_path.string()).c_str());
    const float bottom = ImGui::GetCursorPosY();
    ImGui::SetCursorPos({at.x + ImGui::GetContentRegionAvail().x - 2 * width - 8 * scale, at.y + 4 * scale});
    bool drop = false, take = false;
    drop = ui::button("Discard", "Delete these autosaves", true, {width, 0});
    ImGui::SameLine();
    take = ui::primary_button("Recover", true, {width, 0});
    ImGui::SetCursorPosY(std::max(bottom, ImGui::GetCursorPosY()) + 8 * scale);
    ImGui::PopID();
    if (drop) discard_autosave(editor, info);
    if (take) request_recovery(editor, info);
}

}  // namespace

std::string autosave_facts(const Parts& parts, const AutosaveInfo& info) {
    const std::string facts = counted(info.steps.size(), "step") +
                              (info.saved_since ? ", from before the last save: Recover merges both" : "");
    return parts.deterministic ? facts : facts + ", " + time_text(info.written_s);
}

std::string shown_folder(const Parts& parts, const std::filesystem::path& file) {
    const std::string whole = file.parent_path().string() + "/";
    const std::string text = shown_text(parts, whole);
    return text == whole ? with_tilde(file.parent_path()) : printable(text);
}

void loading_dialog(Parts& parts) {
    const ui::Scope scope("Loading");
    const float scale = ui::scale();
    Loading& loading = *parts.editor.session.loading;
    const char* const verb = loading.kind == Loading::Kind::reload ? "Reading again " : "Opening ";
    dialog_title("", ui::palette().accent, (verb + loading.path.filename().string()).c_str());
    const Progress& progress = loading.progress();
    ImGui::ProgressBar(static_cast<float>(progress.fraction()), {ImGui::GetContentRegionAvail().x, 8 * scale},
                       "");
    ImGui::TextColored(ui::palette().muted, "%s  %.0f %%", progress.stage(), 100.0 * progress.fraction());
    align_buttons(1, 100 * scale);
    if (ui::button("Cancel", nullptr, true, {100 * scale, 0})) cancel_loading(parts.editor);
}

void recover_dialog(Parts& parts) {
    const ui::Scope scope("Recover");
    const float scale = ui::scale();
    dialog_title(icons::life_ring, ui::palette().accent, "Unsaved changes were found");
    wrapped(
        "Slipface ended before these changes were saved. Recover opens the level with the changes as one "
        "step, which can be undone.");
    ImGui::Dummy({0, 8 * scale});
    const std::vector<AutosaveInfo> rows = parts.editor.session.recoverable;
    const float height =
        std::min(static_cast<float>(rows.size()) * 84 * scale, ImGui::GetIO().DisplaySize.y * 0.5f);
    ImGui::BeginChild("rows", {0, height});
    for (std::size_t i = 0; i < rows.size(); ++i)
        recoverable_row(parts, rows[i], i);
    ui::end(ImGui::EndChild);
    align_buttons(1, 110 * scale);
    if (ui::button("Not now", "Decide later; File > Recover autosaves lists them again", true,
                   {110 * scale, 0}))
        parts.editor.session.recoverable.clear();
}

}  // namespace slipface
