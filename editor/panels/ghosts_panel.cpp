// The tape under several settings at once, where the runs diverge, and the same route at other rates.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "panels/lab_track.h"
#include "panels/property_rows.h"
#include "tools/commands/icons.h"
#include "tools/lab/lab_actions.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

std::string distance_text(double metres) {
    return metres < 1.0 ? fmt::format("{:.1f} mm", metres * 1000.0) : fmt::format("{:.2f} m", metres);
}

bool is_removable(const LabRun& run) {
    return run.kind == LabRun::Kind::pinned || run.kind == LabRun::Kind::other;
}

void settings_tooltip(const LabRun& run, const LabRun& recorded) {
    std::string text;
    for (const std::string& change : setting_changes(recorded.settings, run.settings))
        text += (text.empty() ? "" : "\n") + change;
    ui::tooltip(text.empty() ? "The settings that were recorded" : text.c_str());
}

void run_rows(Editor& editor) {
    Lab& lab = editor.lab;
    const float em = ImGui::GetFontSize();
    std::optional<std::size_t> removed, used;
    for (std::size_t i = 0; i < lab.runs().size(); ++i) {
        LabRun& run = lab.runs()[i];
        const ui::Scope scope(run.name);
        ImGui::PushID(static_cast<int>(i));
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddCircleFilled({at.x + 0.4f * em, at.y + 0.5f * ImGui::GetFrameHeight()},
                                                    0.32f * em, ui::packed(run_color(i)), 16);
        ImGui::Dummy({0.7f * em, 1});
        ImGui::SameLine();
        ImGui::Checkbox("##shown", &run.shown);
        ui::record_last_item("Shown", true, run.shown);
        ui::tooltip("Draw this run in the view and on the timeline");
        ImGui::SameLine();
        const float room = ImGui::GetContentRegionAvail().x - (is_removable(run) ? 4.2f * em : 0.0f);
        const ImVec2 text = ImGui::GetCursorScreenPos();
        if (ImGui::Selectable("##tell", lab.explained() == i, 0, {room, ImGui::GetFrameHeight()}))
            lab.explain(i);
        ui::ellipsis({text.x + 0.2f * em, text.y + ImGui::GetStyle().FramePadding.y}, text.x + room,
                     ui::palette().text, run.name);
        ui::record_last_item("Tell", true, lab.explained() == i);
        settings_tooltip(run, lab.runs().front());
        if (is_removable(run)) {
            ImGui::SameLine();
            if (ui::icon_button(icons::check, "Use", "Use these settings in the level", false)) used = i;
            ImGui::SameLine(0, 0);
            if (ui::icon_button(icons::trash, "Remove", "Remove this ghost", false)) removed = i;
        }
        const auto& divergence = lab.divergence(i);
        if (i > 0) {
            ImGui::Indent(1.4f * em);
            if (!run.run.complete()) {
                ui::muted_text("Running…");
            } else if (!divergence) {
                ui::muted_text("Same as recorded, bit for bit");
            } else {
                ui::muted_text(fmt::format("Diverges at tick {}, by up to {}; {} at the end",
                                           divergence->first, distance_text(divergence->worst_m),
                                           distance_text(divergence->end_m))
                                   .c_str());
                if (ui::button("First difference", "Go to the first tick that differs, and look at it")) {
                    lab.motion = LabMotion::paused;
                    lab.seek(divergence->first);
                    lab.explain(i);
                    look_at_cursor(editor);
                }
                ui::flow(ui::button_width("Furthest apart"));
                if (ui::button("Furthest apart", "Go to the tick at which the two are furthest apart")) {
                    lab.motion = LabMotion::paused;
                    lab.seek(divergence->worst_tick);
                    lab.explain(i);
                    look_at_cursor(editor);
                }
            }
            ImGui::Unindent(1.4f * em);
        }
        ImGui::PopID();
    }
    if (used) {
        editor.document->set_movement(lab.runs()[*used].settings, "Use the ghost's settings");
        editor.status = "Now using the ghost's settings";
    }
    if (removed) lab.unpin(*removed);
}

