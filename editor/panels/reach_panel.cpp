// Where the player can get: search, colours, what was never reached, the paths, and the level's goals.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "panels/named_rows.h"
#include "panels/panels.h"
#include "panels/property_rows.h"
#include "panels/viewport_panel.h"
#include "slipface/base/counted.h"
#include "tools/lab/reach_job.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr std::size_t max_rows = 200;

void start_rows(Editor& editor) {
    static ReachSettings wanted;
    if (editor.reach) wanted = editor.reach->settings;
    double seed = wanted.seed;
    const char* const duration = "How long it searches; small levels are done in a few seconds";
    if (begin_property_rows("reach", label_width_of("Duration"))) {
        property_row("Duration", duration, false);
        number_slider("Duration", &wanted.duration_s, 1, 600, "s", duration);
        ImGui::TableNextColumn();
        property_row("Seed", "Another seed, other inputs", false);
        if (number_slider("Seed", &seed, 1, 1000, "", "Another seed, other inputs", true))
            wanted.seed = static_cast<int>(seed);
        ImGui::TableNextColumn();
        end_property_rows();
    }
    ui::checkbox(
        "Follow changes", &wanted.follow,
        "Search again whenever a setting, a type or a painted face changes, and show what was gained "
        "and lost");
    ui::checkbox("Paths by click", &wanted.paths_by_click,
                 "Selecting a face opens the fastest path to it, or the attempt that came nearest");
    if (editor.reach) editor.reach->settings = wanted;
    const bool on = editor.reach && editor.reach->can_go_on(*editor.document);
    const bool searches =
        ui::button(on ? "Search on" : "Search",
                   on ? "Go on with the search from where it stands"
                      : "Search from the spawn for all that the player can reach; work on meanwhile");
    if (!searches) return;
    if (!editor.reach) {
        editor.reach = ReachJob::start(*editor.document, wanted, editor.session.wake, nullptr);
        return;
    }
    run_reach(editor);
}

void progress(Editor& editor, FrameContext& frame) {
    const double fraction = editor.reach->progress();
    ImGui::ProgressBar(static_cast<float>(fraction), {-1.0f, 0.0f},
                       fmt::format("{:.0f} %", 100.0 * fraction).c_str());
    if (ui::button("Cancel", "End it now; what it found until then is shown")) editor.reach->cancel();
    frame.animating = true;
}

void result_rows(const ReachReport& report) {
    ui::heading("Result");
    const std::size_t reached = report.walkable.size() - report.unreached.size();
    fact("Walkable faces", fmt::format("{} of {} reached", reached, report.walkable.size()));
    fact("No way back", counted(report.traps.size(), "face"));
    if (report.undecided > 0) fact("Not yet known", "of " + counted(report.undecided, "face"));
    fact("Exits", std::to_string(report.exits.size()));
    fact("Steps", fmt::format("{} in {} rounds", report.steps, report.rounds.size()));
    // A search that still finds something is not done.
    std::uint64_t late = 0;
    const std::size_t tenth = std::min(report.rounds.size(), report.rounds.size() / 10 + 1);
    for (std::size_t i = report.rounds.size() - tenth; i < report.rounds.size(); ++i)
        late += report.rounds[i].faces;
    ui::muted_text(report.exhausted ? "Nothing was left to try"
                   : late == 0      ? "The last tenth of the search found no new face"
                                    : fmt::format("The last tenth of the search found {} new faces: a longer "
                                                       "one finds more",
                                                  late)
                                     .c_str());
}

void face_rows(Editor& editor, const std::vector<FaceId>& faces) {
    const ui::Scope scope("Face");
    for (std::size_t i = 0; i < std::min(max_rows, faces.size()); ++i) {
        const std::string text = fmt::format("Face {}", faces[i]);
        if (ui::selectable(text.c_str(), editor.reach->opened == faces[i])) {
            editor.document->select({faces[i]});
            open_way(editor, faces[i]);
        }
        ui::tooltip("Open the way there as a tape, or the attempt that came nearest");
    }
    if (faces.empty()) ui::muted_text("None");
    if (faces.size() > max_rows) ui::muted_text(fmt::format("and {} more", faces.size() - max_rows).c_str());
}

void map_rows(Editor& editor) {
    ReachJob& job = *editor.reach;
    ui::heading("Map");
    ui::checkbox("Show", &job.show,
                 "Colour the faces in the view; crosses mark where players leave the level");
    int view = static_cast<int>(job.view);
    if (ui::combo("##View", &view, reach_view_names.data(), static_cast<int>(reach_view_names.size()),
                  meaning_of(static_cast<ReachView>(view))))
        job.view = static_cast<ReachView>(view);
    ui::muted_text(meaning_of(job.view));
    if (job.view == ReachView::time) {
        const float width = ImGui::GetContentRegionAvail().x;
        ImGui::Dummy(
            {width, draw_heat_bar(*ImGui::GetWindowDrawList(), ImGui::GetCursorScreenPos(), width, job)});
        return;
    }
    if (!job.difference() && (job.view == ReachView::gained || job.view == ReachView::lost))
        return ui::muted_text("There is no search before this one to compare with");
    face_rows(editor, job.faces_of(job.view));
}

