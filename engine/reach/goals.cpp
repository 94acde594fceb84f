#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "slipface/level/find_start.h"
#include "slipface/reach/report.h"

namespace slipface {
namespace {

// A spawn's position, else another goal's; an error for a name that is neither.
Result<Vec3> start_named(const Level& level, const Goal& goal) {
    for (const Spawn& spawn : all_spawns(level))
        if (spawn.name == goal.from) return spawn.position;
    for (const Goal& other : level.goals)
        if (other.name == goal.from) return other.position;
    return Error{fmt::format("goal \"{}\"", goal.name),
                 fmt::format("found from \"{}\", expected the name of a spawn or of a goal", goal.from)};
}

GoalAnswer answer(const ReachSearch& search, std::size_t index) {
    const Level& level = search.level();
    const Goal& goal = level.goals[index];
    const Reached& reached = search.goals()[index];
    GoalAnswer answer;
    answer.goal = index;
    const std::string effort = fmt::format("{} steps in {} rounds{}", search.steps(), search.rounds().size(),
                                           search.exhausted() ? ", and nothing was left to try" : "");
    const std::string name =
        goal.settings.empty() ? goal.name : fmt::format("{} ({})", goal.name, fmt::join(goal.settings, ", "));
    if (reached.found()) answer.tape = search.tape_to(reached.node);
    if (answer.tape) {
        answer.time_s = reached.tick * search.options().dt;
        if (goal.within_s && *answer.time_s > *goal.within_s)
            if (std::optional<Tape> shorter = search.hurried_tape_to(index)) {
                answer.time_s = static_cast<double>(shorter->tick_count()) * shorter->dt;
                answer.tape = std::move(shorter);
            }
        const FaceId face = search.archive().nodes[reached.node].state.ground_face;
        const bool late = goal.within_s && *answer.time_s > *goal.within_s;
        answer.holds = goal.kind == GoalKind::reach && !late;
        answer.text = fmt::format("{}: reached after {:.2f} s", name, *answer.time_s);
        if (late) answer.text += fmt::format(", expected within {} s; {}", *goal.within_s, effort);
        if (goal.kind == GoalKind::never) {
            answer.text += ", expected never";
            if (face != no_id) answer.text += fmt::format("; over face {}", face);
        }
        return answer;
    }
    answer.holds = goal.kind == GoalKind::never;
    answer.text = fmt::format("{}: not reached after {}", name, effort);
    if (answer.holds) return answer;
    if (auto miss = search.nearest_miss_of_point(goal.position, goal.radius)) {
        answer.text += fmt::format("; {:.2f} m short", miss->distance_m);
        if (miss->from != no_id) answer.text += fmt::format(", last on face {}", miss->from);
        answer.tape = std::move(miss->tape);
    }
    return answer;
}

}  // namespace

Result<std::vector<GoalAnswer>> check_goals(const Level& level, const Vec3& start,
                                            const ReachOptions& options, const ReachLimits& limits,
                                            Progress* progress) {
    // One search for all goals that begin alike.
    std::map<std::pair<std::string, std::vector<std::string>>, std::vector<std::size_t>> alike;
    for (std::size_t i = 0; i < level.goals.size(); ++i)
        alike[{level.goals[i].from, level.goals[i].settings}].push_back(i);
    std::vector<GoalAnswer> answers;
    for (const auto& [begins, goals] : alike) {
        const auto& [name, settings] = begins;
        Level own = level;
        for (const std::string& setting : settings)
            if (const Status status = set_setting(own.movement, setting); !status)
                return Error{fmt::format("goal \"{}\"", level.goals[goals.front()].name),
                             status.error().message};
        own.goals.clear();
        for (const std::size_t goal : goals)
            own.goals.push_back(level.goals[goal]);
        Vec3 begin = start;
        if (!name.empty()) {
            const Result<Vec3> named = start_named(level, own.goals.front());
            if (!named) return named.error();
            begin = *named;
        }
        Result<ReachSearch> search = ReachSearch::begin(own, begin, options);
        if (!search) return search.error();
        ReachLimits until = limits;
        until.until_goals = true;
        std::vector<GoalAnswer> own_answers;
        // What is found a little late may be hurried; only if it is still late the search goes on.
        for (const double late : {1.1, 1.0}) {
            until.late = late;
            search->run(until, progress);
            own_answers.clear();
            for (std::size_t i = 0; i < goals.size(); ++i)
                own_answers.push_back(answer(*search, i));
            const auto breaks = [](const GoalAnswer& one) { return !one.holds; };
            if (!std::ranges::any_of(own_answers, breaks) || !search->goals_reached(late)) break;
        }
        for (std::size_t i = 0; i < goals.size(); ++i)
            answers.emplace_back(std::move(own_answers[i])).goal = goals[i];
    }
    std::sort(answers.begin(), answers.end(),
              [](const GoalAnswer& a, const GoalAnswer& b) { return a.goal < b.goal; });
    return answers;
}

}  // namespace slipface