// Both stories of the cursor's tick side by side, with the differences marked.
void side_by_side(Editor& editor) {
    Lab& lab = editor.lab;
    const std::size_t other = lab.explained() == 0 ? 1 : lab.explained();
    if (other >= lab.runs().size()) return;
    ui::heading("Side by side");
    const StoryNames names(editor.document->level());
    const auto& divergence = lab.divergence(other);
    if (!divergence) {
        ui::muted_text("The two runs are the same");
        return;
    }
    ui::muted_text(("The stories of " + tick_text(lab, lab.cursor())).c_str());
    const std::vector<StoryLine> stories[2] = {
        describe(lab.runs()[0].run.trace(lab.scene(*editor.document, lab.runs()[0]), lab.cursor()), names),
        describe(lab.runs()[other].run.trace(lab.scene(*editor.document, lab.runs()[other]), lab.cursor()),
                 names)};
    if (!ImGui::BeginTable("stories", 2, ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingStretchSame))
        return;
    ImGui::TableNextRow();
    for (const std::size_t index : {std::size_t{0}, other}) {
        ImGui::TableNextColumn();
        ImGui::TextColored(run_color(index), "%s", lab.runs()[index].name.c_str());
    }
    for (std::size_t i = 0; i < std::max(stories[0].size(), stories[1].size()); ++i) {
        const bool both = i < stories[0].size() && i < stories[1].size();
        const bool same =
            both && stories[0][i].title == stories[1][i].title && stories[0][i].text == stories[1][i].text;
        ImGui::TableNextRow();
        for (const std::vector<StoryLine>& story : stories) {
            ImGui::TableNextColumn();
            if (i >= story.size()) continue;
            ImGui::PushStyleColor(ImGuiCol_Text, same ? ui::palette().muted : ui::palette().text);
            ImGui::TextUnformatted(wrap_words(line_text(story[i]), ImGui::GetContentRegionAvail().x).c_str());
            ImGui::PopStyleColor();
        }
    }
    ImGui::EndTable();
}

void rates(Editor& editor) {
    Lab& lab = editor.lab;
    ui::heading("Rates");
    ui::checkbox("Run the route at other rates", &lab.show_rates,
                 "The same inputs at 30 to 360 ticks per second, drawn as ribbons");
    if (!lab.show_rates) return;
    const std::vector<RateRow>& rows = lab.rates(*editor.document);
    if (!ImGui::BeginTable("rates", 4, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg)) return;
    for (const char* name : {"Rate", "Worst", "At", "End"})
        ImGui::TableSetupColumn(name);
    ImGui::TableHeadersRow();
    double worst = 0.0;
    for (const RateRow& row : rows)
        worst = std::max(worst, row.worst_m);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const RateRow& row = rows[i];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextColored(run_color(i), "%d Hz", row.hz);
        ImGui::TableNextColumn();
        const bool bad = row.worst_m >= 0.01;
        ImGui::TextColored(bad ? ui::palette().bad : ui::palette().text, "%.1f mm", row.worst_m * 1000.0);
        ImGui::TableNextColumn();
        ImGui::TextColored(ui::palette().muted, "%.2f s", row.worst_time_s);
        ImGui::TableNextColumn();
        ImGui::Text("%.1f mm", row.end_m * 1000.0);
    }
    ImGui::EndTable();
    ui::muted_text(fmt::format("Worst deviation from the tape's own rate: {}", distance_text(worst)).c_str());
}

void presets(Editor& editor) {
    Lab& lab = editor.lab;
    ui::heading("Presets");
    ui::checkbox("Run the tape under every preset", &lab.show_presets,
                 "The same inputs under the settings of each preset, compared");
    if (!lab.show_presets) return;
    if (!ImGui::BeginTable("presets", 5, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg)) return;
    for (const char* name : {"Preset", "Distance", "Stops", "In air", "Falls"})
        ImGui::TableSetupColumn(name);
    ImGui::TableHeadersRow();
    for (const SummaryRow& row : lab.presets(*editor.document)) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(row.name.c_str());
        ImGui::TableNextColumn();
        ImGui::Text("%.1f m", row.summary.distance_m);
        ImGui::TableNextColumn();
        ImGui::TextColored(row.summary.stops > 0 ? ui::palette().bad : ui::palette().text, "%zu",
                           row.summary.stops);
        ImGui::TableNextColumn();
        ImGui::Text("%.1f s", row.summary.air_s);
        ImGui::TableNextColumn();
        ImGui::Text("%zu", row.summary.falls + row.summary.hazards);
    }
    ImGui::EndTable();
}

}  // namespace

void ghosts_panel(Editor& editor) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Ghosts");
    Lab& lab = editor.lab;
    if (!lab.has_tape() || editor.playtest) {
        ui::muted_text(
            "Run one tape under several settings: walk the level, change a setting, and see where the ghost "
            "with the same inputs diverges from the recorded run.");
        return;
    }
    run_rows(editor);
    if (ui::button("Add settings as a ghost", "Run the tape under the present settings as another ghost",
                   lab.runs().size() < Lab::max_runs))
        run_command(editor, "lab.pin");
    presets(editor);
    rates(editor);
    side_by_side(editor);
}

}  // namespace slipface
