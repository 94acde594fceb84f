#include "slipface/reach/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <unordered_set>

#include "roll_out.h"

namespace slipface {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_curve_points = 100;

Json vector_json(const Vec3& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

double seconds(std::uint32_t tick, const ReachSearch& search) {
    return tick * search.options().dt;
}

constexpr std::uint32_t tried_visits = 24;  // walks in the main directions, and jumps at edges and walls

// From which cells that were hardly tried can be come to: [node] whether it may still turn out to return.
// Flights go on until they land, so cells in the air say nothing that those on the ground do not.
std::vector<bool> nodes_with_open_ends(const ReachArchive& archive) {
    std::unordered_set<std::uint64_t> tried;  // cells; never iterated
    for (const ReachNode& node : archive.nodes)
        if (node.visits >= tried_visits) tried.insert(node.cell);
    std::vector<bool> open(archive.nodes.size());
    std::vector<NodeId> next;
    for (NodeId node = 0; node < archive.nodes.size(); ++node) {
        const ReachNode& one = archive.nodes[node];
        if (is_held(one.state) && !one.returns && !tried.contains(one.cell)) next.push_back(node);
    }
    while (!next.empty()) {
        const NodeId node = next.back();
        next.pop_back();
        if (open[node] || archive.nodes[node].returns) continue;
        open[node] = true;
        if (archive.nodes[node].parent != no_id) next.push_back(archive.nodes[node].parent);
        for (std::uint32_t at = archive.first_edge[node]; at != no_id; at = archive.edges[at].next)
            next.push_back(archive.edges[at].from);
    }
    return open;
}

}  // namespace

ReachReport make_reach_report(const ReachSearch& search) {
    const Level& level = search.level();
    const ReachArchive& archive = search.archive();
    ReachReport report;
    report.level_name = level.mesh_path.filename().string();
    report.level_fingerprint = level.mesh.fingerprint();
    report.settings = setting_changes(basic_settings(), level.movement);
    report.start = search.start();
    report.seed = search.options().seed;
    report.face_count = level.mesh.face_count();
    report.walkable = walkable_faces(level);
    const std::vector<Reached>& faces = search.faces();
    for (FaceId face = 0; face < faces.size(); ++face)
        if (faces[face].found()) report.reached.push_back({face, seconds(faces[face].tick, search)});
    const std::vector<bool> open = nodes_with_open_ends(archive);
    std::vector<bool> returns(faces.size()), undecided(faces.size());
    for (NodeId node = 0; node < archive.nodes.size(); ++node) {
        const ReachNode& one = archive.nodes[node];
        if (!is_held(one.state) || one.state.ground_face >= faces.size()) continue;
        if (one.returns) returns[one.state.ground_face] = true;
        if (open[node]) undecided[one.state.ground_face] = true;
    }
    for (const FaceId face : report.walkable)
        if (!faces[face].found()) report.unreached.push_back(face);
    for (const ReachReport::Face& one : report.reached)
        if (!returns[one.face] && undecided[one.face])
            ++report.undecided;
        else if (!returns[one.face])
            report.traps.push_back(one.face);
    for (const ReachExit& exit : search.exits())
        report.exits.push_back({exit.from, exit.hole, exit.face, seconds(exit.tick, search), exit.times});
    std::stable_sort(report.exits.begin(), report.exits.end(),
                     [](const auto& a, const auto& b) { return a.times > b.times; });
    for (std::size_t i = 0; i < level.goals.size(); ++i) {
        if (!level.goals[i].from.empty()) continue;
        ReachReport::NamedGoal& goal = report.goals.emplace_back();
        goal.name = level.goals[i].name;
        if (search.goals()[i].found()) goal.time_s = seconds(search.goals()[i].tick, search);
    }
    report.cells = archive.cell_count();
    report.nodes = archive.nodes.size();
    report.bytes = archive.bytes();
    report.cell_m = search.cell_m();
    report.steps = search.steps();
    report.hash = search.hash();
    report.rounds = search.rounds();
    report.exhausted = search.exhausted();
    return report;
}

std::string reach_to_json(const ReachReport& report, bool indent) {
    Json json;
    json["slipface_reach"] = 1;
    json["level"] = report.level_name;
    json["geometry"] = fmt::format("{:016x}", report.level_fingerprint);
    json["settings"] = report.settings;
    json["start"] = vector_json(report.start);
    json["seed"] = report.seed;
    json["faces"] = report.face_count;
    json["walkable_faces"] = report.walkable.size();
    Json times = Json::array();
    json["reached_faces"] = Json::array();
    for (const ReachReport::Face& one : report.reached) {
        json["reached_faces"].push_back(one.face);
        times.push_back(one.time_s);
    }
    json["times_s"] = std::move(times);
    json["unreached_walkable_faces"] = report.unreached;
    json["trap_faces"] = report.traps;
    json["undecided_faces"] = report.undecided;
    json["exits"] = Json::array();
    for (const ReachReport::Exit& exit : report.exits) {
        Json one = {{"hole", vector_json(exit.hole)}, {"from", vector_json(exit.from)}};
        if (exit.face != no_id) one["face"] = exit.face;
        one["time_s"] = exit.time_s;
        one["times"] = exit.times;
        json["exits"].push_back(std::move(one));
    }
    json["goals"] = Json::array();
    for (const ReachReport::NamedGoal& goal : report.goals) {
        Json one = {{"name", goal.name}, {"reached", goal.time_s.has_value()}};
        if (goal.time_s) one["time_s"] = *goal.time_s;
        json["goals"].push_back(std::move(one));
    }
    json["steps"] = report.steps;
    json["rounds"] = report.rounds.size();
    json["cells"] = report.cells;
    json["cell_m"] = report.cell_m;
    json["exhausted"] = report.exhausted;
    json["curve"] = Json::array();  // [round, steps, cells, faces], all so far
    ReachRound sum;
    const std::size_t every = std::max<std::size_t>(1, report.rounds.size() / max_curve_points);
    for (std::size_t i = 0; i < report.rounds.size(); ++i) {
        sum.steps += report.rounds[i].steps;
        sum.cells += report.rounds[i].cells;
        sum.faces += report.rounds[i].faces;
        if ((i + 1) % every == 0 || i + 1 == report.rounds.size())
            json["curve"].push_back({i + 1, sum.steps, sum.cells, sum.faces});
    }
    json["hash"] = fmt::format("{:016x}", report.hash);
    return json.dump(indent ? 2 : -1, ' ', false, Json::error_handler_t::replace);
}

Result<ReachReport> parse_reach_report(std::string_view text, const std::string& position) {
    if (text.starts_with("slipface-reach ")) {
        const std::size_t first = std::min(text.find('\n'), text.size() - 1) + 1;
        text = text.substr(first, text.find('\n', first) - first);
    }
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object() || !json.contains("slipface_reach"))
        return Error{position,
                     "found no report of a search, expected what `slipface reach --json` prints or `--out` "
                     "writes"};
    ReachReport report;
    try {
        const auto geometry = json.at("geometry").get<std::string>();
        const auto [rest, error] =
            std::from_chars(geometry.data(), geometry.data() + geometry.size(), report.level_fingerprint, 16);
        const auto faces = json.at("reached_faces").get<std::vector<FaceId>>();
        const auto times = json.at("times_s").get<std::vector<double>>();
        if (error != std::errc() || rest != geometry.data() + geometry.size())
            return Error{position + ":/geometry", "found no fingerprint, expected 16 hexadecimal digits"};
        if (faces.size() != times.size())
            return Error{position + ":/times_s",
                         fmt::format("found {} times, expected {}: one for each of reached_faces",
                                     times.size(), faces.size())};
        for (std::size_t i = 0; i < faces.size(); ++i)
            report.reached.push_back({faces[i], times[i]});
        report.settings = json.at("settings").get<std::vector<std::string>>();
        report.traps = json.at("trap_faces").get<std::vector<FaceId>>();
        for (const Json& one : json.at("goals")) {
            ReachReport::NamedGoal& goal = report.goals.emplace_back();
            goal.name = one.at("name").get<std::string>();
            if (one.at("reached").get<bool>()) goal.time_s = one.at("time_s").get<double>();
        }
    } catch (const nlohmann::json::exception& error) {
        return Error{position, fmt::format("found a damaged report: {}", error.what())};
    }
    return report;
}

