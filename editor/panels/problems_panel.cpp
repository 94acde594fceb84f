// What the mesh doctor found: filter by kind, click to go there, fix what paint can fix.
#include <fmt/format.h>

#include "panels/panels.h"
#include "panels/property_rows.h"
#include "slipface/base/counted.h"
#include "tools/commands/icons.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

// The present number of orphans: the user can change it by hand.
std::size_t count_now(const Editor& editor, ProblemKind kind) {
    return kind == ProblemKind::orphan ? editor.document->level().orphans.size()
                                       : editor.session.report->count(kind);
}

std::size_t total_now(const Editor& editor) {
    std::size_t total = 0;
    for (const ProblemKindInfo& kind : problem_kinds())
        total += count_now(editor, kind.kind);
    return total;
}

bool hidden(const Editor& editor, ProblemKind kind) {
    return (editor.session.hidden_kinds >> static_cast<unsigned>(kind) & 1u) != 0;
}

void progress_row(Editor& editor) {
    const float scale = ui::scale();
    const float width = 90 * scale;
    ImGui::ProgressBar(static_cast<float>(editor.session.doctor->progress().fraction()),
                       {ImGui::GetContentRegionAvail().x - width - ImGui::GetStyle().ItemSpacing.x, 0},
                       "Examining");
    ImGui::SameLine();
    if (ui::button("Cancel", nullptr, true, {width, 0})) editor.session.doctor->cancel();
}

void head_row(Editor& editor) {
    if (ui::button(editor.session.report ? "\uf021  Examine again###Examine" : "\uf0f1  Examine###Examine",
                   "Find geometry that disturbs movement: gaps, thin and duplicate faces, sharp corners, "
                   "slopes at the limit; and missing textures"))
        examine_level(editor);
    if (!editor.session.report) return;
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    const std::size_t total = total_now(editor);
    ImGui::TextUnformatted(total == 0 ? "No problems" : counted(total, "problem").c_str());
    std::size_t untried = 0;
    for (const ProblemKindInfo& kind : problem_kinds())
        untried += editor.session.report->untried_of(kind.kind);
    if (untried > 0) {
        ImGui::SameLine();
        ui::muted_text(fmt::format("{} were not tried", counted(untried, "place")).c_str());
        ui::tooltip("There are too many places that could have a problem: the first were tried");
    }
    if (report_is_current(editor)) return;
    ImGui::SameLine();
    ImGui::TextColored(ui::palette().accent, "%s", icons::warning);
    ui::tooltip("Faces or types have changed since");
}

void filter_row(Editor& editor) {
    const ui::Scope scope("Filter");
    ui::Chips chips;
    for (const ProblemKindInfo& kind : problem_kinds())
        if (const std::size_t count = count_now(editor, kind.kind);
            count > 0 && chips.chip(kind.label, count, !hidden(editor, kind.kind)))
            editor.session.hidden_kinds ^= 1u << static_cast<unsigned>(kind.kind);
}

// A row that can be clicked. `wraps`: it is as high as its text needs, else what does not fit is in the
// tooltip alone.
bool row(const std::string& id, const std::string& name, const std::string& text, bool open,
         bool wraps = true) {
    const float left = 8 * ui::scale(), column = 86 * ui::scale();
    const float room = ImGui::GetContentRegionAvail().x - column;
    const float height =
        wraps ? ImGui::CalcTextSize(text.c_str(), nullptr, false, room).y : ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::Selectable(("##" + id).c_str(), open, 0, {0, height});
    ui::record_last_item(id, true, open);
    ui::tooltip(text.c_str());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText({at.x + left, at.y}, ui::packed(ui::palette().text), name.c_str());
    const ImVec2 value{at.x + column, at.y};
    if (wraps)
        list.AddText(nullptr, 0.0f, value, ui::packed(ui::palette().muted), text.c_str(), nullptr, room);
    else
        ui::ellipsis(value, value.x + room, ui::palette().muted, text);
    return pressed;
}

