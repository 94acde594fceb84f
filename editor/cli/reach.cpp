#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>

#include "cli/format.h"
#include "cli/guarded.h"
#include "cli/play.h"
#include "cli/verbs.h"
#include "slipface/base/counted.h"
#include "slipface/base/files.h"
#include "slipface/base/system.h"
#include "slipface/base/text.h"
#include "slipface/exchange/export.h"
#include "slipface/reach/links.h"
#include "slipface/reach/report.h"

namespace slipface::cli {
namespace {

struct ReachWords : PlayWords {
    std::string out, resume, checkpoint, how, tape, tapes, links, before;
    double seconds = 0.0, cell = 0.0;
    std::uint64_t rounds = 0, every = 20;
    bool json = false, check = false;
};

constexpr double usual_seconds = 20.0;
constexpr double check_seconds = 60.0;

int bad_input(const Error& error) {
    print_error(std::cerr, error);
    return exit_bad_input;
}

std::string faces_text(const std::vector<FaceId>& faces) {
    constexpr std::size_t maximum = 12;
    std::string text = fmt::format("{}", faces.size());
    for (std::size_t i = 0; i < std::min(maximum, faces.size()); ++i)
        text += fmt::format("{}{}", i == 0 ? ": " : ", ", faces[i]);
    if (faces.size() > maximum) text += ", ...";
    return text;
}

void print_report(const ReachReport& report, double seconds, std::uint64_t steps_before) {
    std::ostream& out = std::cout;
    print_row(out, "level", report.level_name);
    print_row(out, "steps",
              fmt::format("{} in {} rounds, seed {}{}", report.steps, report.rounds.size(), report.seed,
                          report.exhausted ? "; nothing is left to try" : ""));
    if (seconds > 0.0 && report.steps > steps_before)
        print_row(out, "rate",
                  fmt::format("{:.0f} steps a second", double(report.steps - steps_before) / seconds));
    print_row(out, "cells",
              fmt::format("{} of {:.2f} m, {}", report.cells, report.cell_m, bytes_text(report.bytes)));
    print_row(out, "reached",
              fmt::format("{}, {} of {} walkable ones", counted(report.reached.size(), "face"),
                          report.walkable.size() - report.unreached.size(), report.walkable.size()));
    print_row(out, "unreached", faces_text(report.unreached));
    print_row(out, "traps",
              faces_text(report.traps) +
                  (report.undecided > 0 ? fmt::format("; {} not known yet", report.undecided) : ""));
    print_row(out, "exits", fmt::format("{}", report.exits.size()));
    constexpr std::size_t max_exits = 8;
    for (std::size_t i = 0; i < std::min(max_exits, report.exits.size()); ++i) {
        const ReachReport::Exit& exit = report.exits[i];
        const std::string face = exit.face == no_id ? "" : fmt::format(", from face {}", exit.face);
        out << fmt::format("    {}  m{}, {} times, first after {:.2f} s\n", vector_text(exit.hole), face,
                           exit.times, exit.time_s);
    }
    for (const ReachReport::NamedGoal& goal : report.goals)
        print_row(out, "goal",
                  goal.name + (goal.time_s ? fmt::format(" after {:.2f} s", *goal.time_s) : " not reached"));
    const std::size_t last = std::max<std::size_t>(1, report.rounds.size() / 10);
    std::uint64_t cells = 0;
    for (std::size_t i = report.rounds.size() - std::min(last, report.rounds.size());
         i < report.rounds.size(); ++i)
        cells += report.rounds[i].cells;
    print_row(out, "last tenth", fmt::format("of the rounds found {} new cells", cells));
    print_row(out, "hash", hash_text(report.hash));
}

Status write_tape(const std::filesystem::path& file, const Tape& tape) {
    if (file.empty()) return {};
    return write_file_atomic(file, tape_to_text(tape));
}

// The way to a face or a point, or how near the search came.
int answer_how(const ReachSearch& search, const ReachWords& words) {
    std::optional<FaceId> face;
    const std::optional<Vec3> point = parse_vec3(words.how);
    NodeId node = no_id;
    std::string what = fmt::format("({})", words.how);
    if (words.how.starts_with("face:")) {
        const std::optional<std::int64_t> number = parse_int(words.how.substr(5));
        const auto count = static_cast<std::int64_t>(search.faces().size());
        if (!number || *number < 0 || *number >= count)
            return bad_input(
                {"--how", fmt::format("found {}, expected face:0 to face:{}", words.how, count - 1)});
        face = static_cast<FaceId>(*number);
        node = search.faces()[*face].node;
        what = fmt::format("face {}", *face);
    } else if (point) {
        const ReachSearch::Near near = search.nearest(*point);
        if (near.node != no_id && near.distance_m <= search.cell_m()) node = near.node;
    }
    std::optional<Tape> tape;
    if (node != no_id) tape = search.tape_to(node);
    OutputJson json{{"how", words.how}, {"reached", tape.has_value()}};
    std::string text;
    if (tape) {
        const double time = search.archive().nodes[node].tick * search.options().dt;
        json["time_s"] = time;
        json["position"] = vector_json(search.position_of(node));
        json["end_hash"] = hash_text(tape->end_hash.value_or(0));
        text = fmt::format("{}: reached after {:.2f} s, at {} m\n", what, time,
                           vector_text(search.position_of(node)));
    } else {
        auto miss =
            face ? search.nearest_miss_of_face(*face) : search.nearest_miss_of_point(*point, search.cell_m());
        if (point) {
            // The point may be meant for the feet, too.
            const Vec3 centre = *point + Vec3(0.0, search.level().movement.radii.y(), 0.0);
            auto feet = search.nearest_miss_of_point(centre, search.cell_m());
            if (feet && miss && feet->distance_m < miss->distance_m) miss = std::move(feet);
        }
        json["steps"] = search.steps();
        json["rounds"] = search.rounds().size();
        text = fmt::format("{}: not reached after {} steps in {} rounds", what, search.steps(),
                           search.rounds().size());
        if (miss) {
            json["short_m"] = miss->distance_m;
            if (miss->from != no_id) json["last_face"] = miss->from;
            const bool flew_by = point && miss->distance_m == 0.0;
            text += flew_by ? "; was there in flight, but nothing held the player"
                            : fmt::format("; {:.2f} m short", miss->distance_m);
            if (miss->from != no_id) text += fmt::format(", last on face {}", miss->from);
            tape = std::move(miss->tape);
        }
        text += '\n';
    }
    if (tape)
        if (const Status status = write_tape(path_of(words.tape), *tape); !status)
            return bad_input(status.error());
    words.json ? print_json(std::cout, json) : void(std::cout << text);
    return json["reached"].get<bool>() ? exit_fine : exit_check_failed;
}

std::string ending_of(const std::filesystem::path& file) {
    return to_lower(file.extension().string());
}

// As JSON, for RecastDemo, or as nodes of the level's glTF.
Status write_links(const ReachSearch& search, const std::filesystem::path& file) {
    const ReachLinks links = search.links();
    if (ending_of(file) == ".json") return write_file_atomic(file, links_to_json(search, links));
    if (ending_of(file) == ".gset") return write_file_atomic(file, links_to_gset(search, links));
    std::vector<GltfNode> nodes;
    for (const ReachLink& link : links.links)
        nodes.push_back({fmt::format("link {} {}", nodes.size() + 1,
                                     link_kind_names[static_cast<std::size_t>(link.kind)]),
                         link.begin, fmt::format("{{\"slipface_link\": {}}}", link_to_json(link))});
    return export_level(search.level(), {.gltf = file}, nodes);
}

int check(const Play& play, const ReachWords& words, const ReachOptions& options, const ReachLimits& limits) {
    const Level& level = play.level;
    Level before = play.as_saved;
    Status status;
    if (!words.before.empty()) {
        Result<LoadedLevel> other = load_level(path_of(words.before));
        if (!other) status = other.error();
        if (other && is_first(limits.team)) print_warnings(std::cerr, other->warnings);
        if (other) before = std::move(other->level);
    }
    if (limits.team != nullptr) status = agree(*limits.team, status);
    if (!status) return fail(status.error(), limits.team);
    const auto answers = check_goals(level, play.start, options, limits);
    if (!answers) return fail(answers.error(), limits.team);
    if (answers->empty())
        return fail({level.file_path.string(), "found no goals, expected some to check"}, limits.team);
    bool all = true;
    OutputJson json{{"goals", OutputJson::array()}};
    std::string text;
    for (const GoalAnswer& answer : *answers) {
        const Goal& goal = level.goals[answer.goal];
        OutputJson one{{"name", goal.name}, {"holds", answer.holds}, {"text", answer.text}};
        if (answer.time_s) one["time_s"] = *answer.time_s;
        text += fmt::format("{:<8}{}\n", answer.holds ? "holds" : "BROKEN", answer.text);
        if (!answer.holds) {
            all = false;
            one["causes"] = causes_of(answer, before, level, play.start, options, limits);
            for (const auto& cause : one["causes"])
                text += fmt::format("        {}\n", cause.get<std::string>());
        }
        if (answer.tape && !words.tapes.empty() && is_first(limits.team)) {
            const std::filesystem::path file =
                path_of(words.tapes) / fmt::format("goal-{}.tape", answer.goal + 1);
            if (const Status written = write_tape(file, *answer.tape); !written) status = written;
            one["tape"] = file.string();
        }
        json["goals"].push_back(std::move(one));
    }
    if (!is_first(limits.team)) return exit_fine;
    if (!status) return bad_input(status.error());
    json["all_hold"] = all;
    words.json ? print_json(std::cout, json) : void(std::cout << text);
    return all ? exit_fine : exit_check_failed;
}

// Writes the search every so many rounds, but no more often than that it costs a twentieth of the time.
class Checkpoints {
  public:
    Checkpoints(std::string file, std::uint64_t every) : file_(std::move(file)), every_(every) {}
    void after(const ReachSearch& search) {
        if (file_.empty() || search.rounds().size() < stored_ + every_ || Clock::now() < next_) return;
        write(search);
    }
    // What was searched since the last one.
    void finish(const ReachSearch& search) {
        if (!file_.empty() && search.rounds().size() > stored_) write(search);
    }
    void begin_at(std::size_t rounds) { stored_ = rounds; }

