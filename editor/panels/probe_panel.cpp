// The sweep probe in numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "panels/panels.h"
#include "panels/property_rows.h"
#include "tools/icons.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

std::string number(double value) {
    return fmt::format("{:.4g}", value + 0.0);
}

std::string vector_text(const Vec3& v) {
    // Adding 0 turns -0 into 0.
    return fmt::format("{:.3f} {:.3f} {:.3f}", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

void cell(const std::string& text, bool right = false) {
    ImGui::TableNextColumn();
    if (right) {
        const float spare = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, spare));
    }
    ImGui::TextUnformatted(text.c_str());
}

void table_row(const Document& document, std::size_t index, const ProbeRow& row) {
    const auto& contact = row.sweep.contact;
    const auto& surfaces = document.level().surfaces;
    ImGui::TableNextRow();
    cell(std::to_string(index + 1), true);
    cell(pass_name(row.sweep.pass));
    cell(contact ? number(contact->t) : "free", true);
    cell(contact ? std::to_string(contact->face) : "", true);
    cell(contact && contact->surface < surfaces.size() ? surfaces[contact->surface].name : "");
    cell(contact ? feature_name(contact->feature) : "");
    cell(contact ? vector_text(contact->normal) : "", true);
    cell(contact ? vector_text(contact->point) : "", true);
    cell(row.response ? number(row.response->leftover_before.norm()) + " → " +
                            number(row.response->leftover_after.norm())
                      : "",
         true);
    cell(row.response ? rule_name(row.response->rule) : "");
}

void sweep_table(const Document& document, const std::vector<ProbeRow>& rows) {
    struct Column {
        const char* name;
        const char* meaning;
    };
    static constexpr Column columns[] = {
        {"#", "The order of the sweeps"},
        {"Pass", "Why the sweep was made"},
        {"t", "Share of the displacement done at the touch"},
        {"Face", "The face that was touched first"},
        {"Surface", "That face's surface type"},
        {"Feature", "The part of the triangle that was touched"},
        {"Normal", "Of the contact plane, towards the ellipsoid's centre"},
        {"Point", "Where the triangle was touched, metres"},
        {"Leftover", "Length of the displacement that was left, before and after the response, metres"},
        {"Rule", "What turned the leftover"},
    };
    constexpr int count = static_cast<int>(std::size(columns));
    const float em = ImGui::GetFontSize();
    const float line = ImGui::GetTextLineHeight() + 2.0f * ImGui::GetStyle().CellPadding.y;
    const float height = line * static_cast<float>(std::min<std::size_t>(rows.size(), 10) + 1) +
                         ImGui::GetStyle().ScrollbarSize + 0.3f * em;
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                      ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV |
                                      ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings;
    if (!ImGui::BeginTable("sweeps", count, flags, {0.0f, height})) return;
    ImGui::TableSetupScrollFreeze(1, 1);
    for (const Column& column : columns)
        ImGui::TableSetupColumn(column.name);
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (int i = 0; i < count; ++i) {
        ImGui::TableSetColumnIndex(i);
        ImGui::TableHeader(columns[i].name);
        ui::tooltip(columns[i].meaning);
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
        table_row(document, i, rows[i]);
    ImGui::EndTable();
}

void vector_edit(const char* label, Vec3& vector, const char* tooltip) {
    constexpr double unseen = 0.0005;  // rounds to 0 with the three digits shown, and would read "-0.000"
    ImGui::TextUnformatted(label);
    Vec3 shown = vector;
    for (double& number : shown)
        if (std::abs(number) < unseen) number = 0.0;
    Vec3 changed = shown;
    const std::string id = std::string("##") + label;
    if (!ui::drag_vec3(id.c_str(), changed.data(), 0.02f, "%.3f", tooltip) || !changed.allFinite()) return;
    for (int axis = 0; axis < 3; ++axis)
        if (changed[axis] != shown[axis]) vector[axis] = changed[axis];
}

void outcome(const Probe& probe, const ProbeResult& result) {
    if (result.starts_overlapping) {
        ImGui::PushStyleColor(ImGuiCol_Text, ui::palette().bad);
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted("Starts inside the level: only moves that lead out are free");
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
    }
    fact("Asked", fmt::format("{:.4g} m", probe.move.norm()));
    fact("Moved", fmt::format("{:.4g} m", (result.slide.position - probe.from).norm()));
    fact("Leftover", fmt::format("{:.4g} m", result.slide.leftover.norm()));
    fact("Contacts", std::to_string(result.slide.contacts));
    fact("End", vector_text(result.slide.position));
}

void decisions(const ProbeResult& result) {
    ui::heading("Decisions");
    bool any = false;
    for (const TraceRecord& record : result.records) {
        if (std::holds_alternative<SweepRecord>(record)) continue;
        any = true;
        const std::string text = trace_text(record);
        ImGui::Bullet();
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted(text.data(), text.data() + text.size());
        ImGui::PopTextWrapPos();
    }
    if (!any) ui::muted_text("Nothing was in the way");
}

void place_at_spawn(Editor& editor) {
    editor.probe.placed = true;
    editor.probe.from = editor.document->level().spawn;
    if (editor.probe.move.isZero(0.0)) editor.probe.move = Vec3(0.0, -1.0, 0.0);
}

}  // namespace

void probe_panel(Editor& editor) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Probe");
    const Document& document = *editor.document;
    if (!editor.probe.placed) {
        ui::heading("Sweep probe");
        ui::muted_text(
            "With the probe tool, press on a face to place the player's ellipsoid, and drag to pull its "
            "displacement");
        ImGui::Spacing();
        if (ui::button("Use probe tool", "Click to place the ellipsoid, drag to sweep it"))
            run_command(editor, "tools.probe");
        ImGui::SameLine();
        if (ui::button("Place at spawn", "Put the ellipsoid where the player starts")) place_at_spawn(editor);
        return;
    }

    vector_edit("From", editor.probe.from, "Centre of the ellipsoid, metres");
    vector_edit("Move", editor.probe.move, "The displacement, metres");
    if (ui::button("Copy command line", "Put the command that repeats the first sweep on the clipboard")) {
        ImGui::SetClipboardText(
            probe_command_line(editor.probe, document.level().movement, document.level().mesh_path.string())
                .c_str());
        editor.status = "Command line copied";
    }
    ImGui::SameLine();
    const bool cleared = ui::button("Clear", "Take the probe out of the level");

    if (cleared) {
        run_command(editor, "tools.clear_probe");
        return;
    }
    if (editor.probe.move.isZero(0.0)) {
        ui::muted_text("Pull the displacement out of the ellipsoid with the mouse, or type it above");
        return;
    }
    const ProbeResult result = run_probe(editor.probe, document.scene(), document.level().movement);
    ui::heading("Result");
    outcome(editor.probe, result);
    ui::heading("Sweeps");
    sweep_table(document, probe_rows(result.records));
    decisions(result);
}

}  // namespace slipface
