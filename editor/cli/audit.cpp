#include "slipface/sim/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <span>

#include "cli/format.h"
#include "cli/guarded.h"
#include "cli/play.h"
#include "cli/verbs.h"
#include "slipface/base/files.h"
#include "slipface/base/system.h"
#include "slipface/base/text.h"
#include "slipface/reach/search.h"

namespace slipface::cli {
namespace {

struct AuditWords : PlayWords {
    std::string speeds, starts, shard, dt = "1/60", tapes, out;
    std::uint32_t walkers = 100;
    double seconds = 60.0;
    bool json = false, heat = false;
};

Result<AuditOptions> audit_options(const AuditWords& words) {
    AuditOptions options;
    options.walkers = words.walkers;
    options.duration_s = words.seconds;
    options.seed = words.seed;
    options.heat = words.heat;
    options.dt_text = words.dt;
    const std::size_t slash = words.dt.find('/');
    const auto over = parse_double(words.dt.substr(0, slash));
    const auto under =
        slash == std::string::npos ? std::optional(1.0) : parse_double(words.dt.substr(slash + 1));
    if (!over || !under || *under == 0.0)
        return Error{"--dt", fmt::format("found {}, expected seconds such as 1/60 or 0.02", words.dt)};
    options.dt = *over / *under;
    if (!words.speeds.empty()) {
        for (const std::string_view part : split(words.speeds, ',')) {
            const auto speed = parse_double(trim(part));
            if (!speed)
                return Error{"--speeds", fmt::format("found {}, expected numbers as 6,20,60", words.speeds)};
            options.speeds.push_back(*speed);
        }
    }
    options.shard = shard_of(words.shard);
    return options;
}

// Places that a search reached: "reached", "reached:300" rounds, or a file of `slipface reach --out`.
Result<std::vector<Vec3>> reached_starts(const Level& level, const Vec3& spawn, const AuditWords& words,
                                         double dt, Team* team) {
    constexpr std::string_view reached = "reached";
    constexpr std::uint64_t usual_rounds = 200;
    const bool anew = words.starts.starts_with(reached) &&
                      (words.starts.size() == reached.size() || words.starts[reached.size()] == ':');
    ReachLimits limits;
    limits.rounds = usual_rounds;
    limits.team = team;
    if (anew && words.starts.size() > reached.size()) {
        const auto rounds = parse_int(words.starts.substr(reached.size() + 1));
        if (!rounds || *rounds < 1)
            return Error{"--starts", fmt::format("found {}, expected reached:ROUNDS with at least one round",
                                                 words.starts)};
        limits.rounds = static_cast<std::uint64_t>(*rounds);
    }
    Result<ReachSearch> search =
        anew ? ReachSearch::begin(level, spawn, {}) : ReachSearch::resume(level, path_of(words.starts));
    if (!search) return search.error();
    if (anew) search->run(limits);
    Result<std::vector<Vec3>> starts = usable_starts(level, search->standing_places(words.walkers), dt);
    if (starts && starts->empty())
        return Error{"--starts", "found no place where a walker can begin, expected at least one"};
    return starts;
}

Status write_tapes(const std::filesystem::path& folder, const Level& level, const AuditOptions& options,
                   const AuditReport& report) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder))
        return Error{folder.string(), error ? error.message() : "is no folder"};
    for (const AuditFinding& finding : report.findings) {
        const std::string name = fmt::format("{}-{}-{}-{}.tape", level.mesh_path.stem().string(),
                                             info_of(finding.kind).name, finding.walker, finding.life);
        const std::string text = tape_to_text(audit_tape(level, options, finding));
        if (Status status = write_file_atomic(folder / path_of(name), text); !status.ok()) return status;
    }
    return {};
}

