// The sweep probe in numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "panels/lab_track.h"
#include "panels/panels.h"
#include "panels/property_rows.h"
#include "slipface/level/find_start.h"
#include "slipface/render/trace_overlay.h"
#include "slipface/sim/story.h"
#include "tools/commands/icons.h"
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

// A line of any length.
void line(const std::string& text, const char* tooltip) {
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ui::tooltip(tooltip);
}

std::string hit_text(const Contact& contact, const std::vector<SurfaceType>& surfaces) {
    return fmt::format("{}, face {}, {}", feature_name(contact.feature), contact.face,
                       contact.surface < surfaces.size() ? surfaces[contact.surface].name : "unknown type");
}

// Each sweep with its number at the left: what it hit, where, and the response.
void sweep_rows(Editor& editor, const std::vector<ProbeRow>& rows) {
    const std::vector<SurfaceType>& surfaces = editor.document->level().surfaces;
    const std::size_t shown = std::min(editor.probe.shown_sweeps.value_or(rows.size()), rows.size());
    const float number_width = ImGui::CalcTextSize("00").x + ImGui::GetFontSize();
    const ui::Scope scope("Sweep");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const ProbeRow& row = rows[i];
        const auto& contact = row.sweep.contact;
        ImGui::PushStyleVar(ImGuiStyleVar_Alpha, ImGui::GetStyle().Alpha * (i >= shown ? 0.4f : 1.0f));
        const Color color = sweep_color(static_cast<int>(i));
        ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(color.red, color.green, color.blue, 1.0f));
        const std::string number_text = std::to_string(i + 1);
        const float left = ImGui::GetCursorPosX();
        if (ImGui::Selectable(number_text.c_str(), shown == i + 1, 0,
                              {number_width - 0.5f * ImGui::GetFontSize(), 0}))
            editor.probe.shown_sweeps = i + 1;
        ui::record_last_item(number_text, true, shown == i + 1);
        ImGui::PopStyleColor();
        ui::tooltip("Sweep number, in the colour of its ghost; click to show the sweeps up to it");
        ImGui::SameLine(left + number_width);
        ImGui::BeginGroup();
        line(contact ? hit_text(*contact, surfaces) : "nothing hit",
             "Feature, face and surface type of the first contact");
        ImGui::PushStyleColor(ImGuiCol_Text, ui::palette().muted);
        if (contact)
            line(fmt::format("t {:.3f}, normal {:.2f} {:.2f} {:.2f}", contact->t, contact->normal.x() + 0.0,
                             contact->normal.y() + 0.0, contact->normal.z() + 0.0),
                 "t: fraction of the displacement before the contact; normal of the contact plane, towards "
                 "the ellipsoid's centre");
        std::string outcome = pass_name(row.sweep.pass);
        if (row.response)
            outcome += fmt::format(", {}: {} \u2192 {} m left", rule_name(row.response->rule),
                                   number(row.response->remainder_before.norm()),
                                   number(row.response->remainder_after.norm()));
        line(outcome, "Pass, rule, and length of the remainder before and after it");
        ImGui::PopStyleColor();
        ui::end(ImGui::EndGroup);
        ImGui::PopStyleVar();
    }
}

void step_buttons(Editor& editor, std::size_t count) {
    std::optional<std::size_t>& shown = editor.probe.shown_sweeps;
    const std::size_t now = std::min(shown.value_or(count), count);
    if (ui::icon_button(icons::step_back, "Previous sweep", "Show one sweep fewer", false, now > 0))
        shown = now - 1;
    ImGui::SameLine(0, 3 * ui::scale());
    if (ui::icon_button(icons::step_forward, "Next sweep", "Show one sweep more", false, now < count))
        shown = now + 1;
    ImGui::SameLine(0, 3 * ui::scale());
    if (ui::icon_button(icons::to_end, "All sweeps", "Show every sweep", !shown, shown.has_value()))
        shown.reset();
    ImGui::SameLine();
    // In the middle of the buttons, which are higher than a line.
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() +
                         0.5f * (ui::icon_button_side() - ImGui::GetTextLineHeight()));
    ui::muted_text(fmt::format("{} of {} sweeps shown", now, count).c_str());
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
        ImGui::TextUnformatted("Starts inside geometry: it can only move out");
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
    }
    fact("Requested", fmt::format("{:.4g} m", probe.move.norm()));
    fact("Moved", fmt::format("{:.4g} m", (result.slide.position - probe.from).norm()));
    fact("Remainder", fmt::format("{:.4g} m", result.slide.remainder.norm()));
    fact("Contacts", std::to_string(result.slide.contacts));
    fact("End", vector_text(result.slide.position));
}

void story(const Editor& editor, std::span<const TraceRecord> records) {
    ui::heading("Story");
    for (const StoryLine& line :
         describe(records, editor.document->level(), editor.document->level().movement)) {
        const float indent = 0.9f * ImGui::GetFontSize() * static_cast<float>(line.depth);
        if (indent > 0.0f) ImGui::Indent(indent);
        ImGui::PushStyleColor(ImGuiCol_Text, line.tone == StoryTone::trouble   ? ui::palette().bad
                                             : line.tone == StoryTone::refused ? ui::palette().muted
                                                                               : ui::palette().text);
        ImGui::TextUnformatted(wrap_words(line_text(line), ImGui::GetContentRegionAvail().x).c_str());
        ImGui::PopStyleColor();
        if (indent > 0.0f) ImGui::Unindent(indent);
    }
}

void place_at_spawn(Editor& editor) {
    editor.probe.placed = true;
    const TickScene scene = editor.lab.scene(*editor.document);
    const Level& level = editor.document->level();
    const Result<Start> start = find_start(level, scene.at(0, 0.0), scene.offset(), level.movement);
    editor.probe.from = start ? start->position : level.spawn;
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
            "With the probe tool, press on a face to place the player's ellipsoid, and drag to set its "
            "displacement");
        ImGui::Spacing();
        if (ui::button("Use probe tool", "Click to place the ellipsoid, drag to sweep it"))
            run_command(editor, "tools.probe");
        ui::flow(ui::button_width("Place at spawn"));
        if (ui::button("Place at spawn", "Place the ellipsoid at the spawn point")) place_at_spawn(editor);
        return;
    }

    vector_edit("From", editor.probe.from, "Centre of the ellipsoid, metres");
    vector_edit("Move", editor.probe.move, "The displacement, metres");
    if (ui::button("Copy command", "Copy the command line that repeats the first sweep"))
        run_command(editor, "tools.copy_probe_command");
    ui::flow(ui::button_width("Copy as a test"));
    if (ui::button("Copy as a test",
                   "Copy a test for slipface sweep LEVEL --test FILE: every sweep with its contact and rule"))
        run_command(editor, "tools.copy_probe_test");
    ui::flow(ui::button_width("Clear"));
    const bool cleared = ui::button("Clear", "Remove the probe");

    if (cleared) {
        run_command(editor, "tools.clear_probe");
        return;
    }
    if (editor.probe.move.isZero(0.0)) {
        ui::muted_text("Drag the displacement out of the ellipsoid with the mouse, or type it above");
        return;
    }
    const ProbeResult result = run_probe(editor.probe, document.scene(), document.level().movement);
    ui::heading("Result");
    outcome(editor.probe, result);
    ui::heading("Sweeps");
    const std::vector<ProbeRow> rows = probe_rows(result.records);
    step_buttons(editor, rows.size());
    sweep_rows(editor, rows);
    story(editor, first_sweeps(result.records, editor.probe.shown_sweeps.value_or(rows.size())));
}

}  // namespace slipface