ReachDifference compare_reach(const ReachReport& a, const ReachReport& b) {
    ReachDifference difference;
    const auto times_of = [](const ReachReport& report) {
        std::map<FaceId, double> times;
        for (const ReachReport::Face& one : report.reached)
            times[one.face] = one.time_s;
        return times;
    };
    const std::map<FaceId, double> before = times_of(a), after = times_of(b);
    for (const auto& [face, time] : after) {
        const auto known = before.find(face);
        if (known == before.end())
            difference.gained.push_back(face);
        else if (time > 1.1 * known->second + 0.5)
            difference.slower.push_back({face, known->second, time});
    }
    for (const auto& [face, time] : before)
        if (!after.contains(face)) difference.lost.push_back(face);
    std::stable_sort(difference.slower.begin(), difference.slower.end(), [](const auto& x, const auto& y) {
        return x.after_s - x.before_s > y.after_s - y.before_s;
    });
    const auto goals_of = [](const ReachReport& report) {
        std::set<std::string> names;
        for (const ReachReport::NamedGoal& goal : report.goals)
            if (goal.time_s) names.insert(goal.name);
        return names;
    };
    const auto only = [](const auto& in, const auto& out, auto& to) {
        std::set_difference(in.begin(), in.end(), out.begin(), out.end(), std::back_inserter(to));
    };
    const std::set<std::string> goals_a = goals_of(a), goals_b = goals_of(b);
    only(goals_b, goals_a, difference.goals_gained);
    only(goals_a, goals_b, difference.goals_lost);
    const std::set<std::string> settings_a(a.settings.begin(), a.settings.end()),
        settings_b(b.settings.begin(), b.settings.end());
    only(settings_b, settings_a, difference.settings);
    std::vector<std::string> gone;
    only(settings_a, settings_b, gone);
    for (const std::string& one : gone)
        difference.settings.push_back("(" + one + ")");
    const std::set<FaceId> traps_a(a.traps.begin(), a.traps.end()), traps_b(b.traps.begin(), b.traps.end());
    only(traps_b, traps_a, difference.new_traps);
    return difference;
}

}  // namespace slipface