void print_audit(const AuditReport& report, double seconds, std::ostream& out) {
    print_row(out, "level", fmt::format("{}, {}", report.level_name, report.closed ? "closed" : "open"));
    print_row(out, "walkers",
              fmt::format("{} of {} s at {} s per step, seed {}", report.walkers, report.duration_s,
                          report.dt_text, report.seed));
    if (report.starts > 0)
        print_row(out, "starts", fmt::format("{} places that a search reached", report.starts));
    if (!report.shard.whole()) print_row(out, "shard", shard_text(report.shard));
    print_row(out, "steps", fmt::format("{}", report.steps));
    if (report.untried > 0)
        print_row(out, "untried",
                  fmt::format("{} steps, where too many triangles lie in one place", report.untried));
    if (seconds > 0.0)
        print_row(out, "rate",
                  fmt::format("{:.0f} steps a second", static_cast<double>(report.steps) / seconds));
    for (std::size_t kind = 0; kind < finding_kind_count; ++kind)
        print_row(out, info_of(static_cast<FindingKind>(kind)).label, fmt::format("{}", report.counts[kind]));
    print_row(out, "hazards", fmt::format("{}", report.hazards));
    print_row(out, "crushed", fmt::format("{}", report.crushed));
    if (!report.closed) {
        print_row(out, "left", fmt::format("{} times through openings", report.left));
        constexpr std::size_t most = 20;
        const std::vector<AuditExit> exits = busiest_first(report.exits);
        for (const AuditExit& exit : std::span(exits).first(std::min(exits.size(), most)))
            print_row(out, "", fmt::format("{}, at {}  m", exit_text(exit), vector_text(exit.position)));
        if (exits.size() > most)
            print_row(out, "", fmt::format("and from {} more faces", exits.size() - most));
    }
    if (report.falls > 0) print_row(out, "falls", fmt::format("{}", report.falls));
    print_row(out, "hash", hash_text(report.hash));
    if (report.findings.empty()) return;
    for (std::size_t kind = 0; kind < finding_kind_count; ++kind) {
        if (report.counts[kind] == 0) continue;
        const FindingKindInfo& info = info_of(static_cast<FindingKind>(kind));
        out << fmt::format("\n{}: {}\n  {}\n", info.label, report.counts[kind], info.meaning);
        for (const AuditFinding& finding : report.findings) {
            if (static_cast<std::size_t>(finding.kind) != kind) continue;
            out << fmt::format("    {}  (tick {}, at {})\n", finding.text, finding.tick,
                               vector_text(finding.position));
        }
        out << fmt::format("  {}\n", info.remedy);
    }
}

// Writes the report to `out` or to a file. The exit code is exit_fine for a report without findings.
int deliver(const AuditReport& report, bool json, const std::string& file, double seconds) {
    const std::string text = audit_to_json(report);
    if (!file.empty()) {
        if (const Status status = write_file_atomic(path_of(file), text); !status.ok()) {
            print_error(std::cerr, status.error());
            return exit_bad_input;
        }
    }
    json ? void(std::cout << text) : print_audit(report, seconds, std::cout);
    return report.clean() ? exit_fine : exit_check_failed;
}

// Each process runs a part of the walkers, as one of --shard would.
Result<AuditReport> audit_in_team(const Level& level, AuditOptions options, Team& team) {
    options.shard = {static_cast<std::uint32_t>(team.rank() + 1), static_cast<std::uint32_t>(team.size())};
    const Result<AuditReport> mine = run_audit(level, options);
    if (Status status = agree(team, mine ? Status() : mine.error()); !status) return status.error();
    const std::vector<std::string> texts = team.gather(audit_to_json(*mine));
    if (team.rank() != 0) return *mine;
    std::vector<AuditPart> parts;
    for (std::size_t rank = 0; rank < texts.size(); ++rank) {
        Result<AuditReport> part = audit_from_json(texts[rank], team.name_of(rank));
        if (!part) return part.error();
        parts.push_back({team.name_of(rank), std::move(*part)});
    }
    return merge_audits(parts);
}

