// Random walkers in the level: run them, see where they lose speed and get stuck, open the findings.
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "panels/panels.h"
#include "panels/property_rows.h"
#include "panels/viewport_panel.h"
#include "slipface/base/counted.h"
#include "tools/commands/icons.h"
#include "tools/lab/audit_job.h"
#include "tools/lab/lab_actions.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

void start_row(Editor& editor) {
    static AuditSettings wanted;
    if (editor.audit) wanted = editor.audit->settings;
    double walkers = wanted.walkers, seed = wanted.seed;
    if (begin_property_rows("audit", label_width_of("Duration"))) {
        property_row("Walkers", "Number of walkers; each takes a random path", false);
        if (number_slider("Walkers", &walkers, 1, 2000, "", "Number of walkers; each takes a random path",
                          true))
            wanted.walkers = static_cast<int>(walkers);
        ImGui::TableNextColumn();
        property_row("Duration", "Simulated time of each walker", false);
        number_slider("Duration", &wanted.duration_s, 1, 600, "s", "Simulated time of each walker");
        ImGui::TableNextColumn();
        property_row("Seed", "Other seed: other paths. Same seed: same result", false);
        if (number_slider("Seed", &seed, 1, 1000, "", "Another seed gives other paths", true))
            wanted.seed = static_cast<int>(seed);
        ImGui::TableNextColumn();
        end_property_rows();
    }
    ui::checkbox("Start everywhere", &wanted.everywhere, "Start walkers everywhere the player can get");
    if (ui::button("Run audit", "Run the walkers in the background")) {
        editor.audit = AuditJob::start(*editor.document, wanted);
    }
    if (editor.audit) editor.audit->settings = wanted;
}

void progress(Editor& editor, FrameContext& frame) {
    const double fraction = editor.audit->progress();
    ImGui::ProgressBar(static_cast<float>(fraction), {-1.0f, 0.0f},
                       fmt::format("{:.0f} %", 100.0 * fraction).c_str());
    if (ui::button("Cancel", "Stop now and show the findings so far")) editor.audit->cancel();
    frame.animating = true;
}

void heat_rows(Editor& editor) {
    AuditJob& job = *editor.audit;
    ui::heading("Heat map");
    ui::checkbox("Show", &job.show_heat, "Colour the faces, from violet for a little to yellow for the most");
    int kind = static_cast<int>(job.kind);
    ImGui::SetNextItemWidth(-1.0f);
    if (ui::combo("##Kind", &kind, heat_names.data(), static_cast<int>(heat_names.size()),
                  info_of(static_cast<HeatKind>(kind)).meaning))
        job.kind = static_cast<HeatKind>(kind);
    if (job.kind == HeatKind::unreached) {
        std::size_t count = 0;
        for (const float fraction : job.heat(*editor.document, job.kind))
            count += fraction > 0.0f;
        ui::muted_text(counted(count, "face").c_str());
    } else {
        const float width = ImGui::GetContentRegionAvail().x;
        ImGui::Dummy(
            {width, draw_heat_bar(*ImGui::GetWindowDrawList(), ImGui::GetCursorScreenPos(), width, job)});
    }
    ui::muted_text(info_of(static_cast<HeatKind>(kind)).meaning);
}

void finding_rows(Editor& editor) {
    AuditJob& job = *editor.audit;
    const AuditReport& report = *job.report();
    ui::heading("Findings");
    if (report.findings.empty()) {
        ImGui::TextColored(ui::palette().good, "None");
        return;
    }
    const ui::Scope scope("Finding");
    std::optional<std::size_t> wanted;
    constexpr std::size_t maximum = 200;
    for (std::size_t i = 0; i < std::min(maximum, report.findings.size()); ++i) {
        const AuditFinding& finding = report.findings[i];
        ImGui::PushID(static_cast<int>(i));
        // The sentence takes as many lines as it needs.
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x;
        const float height = ImGui::CalcTextSize(finding.text.c_str(), nullptr, false, width).y;
        if (ImGui::Selectable("##finding", job.opened == i, 0, {width, height})) wanted = i;
        ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize(), at,
                                            ImGui::GetColorU32(ImGuiCol_Text), finding.text.c_str(), nullptr,
                                            width);
        ui::record_last_item(std::to_string(i + 1), true, job.opened == i);
        const FindingKindInfo& info = info_of(finding.kind);
        ui::tooltip(fmt::format("{}.\n\n{}.\n{}.\n\nClick to open the run at the tick before it",
                                finding.text, info.meaning, info.remedy)
                        .c_str());
        ImGui::PopID();
    }
    if (report.findings.size() > maximum)
        ui::muted_text(fmt::format("and {} more", report.findings.size() - maximum).c_str());
    if (wanted) open_finding(editor, *wanted);
}

// Where walkers left a level that is not closed; a click looks there.
void exit_rows(Editor& editor, const AuditReport& report) {
    if (report.exits.empty()) return;
    constexpr std::size_t most = 20;
    ui::heading(fmt::format("Left through openings, {}", counted(report.left, "time")).c_str());
    const ui::Scope scope("Exits");
    const std::vector<AuditExit> exits = busiest_first(report.exits);
    for (const AuditExit& exit : std::span(exits).first(std::min(exits.size(), most)))
        if (ui::selectable(sentence_case(exit_text(exit)).c_str(), false))
            go_to_position(editor, exit.position);
    if (exits.size() > most)
        ui::muted_text(fmt::format("and from {} more faces", exits.size() - most).c_str());
}

}  // namespace

void audit_panel(Editor& editor, FrameContext& frame) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Audit");
    if (editor.audit && editor.audit->running()) {
        progress(editor, frame);
        return;
    }
    start_row(editor);
    if (!editor.audit || editor.audit->running()) return;
    AuditJob& job = *editor.audit;
    if (!job.report()) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextColored(ui::palette().bad, "%s", job.problem().c_str());
        ImGui::PopTextWrapPos();
        return;
    }
    const AuditReport& report = *job.report();
    ui::heading("Result");
    float column = fact_column("Hazards");
    for (std::size_t i = 0; i < finding_kind_count; ++i)
        column = std::max(column, fact_column(info_of(static_cast<FindingKind>(i)).label));
    fact("Steps", std::to_string(report.steps), column);
    for (std::size_t i = 0; i < finding_kind_count; ++i)
        fact(info_of(static_cast<FindingKind>(i)).label, std::to_string(report.counts[i]), column);
    fact("Hazards", std::to_string(report.hazards), column);
    if (report.crushed > 0) fact("Crushed", std::to_string(report.crushed), column);
    if (report.falls > 0) fact("Falls", std::to_string(report.falls), column);
    if (report.untried > 0) fact("Steps untried", std::to_string(report.untried), column);
    if (report.cancelled) ui::muted_text("Cancelled before the end");
    if (!job.fits(*editor.document))
        ui::muted_text("The level was changed since; run it again for its heat map");
    else
        heat_rows(editor);
    finding_rows(editor);
    exit_rows(editor, report);
    if (ui::button("Clear", "Clear the heat map and the findings")) run_command(editor, "audit.clear");
}

}  // namespace slipface