  private:
    using Clock = std::chrono::steady_clock;
    // A disk that is full now may not be so later: the search goes on, and the file before it stays.
    void write(const ReachSearch& search) {
        const auto begin = Clock::now();
        if (const Status status = search.store(path_of(file_)); !status)
            print_error(std::cerr,
                        {"--checkpoint", fmt::format("{}; the search goes on, and could be resumed "
                                                     "after round {}",
                                                     status.error().text(), stored_)});
        else
            stored_ = search.rounds().size();
        next_ = Clock::now() + 20 * (Clock::now() - begin);
    }

    std::string file_;
    std::uint64_t every_;
    std::size_t stored_ = 0;  // after so many rounds
    Clock::time_point next_;
};

// A new search, or the one of --resume or --checkpoint. In a team rank 0 alone needs to have the file.
Result<ReachSearch> begin_search(const Play& play, const ReachWords& words, const ReachOptions& options,
                                 Team* team) {
    const std::string& file = words.resume.empty() ? words.checkpoint : words.resume;
    std::error_code error;
    const bool there =
        !words.resume.empty() || (!file.empty() && std::filesystem::exists(path_of(file), error));
    std::string text;
    Status status;
    if (is_first(team) && there) {
        Result<std::string> read = read_file(path_of(file));
        if (read)
            text = std::move(*read);
        else
            status = read.error();
        if (read && text.empty()) status = Error{file, "is empty, expected a search"};
    }
    if (team != nullptr) {
        status = agree(*team, status);
        text = team->from_first(text);
    }
    if (!status) return status.error();
    Result<ReachSearch> search = text.empty() ? ReachSearch::begin(play.level, play.start, options)
                                              : ReachSearch::resume_text(play.level, text, file);
    status = search ? Status() : search.error();
    if (search && !text.empty() && words.resume.empty()) {
        const ReachOptions& stored = search->options();
        if (stored.seed != options.seed || stored.cell_m != options.cell_m || search->start() != play.start)
            status =
                Error{file, fmt::format("found a search with --seed {} --cell {} from {}, expected --seed {} "
                                        "--cell {} from {}",
                                        stored.seed, stored.cell_m, vector_text(search->start()),
                                        options.seed, options.cell_m, vector_text(play.start))};
    }
    if (team != nullptr) status = agree(*team, status);
    if (!status) return status.error();
    return search;
}

int run(const ReachWords& words, Team* team) {
    const Result<std::unique_ptr<Play>> play = load_play(words, team);
    if (!play) return fail(play.error(), team);
    ReachOptions options;
    options.seed = words.seed;
    options.cell_m = words.cell;
    ReachLimits limits;
    limits.seconds = words.seconds;
    if (words.rounds > 0) limits.rounds = words.rounds;
    if (words.seconds <= 0.0 && words.rounds == 0)
        limits.seconds = words.check ? check_seconds : usual_seconds;
    limits.team = team;
    if (words.check) return check(**play, words, options, limits);

    Result<ReachSearch> search = begin_search(**play, words, options, team);
    if (!search) return fail(search.error(), team);
    Checkpoints checkpoints(words.checkpoint, words.every);
    checkpoints.begin_at(search->rounds().size());
    limits.after_round = [&](const ReachSearch& now) { checkpoints.after(now); };
    const std::uint64_t steps_before = search->steps();
    const auto begin = std::chrono::steady_clock::now();
    // Who only asks a stored search wants no further one.
    const bool asks = !words.how.empty() || !words.links.empty();
    const bool only_asks = asks && !words.resume.empty() && words.rounds == 0 && words.seconds <= 0.0;
    if (!only_asks) search->run(limits);
    if (!is_first(team)) return exit_fine;
    checkpoints.finish(*search);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!words.out.empty())
        if (const Status status = search->store(path_of(words.out)); !status)
            return bad_input(status.error());
    if (!words.links.empty())
        if (const Status status = write_links(*search, path_of(words.links)); !status)
            return bad_input(status.error());
    if (!words.how.empty()) return answer_how(*search, words);
    const ReachReport report = make_reach_report(*search);
    words.json ? void(std::cout << reach_to_json(report, true) << '\n')
               : print_report(report, seconds, steps_before);
    return exit_fine;
}

int diff(const std::string& a, const std::string& b, bool json) {
    const Result<std::string> first = read_file(path_of(a)), second = read_file(path_of(b));
    if (!first) return bad_input(first.error());
    if (!second) return bad_input(second.error());
    const Result<ReachReport> before = parse_reach_report(*first, a), after = parse_reach_report(*second, b);
    if (!before) return bad_input(before.error());
    if (!after) return bad_input(after.error());
    if (before->level_fingerprint != after->level_fingerprint)
        return bad_input(
            {b, fmt::format("found a search of the geometry {}, expected {} as in {}: faces have "
                            "no numbers that outlive a change of the mesh",
                            hash_text(after->level_fingerprint), hash_text(before->level_fingerprint), a)});
    const ReachDifference difference = compare_reach(*before, *after);
    if (json) {
        OutputJson out{{"gained_faces", difference.gained}, {"lost_faces", difference.lost}};
        out["slower_faces"] = OutputJson::array();
        for (const auto& one : difference.slower)
            out["slower_faces"].push_back(
                {{"face", one.face}, {"before_s", one.before_s}, {"after_s", one.after_s}});
        out["new_trap_faces"] = difference.new_traps;
        out["goals_gained"] = difference.goals_gained;
        out["goals_lost"] = difference.goals_lost;
        out["settings"] = difference.settings;
        print_json(std::cout, out);
    } else {
        print_row(std::cout, "gained", faces_text(difference.gained));
        print_row(std::cout, "lost", faces_text(difference.lost));
        print_row(std::cout, "slower", counted(difference.slower.size(), "face"));
        print_row(std::cout, "new traps", faces_text(difference.new_traps));
        for (const std::string& goal : difference.goals_gained)
            print_row(std::cout, "goal gained", goal);
        for (const std::string& goal : difference.goals_lost)
            print_row(std::cout, "goal lost", goal);
        for (const std::string& setting : difference.settings)
            print_row(std::cout, "setting", setting);
    }
    const bool same = difference.gained.empty() && difference.lost.empty();
    return same ? exit_fine : exit_check_failed;
}

std::string links_check(const std::string& file) {
    for (const char* const ending : {".json", ".gset", ".gltf", ".glb"})
        if (ending_of(path_of(file)) == ending) return {};
    return fmt::format("found {}, expected a file of .json, .gset, .gltf or .glb", file);
}

std::string how_check(const std::string& text) {
    if (text.starts_with("face:") || parse_vec3(text)) return {};
    return fmt::format("found {}, expected face:NUMBER or x,y,z", text);
}

}  // namespace

