#include "tools/lab/reach_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "slipface/level/find_start.h"
#include "tools/editor.h"
#include "tools/lab/lab_actions.h"
#include "tools/target.h"

namespace slipface {

const char* meaning_of(ReachView view) {
    switch (view) {
        case ReachView::time: return "How long the fastest path found to each face takes";
        case ReachView::unreached: return "Walkable faces the search never reached";
        case ReachView::traps:
            return "Faces that were reached, but from which no way back to the start was found";
        case ReachView::gained: return "Faces reached now and not in the search before";
        case ReachView::lost: return "Faces reached in the search before and not now";
    }
    return "";
}

std::shared_ptr<ReachJob> ReachJob::start(const Document& document, const ReachSettings& settings,
                                          std::function<void()> wake, const ReachJob* before) {
    std::shared_ptr<ReachJob> job(new ReachJob);
    job->settings = settings;
    job->level_ = std::make_shared<Level>(document.level());
    job->face_revision_ = document.face_revision();
    job->spawns_ = all_spawns(document.level());
    if (before != nullptr) {
        job->view = before->view;
        job->show = before->show;
        // A search that was cut short says nothing of what was lost.
        if (before->level_->mesh == job->level_->mesh)
            job->before_ = before->cancelled_ ? before->before_ : before->report_;
    }
    job->work_ = std::make_unique<Background<Result<ReachSearch>>>(
        [level = job->level_, settings](Progress& progress) -> Result<ReachSearch> {
            const Result<Start> start = settle_start(*level);
            if (!start) return start.error();
            ReachOptions options;
            options.seed = static_cast<std::uint64_t>(std::max(settings.seed, 0));
            Result<ReachSearch> search = ReachSearch::begin(*level, start->position, options);
            if (!search) return search.error();
            ReachLimits limits;
            limits.seconds = std::clamp(settings.duration_s, 0.1, 3600.0);
            search->run(limits, &progress);
            return search;
        },
        std::move(wake));
    return job;
}

bool ReachJob::can_go_on(const Document& document) const {
    return search_ && fits(document) && fits_goals(document) &&
           search_->options().seed == static_cast<std::uint64_t>(settings.seed) && !search_->exhausted();
}

void ReachJob::go_on(std::function<void()> wake) {
    const auto search = std::make_shared<ReachSearch>(std::move(*search_));
    search_.reset();
    cancelled_ = false;
    heat_view_.reset();
    work_ = std::make_unique<Background<Result<ReachSearch>>>(
        [search, level = level_, duration = settings.duration_s](Progress& progress) -> Result<ReachSearch> {
            ReachLimits limits;
            limits.seconds = std::clamp(duration, 0.1, 3600.0);
            search->run(limits, &progress);
            return std::move(*search);
        },
        std::move(wake));
}

void ReachJob::cancel() {
    cancelled_ = true;
    work_->cancel();
}

void ReachJob::settle() {
    if (!work_ || !work_->ready() || search_ || !problem_.empty()) return;
    Result<ReachSearch> result = work_->take();
    if (!result) {
        problem_ = result.error().text();
        return;
    }
    search_.emplace(std::move(*result));
    report_ = make_reach_report(*search_);
    if (before_) difference_ = compare_reach(*before_, *report_);
    for (const ReachReport::Face& one : report_->reached)
        slowest_s_ = std::max(slowest_s_, one.time_s);
}

bool ReachJob::fits(const Document& document) const {
    const Level& now = document.level();
    return level_->mesh == now.mesh && face_revision_ == document.face_revision() &&
           level_->movement == now.movement && level_->platforms == now.platforms &&
           level_->fall_limit == now.fall_limit && spawns_ == all_spawns(now);
}

const std::vector<FaceId>& ReachJob::faces_of(ReachView of) const {
    static const std::vector<FaceId> none;
    if (!report_) return none;
    if (of == ReachView::unreached) return report_->unreached;
    if (of == ReachView::traps) return report_->traps;
    if (!difference_) return none;
    return of == ReachView::gained ? difference_->gained : of == ReachView::lost ? difference_->lost : none;
}

const std::vector<float>& ReachJob::heat() const {
    if (!report_ || heat_view_ == view) return heat_;
    heat_view_ = view;
    heat_.assign(report_->face_count, 0.0f);
    for (const FaceId face : faces_of(view))
        heat_[face] = 1.0f;
    if (view == ReachView::time && slowest_s_ > 0.0)
        for (const ReachReport::Face& one : report_->reached)
            heat_[one.face] = std::max(0.01f, static_cast<float>(std::sqrt(one.time_s / slowest_s_)));
    return heat_;
}

std::optional<ReachJob::Way> ReachJob::way_to(FaceId face) const {
    if (!search_ || face >= search_->faces().size()) return std::nullopt;
    const Reached& reached = search_->faces()[face];
    if (reached.found()) {
        if (std::optional<Tape> tape = search_->tape_to(reached.node))
            return Way{reached.tick * search_->options().dt, 0.0, std::move(*tape)};
    }
    std::optional<ReachSearch::Miss> miss = search_->nearest_miss_of_face(face);
    if (!miss) return std::nullopt;
    return Way{std::nullopt, miss->distance_m, std::move(miss->tape)};
}

Tape ReachJob::exit_motion(std::size_t exit) const {
    const ReachReport::Exit& wanted = report_->exits[exit];
    const std::vector<ReachExit>& exits = search_->exits();
    const auto found = std::find_if(exits.begin(), exits.end(), [&](const ReachExit& one) {
        return one.hole == wanted.hole && one.from == wanted.from;
    });
    return search_->tape_of(*found);
}

bool reach_runs(const Editor& editor) {
    return editor.reach && editor.reach->running();
}
bool reach_can_start(const Editor& editor) {
    return editor.document && !reach_runs(editor) && !editor.playtest;
}
bool has_reach(const Editor& editor) {
    return editor.reach && !editor.reach->running();
}
bool can_show_path(const Editor& editor) {
    return editor.document && has_reach(editor) && editor.reach->report() && !editor.playtest &&
           !editor.document->selection().empty();
}

void run_reach(Editor& editor) {
    ReachSettings settings;
    if (editor.reach) settings = editor.reach->settings;
    if (editor.reach && editor.reach->can_go_on(*editor.document))
        editor.reach->go_on(editor.session.wake);
    else
        editor.reach = ReachJob::start(*editor.document, settings, editor.session.wake, editor.reach.get());
    editor.layout.show(PanelId::reach);
}

void cancel_reach(Editor& editor) {
    editor.reach->cancel();
}

void clear_reach(Editor& editor) {
    editor.reach.reset();
}

namespace {

void open_in_lab(Editor& editor, const Tape& tape, const std::string& name) {
    const Status status = editor.lab.open(*editor.document, tape, name);
    if (!status) {
        editor.message = MessageDialog{"Cannot open the way", status.error().text(), {}};
        return;
    }
    complete_runs(editor);
    editor.lab.seek(editor.lab.ticks() > 0 ? editor.lab.ticks() - 1 : 0);
    show_lab(editor);
    look_at_cursor(editor);
    editor.status = name;
}

}  // namespace

void open_way(Editor& editor, FaceId face) {
    if (!editor.document || !has_reach(editor) || !editor.reach->report()) return;
    editor.reach->opened = face;
    const std::optional<ReachJob::Way> motion = editor.reach->way_to(face);
    if (!motion) {
        editor.status = fmt::format("Face {} was not reached, and nothing came near it", face);
        return;
    }
    open_in_lab(editor, motion->tape,
                motion->time_s ? fmt::format("Face {} reached after {:.2f} s", face, *motion->time_s)
                               : fmt::format("Face {} not reached: {:.2f} m short", face, motion->short_m));
}

void show_path(Editor& editor) {
    open_way(editor, editor.document->selection().front());
}

void open_exit(Editor& editor, std::size_t exit) {
    if (!has_reach(editor) || !editor.reach->report() || exit >= editor.reach->report()->exits.size()) return;
    const ReachReport::Exit& one = editor.reach->report()->exits[exit];
    open_in_lab(editor, editor.reach->exit_motion(exit),
                fmt::format("Out of the level after {:.2f} s", one.time_s));
}

void tick_reach(Editor& editor) {
    if (!editor.reach || !editor.document) return;
    ReachJob& job = *editor.reach;
    job.settle();
    const std::span<const FaceId> selected = editor.document->selection();
    if (job.settings.paths_by_click && job.report() && selected.size() == 1 &&
        job.opened != selected.front() && !editor.playtest)
        open_way(editor, selected.front());
    if (!job.settings.follow || editor.live_edit || editor.playtest || job.fits(*editor.document)) return;
    if (job.running())
        job.cancel();  // what it searches is no more; its result is not compared with
    else
        editor.reach = ReachJob::start(*editor.document, job.settings, editor.session.wake, &job);
}

namespace {

// Where a player stands on the target.
std::optional<Vec3> stand_on_target(Editor& editor) {
    const std::optional<FacePoint> target = target_or_say(editor);
    if (!target) return std::nullopt;
    return spawn_on(editor, *target).position;
}

}  // namespace

void add_goal(Editor& editor) {
    std::vector<Goal> goals = editor.document->level().goals;
    const std::optional<Vec3> stand = stand_on_target(editor);
    if (!stand || goals.size() >= max_goals) return;
    Goal goal;
    goal.position = *stand;
    for (std::size_t number = goals.size() + 1; goal.name.empty(); ++number) {
        const std::string name = fmt::format("Goal {}", number);
        if (goal_name_problem(*editor.document, goals.size(), name).empty()) goal.name = name;
    }
    editor.status = "Added " + goal.name;
    goals.push_back(goal);
    editor.document->set_goals(std::move(goals), "Add goal " + goal.name);
    editor.layout.show(PanelId::reach);
}

void move_goal(Editor& editor, std::size_t index) {
    const std::optional<Vec3> stand = stand_on_target(editor);
    if (!stand || index >= editor.document->level().goals.size()) return;
    Goal goal = editor.document->level().goals[index];
    goal.position = *stand;
    change_goal(editor, index, goal);
}

void change_goal(Editor& editor, std::size_t index, const Goal& goal) {
    std::vector<Goal> goals = editor.document->level().goals;
    if (index >= goals.size()) return;
    goals[index] = goal;
    editor.document->set_goals(std::move(goals), "Change goal " + goal.name);
}

void remove_goal(Editor& editor, std::size_t index) {
    std::vector<Goal> goals = editor.document->level().goals;
    if (index >= goals.size()) return;
    const std::string name = goals[index].name;
    goals.erase(goals.begin() + static_cast<std::ptrdiff_t>(index));
    editor.document->set_goals(std::move(goals), "Delete goal " + name);
    editor.status = "Deleted " + name;
}

std::string goal_name_problem(const Document& document, std::size_t index, const std::string& name) {
    if (name.empty()) return "A goal needs a name";
    const std::vector<Goal>& goals = document.level().goals;
    for (std::size_t i = 0; i < goals.size(); ++i)
        if (i != index && goals[i].name == name) return "Another goal has this name";
    return {};
}

Result<std::vector<std::string>> goal_settings(const std::string& text) {
    std::vector<std::string> settings;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        MovementSettings movement;
        if (const Status status = set_setting(movement, word); !status) return status.error();
        settings.push_back(word);
    }
    return settings;
}

std::string goal_state(const Editor& editor, std::size_t index) {
    const Goal& goal = editor.document->level().goals[index];
    // The panel searches from the spawn under the level's own settings.
    if (!goal.from.empty() || !goal.settings.empty()) return "by reach --check";
    if (!editor.reach || !editor.reach->report() || !editor.reach->fits(*editor.document) ||
        !editor.reach->fits_goals(*editor.document))
        return {};
    for (const ReachReport::NamedGoal& one : editor.reach->report()->goals) {
        if (one.name != goal.name) continue;
        if (!one.time_s) return goal.kind == GoalKind::never ? "holds" : "not reached";
        const bool late = goal.within_s && *one.time_s > *goal.within_s;
        return fmt::format("{:.1f} s{}", *one.time_s,
                           goal.kind == GoalKind::never ? ", broken"
                           : late                       ? ", too late"
                                                        : "");
    }
    return {};
}

}  // namespace slipface