int run(const AuditWords& words, Team* team) {
    Result<AuditOptions> options = audit_options(words);
    Status usable = options ? Status() : options.error();
    if (team != nullptr) usable = agree(*team, usable);
    if (!usable) return fail(usable.error(), team) == exit_fine ? exit_fine : exit_bad_usage;
    const Result<std::unique_ptr<Play>> play = load_play(words, team);
    if (!play) return fail(play.error(), team);
    const Level& level = (*play)->level;
    if (!words.starts.empty()) {
        auto starts = reached_starts(level, (*play)->start, words, options->dt, team);
        Status status = starts ? Status() : starts.error();
        if (team != nullptr) status = agree(*team, status);
        if (!status) return fail(status.error(), team);
        options->starts = std::move(*starts);
    }
    const auto begin = std::chrono::steady_clock::now();
    const Result<AuditReport> report =
        team != nullptr ? audit_in_team(level, *options, *team) : run_audit(level, *options);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!report) return fail(report.error(), team);
    if (!is_first(team)) return exit_fine;
    if (!words.tapes.empty()) {
        if (const Status status = write_tapes(path_of(words.tapes), level, *options, *report); !status.ok())
            return print_error(std::cerr, status.error()), exit_bad_input;
    }
    return deliver(*report, words.json, words.out, seconds);
}

int merge(const std::vector<std::string>& files, const AuditWords& words) {
    std::vector<AuditPart> parts;
    for (const std::string& file : files) {
        const Result<std::string> text = read_file(path_of(file));
        if (!text) return print_error(std::cerr, text.error()), exit_bad_input;
        Result<AuditReport> part = audit_from_json(*text, file);
        if (!part) return print_error(std::cerr, part.error()), exit_bad_input;
        parts.push_back({file, std::move(*part)});
    }
    const Result<AuditReport> whole = merge_audits(parts);
    if (!whole) return print_error(std::cerr, whole.error()), exit_bad_input;
    return deliver(*whole, words.json, words.out, 0.0);
}

void add_report_options(CLI::App& verb, AuditWords& words) {
    verb.add_flag("--json", words.json, "Print JSON: the same bytes for any number of threads and shards");
    verb.add_option("--out", words.out, "Write the JSON to a file, too")->type_name("FILE");
}

}  // namespace

void add_audit_verb(CLI::App& app, int& exit_code, Team* team) {
    CLI::App* verb = app.add_subcommand("audit", "Find gaps and traps in a level with random walkers");
    auto words = std::make_shared<AuditWords>();
    CLI::Option* level = add_play_options(*verb, *words);
    verb->add_option("--walkers", words->walkers, "How many")->capture_default_str();
    verb->add_option("--seconds", words->seconds, "Simulated time of each")->capture_default_str();
    verb->add_option("--speeds", words->speeds, "Running speeds in m/s, used in turn; default: the level's")
        ->type_name("6,20,60");
    verb->add_option("--dt", words->dt, "Seconds a step")->capture_default_str();
    verb->add_option("--starts", words->starts,
                     "Start wherever a search gets in 200 or so many rounds, or got, instead of at a spawn")
        ->type_name("reached[:ROUNDS]|FILE");
    if (team == nullptr) add_shard_option(*verb, words->shard, "walkers");
    verb->add_option("--tapes", words->tapes, "Folder for a tape of each finding")->type_name("FOLDER");
    verb->add_flag("--heat", words->heat, "Also report totals per face");
    add_report_options(*verb, *words);

    verb->callback([verb, level, words, team, &exit_code] {
        if (!verb->get_subcommands().empty()) return;
        if (level->count() == 0) throw CLI::RequiredError("LEVEL");
        words->all_options = verb->config_to_str();
        exit_code = guarded([&] { return run(*words, team); });
    });
    if (team != nullptr) return;

    CLI::App* merge_verb = verb->add_subcommand("merge", "Merge the reports of all shards");
    auto files = std::make_shared<std::vector<std::string>>();
    auto merge_words = std::make_shared<AuditWords>();
    merge_verb->add_option("REPORTS", *files, "JSON reports")->required();
    add_report_options(*merge_verb, *merge_words);

    merge_verb->callback([files, merge_words, &exit_code] {
        exit_code = guarded([&] { return merge(*files, *merge_words); });
    });
}

}  // namespace slipface::cli
