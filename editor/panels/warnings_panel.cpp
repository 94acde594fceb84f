// What was repaired, dropped or not found again while opening.
#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "panels/panels.h"
#include "panels/property_rows.h"
#include "slipface/base/counted.h"
#include "tools/commands/icons.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr std::size_t max_orphans = 500;  // every one listed costs time in every frame

void entry(const std::string& title, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, ui::palette().accent);
    ImGui::TextUnformatted(icons::warning);
    ImGui::PopStyleColor();
    ImGui::SameLine();
    ImGui::BeginGroup();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
    if (!title.empty()) ui::muted_text(title.c_str());
    ui::end(ImGui::EndGroup);
    ImGui::Spacing();
}

// Only the file's name: the title bar shows the folder.
std::string short_location(const std::string& location) {
    const std::size_t slash = location.find_last_of('/', location.find(':'));
    return slash == std::string::npos ? location : location.substr(slash + 1);
}

// One line per guess: a click selects and frames it.
void guess_rows(Editor& editor) {
    const Document& document = *editor.document;
    const std::size_t count = document.guessed().size();
    const float height = ImGui::GetTextLineHeightWithSpacing();
    ImGui::BeginChild("guesses", {0, height * static_cast<float>(std::min<std::size_t>(count, 8)) + 4});
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(count));
    std::optional<std::size_t> chosen;
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const FaceId face = document.guessed()[static_cast<std::size_t>(i)];
            const std::string& material = document.level().mesh.material_of(face);
            const std::string name = "Face " + std::to_string(face) + ": " +
                                     document.level().surfaces[document.surface_of(face)].name +
                                     (material.empty() ? "" : ", " + material);
            const std::span<const FaceId> selected = document.selection();
            if (ImGui::Selectable(name.c_str(), std::binary_search(selected.begin(), selected.end(), face)))
                chosen = static_cast<std::size_t>(i);
            ui::record_last_item("Guess " + std::to_string(i + 1));
        }
    }
    ui::end(ImGui::EndChild);
    if (chosen) go_to_guess(editor, *chosen);
}

void guessed_paint(Editor& editor) {
    const std::size_t count = editor.document->guessed().size();
    if (count == 0) return;
    ui::heading("Guessed paint");
    entry("Step through them; drop what is wrong", counted(count, "face was", "faces were") +
                                                       " not found beyond doubt: the paint comes from faces "
                                                       "in the same plane or nearby, or of a part that "
                                                       "may have moved otherwise");
    constexpr std::pair<const char*, const char*> buttons[] = {
        {"Select all", "select.guessed"},        {"Previous", "select.previous_guessed"},
        {"Next", "select.next_guessed"},         {"Accept", "select.accept_guess"},
        {"Drop", "select.drop_guess"},           {"Accept the part", "select.accept_part"},
        {"Accept all", "select.accept_guessed"}, {"Drop all", "select.drop_guessed"}};
    for (const auto& [label, command] : buttons) {
        const float width = ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
        ImGui::SameLine();
        if (label == buttons[0].first || ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
        const Command& row = *find_command(command);
        if (ui::button(label, row.description, row.enabled(editor))) run_command(editor, command);
    }
    guess_rows(editor);
    ImGui::Spacing();
}

}  // namespace

void warnings_panel(Editor& editor) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Warnings");
    const Document& document = *editor.document;
    const std::vector<Orphan>& orphans = document.level().orphans;
    const Warnings& textures = editor.texture_warnings;
    if (document.warnings().empty() && orphans.empty() && textures.empty() && document.guessed().empty()) {
        ui::muted_text("Nothing was repaired or dropped while opening this level");
        return;
    }
    if (ui::button("Copy all", "Copy all warnings to the clipboard")) {
        std::string text;
        for (const Warnings& list : {document.warnings(), textures})
            for (const Diagnostic& warning : list)
                text += warning.text() + "\n";
        for (const Orphan& orphan : orphans)
            text += "orphan: " + orphan.type + ", material " + orphan.key.material + "\n";
        ImGui::SetClipboardText(text.c_str());
        editor.status = "Warnings copied";
    }
    guessed_paint(editor);
    if (!orphans.empty()) ui::heading("Orphans");
    for (const Orphan& orphan : std::span(orphans).first(std::min(orphans.size(), max_orphans))) {
        const Vec3& at = orphan.key.centroid;
        entry("material " + (orphan.key.material.empty() ? "none" : orphan.key.material) + ", at " +
                  number_text(at.x(), "") + ", " + number_text(at.y(), "") + ", " + number_text(at.z(), ""),
              "No face was found for a painted " + orphan.type + "; the file still contains it");
    }
    if (orphans.size() > max_orphans)
        ui::muted_text(("and " + std::to_string(orphans.size() - max_orphans) + " more").c_str());
    if (!document.warnings().empty()) ui::heading("Opening");
    for (const Diagnostic& warning : document.warnings())
        entry(short_location(warning.location), warning.message);
    if (!textures.empty()) ui::heading("Textures");
    for (const Diagnostic& warning : textures)
        entry(warning.location, warning.message);
}

}  // namespace slipface
