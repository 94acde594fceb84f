#include "nightly/nightly_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <thread>

#include "cli/exit_codes.h"
#include "cli/guarded.h"
#include "cli/options.h"
#include "nightly/run_item.h"
#include "slipface/base/files.h"
#include "slipface/base/hash.h"
#include "slipface/base/text.h"
#include "slipface/base/version.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

struct NightWords {
    std::string project, out = "out/night", last, shard;
    std::vector<std::string> reports;
    int jobs = 1;
    bool fresh = false, quiet = false;
};

int bad_input(const Error& error) {
    return cli::bad_input(std::cerr, error);
}

std::string program_text() {
    const fs::path program = "/proc/self/exe";
    return fmt::format("{} {:016x}", program_version(), fingerprint_of_files({&program, 1}));
}

void print(const NightResult& result, const char* word) {
    fmt::print("{:<9} {}  {}\n", word, result.name, result.text);
    std::fflush(stdout);
}

// Writes the reports and says what the night found.
int finish(const NightReport& report, const NightWords& words, const fs::path& project_folder) {
    if (Status status = write_night_report(report, words.out, project_folder); !status)
        return bad_input(status.error());
    fmt::print("{} failed to run, {} with findings, {} clean: {}\n", report.count(NightState::failed),
               report.count(NightState::findings), report.count(NightState::clean),
               (fs::path(words.out) / "report.html").generic_string());
    return report.count(NightState::failed) > 0     ? cli::exit_bad_input
           : report.count(NightState::findings) > 0 ? cli::exit_check_failed
                                                    : cli::exit_fine;
}

// What a check of images depends on, as its own verb finds it.
Status find_image_keys(Project& project, const std::string& program) {
    for (NightItem& item : project.items) {
        if (!item.check->uses_all_cores) continue;
        std::vector<std::string> words{"snapshot", "list", "--fingerprint"};
        words.insert(words.end(), item.options.begin(), item.options.end());
        const Result<ChildOutput> output = run_child(words, project.folder);
        if (!output) return output.error();
        if (output->code != cli::exit_fine) continue;  // 0: its check will say why
        Hasher hasher;
        hasher.text(program);
        hasher.text(shell_text(item.command()));
        hasher.text(output->out);
        item.key = hasher.value();
    }
    return {};
}

int run(const NightWords& words) {
    Result<Project> project = load_project(words.project);
    if (!project) return bad_input(project.error());
    NightReport report;
    report.program = program_text();
    find_keys(*project, report.program);
    if (Status status = find_image_keys(*project, report.program); !status) return bad_input(status.error());
    report.project = project->fingerprint;
    report.items = project->items.size();
    report.shard = cli::shard_of(words.shard);
    Hasher inputs;
    for (const NightItem& item : project->items)
        inputs.u64(item.key);
    report.inputs = inputs.value();

    std::error_code error;
    const fs::path out = fs::absolute(words.out), last = words.last.empty() ? out : fs::path(words.last);
    fs::create_directories(out, error);
    std::vector<std::pair<std::size_t, const NightItem*>> left;
    for (std::size_t i = 0; i < project->items.size(); ++i) {
        const NightItem& item = project->items[i];
        if (!report.shard.has(i)) continue;
        auto stored = words.fresh ? std::nullopt : stored_result(last, item, i);
        if (stored) {
            if (Status status = copy_folder(last / item.folder(), out / item.folder()); !status)
                return bad_input(status.error());
            if (!words.quiet) print(*stored, "unchanged");
            report.results.push_back(std::move(*stored));
        } else {
            left.emplace_back(i, &item);
        }
    }
    // Those with processes of their own come last, one after another.
    std::stable_partition(left.begin(), left.end(),
                          [](const auto& one) { return !one.second->check->uses_all_cores; });
    const Status status = run_items(
        {.project = project->folder, .out = out, .jobs = words.jobs}, left, [&](NightResult result) {
            if (!words.quiet || result.state != NightState::clean)
                print(result, night_state_names[static_cast<std::size_t>(result.state)]);
            report.results.push_back(std::move(result));
        });
    if (!status) return bad_input(status.error());
    std::sort(report.results.begin(), report.results.end(),
              [](const NightResult& a, const NightResult& b) { return a.index < b.index; });
    return finish(report, words, project->folder);
}

int merge(const NightWords& words) {
    const Result<NightReport> whole =
        merge_night_reports({words.reports.begin(), words.reports.end()}, words.out);
    if (!whole) return bad_input(whole.error());
    for (const NightResult* const result : worst_first(*whole))
        if (result->state != NightState::clean)
            print(*result, night_state_names[static_cast<std::size_t>(result->state)]);
    return finish(*whole, words, words.project);
}

void add_out(CLI::App& verb, NightWords& words) {
    verb.add_option("--out", words.out, "Folder of the report, tapes and images")
        ->capture_default_str()
        ->type_name("FOLDER");
}

}  // namespace

void add_nightly_verb(CLI::App& app, int& exit_code) {
    CLI::App* const verb =
        app.add_subcommand("nightly", "Check all levels of a project: audits, goals, geometry and images");
    auto words = std::make_shared<NightWords>();
    words->jobs = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 256U));
    CLI::Option* const project = verb->add_option(
        "PROJECT", words->project, "Project file: levels, presets and checks (docs/nightly.md)");
    add_out(*verb, *words);
    verb->add_option("--jobs", words->jobs, "Processes at a time")
        ->capture_default_str()
        ->check(CLI::Range(1, 256));
    cli::add_shard_option(*verb, words->shard, "checks");
    CLI::Option* const fresh =
        verb->add_flag("--fresh", words->fresh, "Run also what did not change since the last report");
    verb->add_option("--last", words->last, "Folder of the last report; default: --out")
        ->type_name("FOLDER")
        ->excludes(fresh);
    verb->add_flag("--quiet", words->quiet, "Only what is not clean");

    CLI::App* const merge_verb = verb->add_subcommand("merge", "Merge the reports of all shards");
    auto merge_words = std::make_shared<NightWords>();
    merge_verb->add_option("REPORTS", merge_words->reports, "report.json of each shard")->required();
    add_out(*merge_verb, *merge_words);
    merge_verb
        ->add_option("--project", merge_words->project, "Folder of the project, for the commands of the page")
        ->capture_default_str()
        ->type_name("FOLDER");
    merge_verb->callback(
        [merge_words, &exit_code] { exit_code = cli::guarded([&] { return merge(*merge_words); }); });
    verb->callback([verb, project, words, &exit_code] {
        if (!verb->get_subcommands().empty()) return;
        if (project->count() == 0) throw CLI::RequiredError("PROJECT");
        exit_code = cli::guarded([&] { return run(*words); });
    });
}

}  // namespace slipface