void add_reach_verb(CLI::App& app, int& exit_code, Team* team) {
    CLI::App* verb = app.add_subcommand("reach", "Search for all that the player can reach, and how");
    auto words = std::make_shared<ReachWords>();
    CLI::Option* level = add_play_options(*verb, *words);
    verb->add_option("--seconds", words->seconds, "Search for so long; else 20, and 60 with --check")
        ->check(CLI::Range(0.0, 1e6));
    verb->add_option("--rounds", words->rounds, "Search so many rounds: the same bytes on every machine")
        ->check(whole_number);
    verb->add_option("--cell", words->cell, "Edge of a cell in metres; else by the player and the level")
        ->type_name("METRES")
        ->check(CLI::Range(0.05, 100.0));
    verb->add_option("--out", words->out, "Write the search to a file, to go on or to compare")
        ->type_name("FILE");
    verb->add_option("--resume", words->resume, "Go on with a search from a file")->type_name("FILE");
    CLI::Option* checkpoint =
        verb->add_option("--checkpoint", words->checkpoint,
                         "Go on with this file if it is there, and write it now and then")
            ->type_name("FILE");
    checkpoint->excludes("--resume");
    verb->add_option("--every", words->every, "Rounds between writing --checkpoint")
        ->capture_default_str()
        ->check(CLI::Range(1, 1'000'000))
        ->needs(checkpoint);
    CLI::Option* how =
        verb->add_option("--how", words->how, "Say how the player gets to a face or a point, or how near")
            ->type_name("face:N|x,y,z")
            ->check(how_check);
    verb->add_option("--tape", words->tape, "Write the inputs of --how to a file")
        ->type_name("FILE")
        ->needs(how);
    verb->add_option("--links", words->links, "Write the links between walkable regions, with their tapes")
        ->type_name("FILE.json|.gset|.gltf|.glb")
        ->check(links_check);
    CLI::Option* check_flag = verb->add_flag(
        "--check", words->check, "Check the level's goals; fails when one breaks, and says what broke it");
    check_flag->excludes(how)->excludes(checkpoint);
    verb->add_option("--before", words->before, "The level before a change: names what of it broke a goal")
        ->type_name("LEVEL")
        ->needs(check_flag);
    verb->add_option("--tapes", words->tapes, "Folder for a tape of each goal")
        ->type_name("FOLDER")
        ->needs(check_flag)
        ->check(CLI::ExistingDirectory);
    verb->add_flag("--json", words->json, "Print JSON");

    verb->callback([verb, level, words, team, &exit_code] {
        if (!verb->get_subcommands().empty()) return;
        if (level->count() == 0) throw CLI::RequiredError("LEVEL");
        words->all_options = verb->config_to_str();
        exit_code = guarded([&] { return run(*words, team); });
    });
    if (team != nullptr) return;

    CLI::App* diff_verb = verb->add_subcommand("diff", "Say what the second of two searches gained and lost");
    auto files = std::make_shared<std::pair<std::string, std::string>>();
    auto diff_json = std::make_shared<bool>(false);
    diff_verb->add_option("A", files->first, "File of --out, or what --json printed")->required();
    diff_verb->add_option("B", files->second, "The same of another search")->required();
    diff_verb->add_flag("--json", *diff_json, "Print JSON");
    diff_verb->callback([files, diff_json, &exit_code] {
        exit_code = guarded([&] { return diff(files->first, files->second, *diff_json); });
    });
}

}  // namespace slipface::cli
