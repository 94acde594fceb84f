#include "slipface/reach/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "roll_out.h"

namespace slipface {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_curve_points = 100;

Json vector_json(const Vec3& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

double seconds(std::uint32_t tick, const ReachSearch& search) {
    return tick * search.options().dt;
}

// What compare_reach needs of a report.
struct Compared {
    std::string fingerprint;
    std::map<FaceId, double> times;
    std::set<std::string> settings, goals;
    std::set<FaceId> traps;
};

Result<Compared> read_compared(std::string_view text, const std::string& location) {
    const Error no_report{location,
                          "found no report of a search, expected what `slipface reach --json` prints "
                          "or `--out` writes"};
    if (text.starts_with("slipface-reach ")) {
        const std::size_t first = std::min(text.find('\n'), text.size() - 1) + 1;
        text = text.substr(first, text.find('\n', first) - first);
    }
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object() || !json.contains("slipface_reach")) return no_report;
    Compared result;
    try {
        result.fingerprint = json.at("geometry").get<std::string>();
        const auto faces = json.at("reached_faces").get<std::vector<FaceId>>();
        const auto times = json.at("times_s").get<std::vector<double>>();
        if (faces.size() != times.size())
            return Error{location + ":/times_s", fmt::format("found {} times, expected {}: one for each of "
                                                             "reached_faces",
                                                             times.size(), faces.size())};
        for (std::size_t i = 0; i < faces.size(); ++i)
            result.times[faces[i]] = times[i];
        for (const Json& one : json.at("settings"))
            result.settings.insert(one.get<std::string>());
        for (const Json& one : json.at("goals"))
            if (one.at("reached").get<bool>()) result.goals.insert(one.at("name").get<std::string>());
        for (const Json& one : json.at("trap_faces"))
            result.traps.insert(one.get<FaceId>());
    } catch (const nlohmann::json::exception& error) {
        return Error{location, fmt::format("found a damaged report: {}", error.what())};
    }
    return result;
}

}  // namespace

ReachReport make_reach_report(const ReachSearch& search) {
    const Level& level = search.level();
    const ReachArchive& archive = search.archive();
    ReachReport report;
    report.level_name = level.mesh_path.filename().string();
    report.level_fingerprint = level.mesh->fingerprint;
    report.settings = setting_changes(basic_settings(), level.movement);
    report.start = search.start();
    report.seed = search.options().seed;
    report.face_count = level.mesh->face_count();
    report.walkable = walkable_faces(level);
    const std::vector<Reached>& faces = search.faces();
    for (FaceId face = 0; face < faces.size(); ++face)
        if (faces[face].found()) report.reached.push_back({face, seconds(faces[face].tick, search)});
    std::vector<bool> returns(faces.size());
    for (const ReachNode& node : archive.nodes)
        if (node.returns && is_held(node.state) && node.state.ground_face < faces.size())
            returns[node.state.ground_face] = true;
    for (const FaceId face : report.walkable)
        if (!faces[face].found()) report.unreached.push_back(face);
    for (const ReachReport::Face& one : report.reached)
        if (!returns[one.face]) report.traps.push_back(one.face);
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
    const std::size_t every = std::max<std::size_t>(1, report.rounds.size() / most_curve_points);
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

Result<ReachDifference> compare_reach(std::string_view a, const std::string& place_a, std::string_view b,
                                      const std::string& place_b) {
    const Result<Compared> first = read_compared(a, place_a), second = read_compared(b, place_b);
    if (!first) return first.error();
    if (!second) return second.error();
    if (first->fingerprint != second->fingerprint)
        return Error{place_b, fmt::format("found a search of the geometry {}, expected {} as in {}: faces "
                                          "have no names that outlive a change of the mesh",
                                          second->fingerprint, first->fingerprint, place_a)};
    ReachDifference difference;
    for (const auto& [face, time] : second->times) {
        const auto before = first->times.find(face);
        if (before == first->times.end())
            difference.gained.push_back(face);
        else if (time > 1.1 * before->second + 0.5)
            difference.slower.push_back({face, before->second, time});
    }
    for (const auto& [face, time] : first->times)
        if (!second->times.contains(face)) difference.lost.push_back(face);
    std::stable_sort(difference.slower.begin(), difference.slower.end(), [](const auto& x, const auto& y) {
        return x.after_s - x.before_s > y.after_s - y.before_s;
    });
    const auto only = [](const std::set<std::string>& in, const std::set<std::string>& out, const char* form,
                         std::vector<std::string>& to) {
        for (const std::string& one : in)
            if (!out.contains(one)) to.push_back(fmt::format(fmt::runtime(form), one));
    };
    only(second->settings, first->settings, "{}", difference.settings);
    only(first->settings, second->settings, "({})", difference.settings);
    only(second->goals, first->goals, "{}", difference.goals_gained);
    only(first->goals, second->goals, "{}", difference.goals_lost);
    for (const FaceId face : second->traps)
        if (!first->traps.contains(face)) difference.new_traps.push_back(face);
    return difference;
}

}  // namespace slipface