void open_row(Editor& editor, const Problem& problem) {
    ImGui::Indent(8 * ui::scale());
    ui::muted_text(info_of(problem.kind).remedy);
    symptom_button(editor, info_of(problem.kind).symptom);
    if (const std::string label = fix_label(editor, problem); !label.empty()) {
        if (ui::button((label + "###Fix").c_str(), "One step of history; the geometry does not change"))
            fix_problem(editor, problem);
        if (problem.kind == ProblemKind::orphan) ImGui::SameLine();
    }
    if (problem.kind == ProblemKind::orphan && editor.document->selection().empty())
        ui::muted_text("Select the faces that replace it, then attach it");
    if (problem.kind == ProblemKind::orphan &&
        ui::button("Delete###Drop (widget name stays)", "Delete this paint; undo restores it"))
        editor.document->drop_orphan(problem.index);
    ImGui::Unindent(8 * ui::scale());
    ImGui::Spacing();
}

void orphan_rows(Editor& editor) {
    const std::vector<Orphan> orphans = editor.document->level().orphans;
    for (std::size_t i = 0; i < orphans.size(); ++i) {
        Problem problem{ProblemKind::orphan,
                        no_id,
                        no_id,
                        orphans[i].key.centroid,
                        i,
                        orphans[i].type + ", material " +
                            (orphans[i].key.material.empty() ? "none" : orphans[i].key.material)};
        const bool open = editor.session.orphan == i;
        if (row(fmt::format("orphan {}", i), "Orphan", problem.text, open)) {
            editor.session.orphan = i;
            editor.session.problem.reset();
            go_to_position(editor, problem.position);
        }
        if (open) open_row(editor, problem);
    }
}

void problem_rows(Editor& editor, ProblemKind kind) {
    const DoctorReport& report = *editor.session.report;
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < report.problems.size(); ++i)
        if (report.problems[i].kind == kind) rows.push_back(i);
    std::optional<std::size_t> clicked;
    const bool wraps = rows.size() < 200;
    const bool has_open = editor.session.problem && report.problems[*editor.session.problem].kind == kind;
    // Rows of equal height can be skipped while they are not visible; the open one is higher.
    const auto draw = [&](std::size_t i) {
        const Problem& problem = report.problems[i];
        const bool open = editor.session.problem == i;
        const std::string name =
            problem.face == no_id ? std::string("Material") : fmt::format("Face {}", problem.face);
        if (row(fmt::format("{} {}", info_of(kind).name, i), name, problem.text, open, wraps)) clicked = i;
        if (open) open_row(editor, Problem(problem));
    };
    if (has_open || wraps) {
        for (const std::size_t i : rows)
            draw(i);
    } else {
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(rows.size()));
        while (clipper.Step())
            for (int at = clipper.DisplayStart; at < clipper.DisplayEnd; ++at)
                draw(rows[static_cast<std::size_t>(at)]);
    }
    if (report.count(kind) > rows.size())
        ui::muted_text(fmt::format("and {} more", report.count(kind) - rows.size()).c_str());
    if (clicked) {
        editor.session.orphan.reset();
        go_to_problem(editor, *clicked);
    }
}

}  // namespace

void problems_panel(Editor& editor) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Problems");
    if (editor.session.doctor)
        progress_row(editor);
    else
        head_row(editor);
    if (!editor.session.report) {
        ImGui::Spacing();
        ui::muted_text(
            "The doctor finds T-junctions, cracks, slivers, duplicate, overlapping and flipped faces, "
            "corners too sharp for the player, slopes and steps at the limit, orphans and missing textures");
        return;
    }
    ImGui::Spacing();
    filter_row(editor);
    for (const ProblemKindInfo& kind : problem_kinds()) {
        if (!editor.session.report || hidden(editor, kind.kind) || count_now(editor, kind.kind) == 0)
            continue;
        ui::heading(kind.label);
        ui::tooltip(kind.meaning);
        if (kind.kind == ProblemKind::orphan)
            orphan_rows(editor);
        else
            problem_rows(editor, kind.kind);
    }
}

}  // namespace slipface