void exit_rows(Editor& editor) {
    const std::vector<ReachReport::Exit>& exits = editor.reach->report()->exits;
    if (exits.empty()) return;
    ui::heading("Exits");
    const ui::Scope scope("Exit");
    for (std::size_t i = 0; i < std::min<std::size_t>(20, exits.size()); ++i) {
        const std::string text = fmt::format("{:.1f}, {:.1f}, {:.1f} m after {:.1f} s##{}", exits[i].hole.x(),
                                             exits[i].hole.y(), exits[i].hole.z(), exits[i].time_s, i);
        if (ui::selectable(text.c_str(), false)) open_exit(editor, i);
        ui::tooltip("Players leave the level here. Opens the way out as a tape");
    }
}

// Kind and limit of the goal under its name.
void goal_rows(Editor& editor, std::size_t index) {
    Goal goal = editor.document->level().goals[index];
    const ui::Scope scope(goal.name);
    ImGui::PushID(static_cast<int>(index));
    int kind = static_cast<int>(goal.kind);
    if (ui::combo("##Kind", &kind, goal_kind_names.data(), static_cast<int>(goal_kind_names.size()),
                  "Must be reached, or must never be")) {
        goal.kind = static_cast<GoalKind>(kind);
        if (goal.kind == GoalKind::never) goal.within_s.reset();
        change_goal(editor, index, goal);
    }
    if (goal.kind == GoalKind::reach) {
        double within = goal.within_s.value_or(0.0);
        if (ui::slider("##Within", &within, 0.0, 120.0, within > 0.0 ? "within %.0f s" : "any time",
                       "It must not take longer; 0: it may take any time")) {
            live_edit(editor, "Change goal " + goal.name);
            goal.within_s = within > 0.0 ? std::optional(within) : std::nullopt;
            change_goal(editor, index, goal);
        }
    }
    std::string settings = fmt::format("{}", fmt::join(goal.settings, " "));
    if (ui::input_text("##Settings", &settings, "settings: dash=off")) {
        if (Result<std::vector<std::string>> read = goal_settings(settings)) {
            live_edit(editor, "Change goal " + goal.name);
            goal.settings = std::move(*read);
            change_goal(editor, index, goal);
        } else {
            editor.status = read.error().message;  // while it is typed
        }
    }
    ui::tooltip(
        "Settings that are different for this goal, as for --set: whether it is reached without an ability");
    ImGui::PopID();
}

void goals_section(Editor& editor) {
    ui::heading("Goals");
    if (ui::button("Add goal", "Put a goal on a selected face, or on the face in the middle of the view"))
        add_goal(editor);
    const ui::Scope scope("Goal");
    for (std::size_t i = 0; i < editor.document->level().goals.size(); ++i) {
        const Goal goal = editor.document->level().goals[i];
        NamedRow row;
        row.name = goal.name;
        row.detail = goal_state(editor, i);
        row.tooltip = "Look there; a double click renames it";
        row.replace_tooltip = "Move it to a selected face, or to the one in the middle of the view";
        const NamedRowResult did = named_row(
            i, row, [&](const std::string& name) { return goal_name_problem(*editor.document, i, name); });
        if (!did.renamed.empty()) {
            Goal renamed = goal;
            renamed.name = did.renamed;
            return change_goal(editor, i, renamed);
        }
        if (did.remove) return remove_goal(editor, i);
        if (did.replace) return move_goal(editor, i);
        if (did.chosen) go_to_position(editor, goal.position);
        goal_rows(editor, i);
    }
}

}  // namespace

void reach_panel(Editor& editor, FrameContext& frame) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Reach");
    if (reach_runs(editor)) {
        progress(editor, frame);
    } else {
        start_rows(editor);
    }
    if (has_reach(editor)) {
        ReachJob& job = *editor.reach;
        if (job.report() == nullptr) {
            ImGui::PushTextWrapPos(0.0f);
            ImGui::TextColored(ui::palette().bad, "%s", job.problem().c_str());
            ImGui::PopTextWrapPos();
        } else {
            result_rows(*job.report());
            if (!job.fits(*editor.document)) {
                ui::muted_text("The level was changed since; search again for its map");
            } else {
                map_rows(editor);
                exit_rows(editor);
            }
            if (ui::button("Clear", "Take the colours and the lists away"))
                run_command(editor, "reach.clear");
        }
    }
    goals_section(editor);
}

}  // namespace slipface
