#include "snapshot_verb/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/exit_codes.h"
#include "cli/options.h"
#include "goldens/merge_facts.h"
#include "goldens/report.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "snapshot_verb/history.h"
#include "snapshot_verb/sheet.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

constexpr int exit_missing = 2, exit_not_rendered = 3, exit_unreadable = 4;

int bad_input(const Error& error) {
    fmt::print(stderr, "slipface: {}\n", error.text());
    return cli::exit_bad_input;
}

// The selected snapshots, and this process's part of them.
struct Chosen {
    std::vector<std::string> names;
    Shard shard;
    std::string suite;
};

// Fails if nothing is selected.
Result<Chosen> chosen_names(const CheckArguments& arguments, const SuiteSet& set) {
    std::vector<std::string> chosen;
    for (const std::string& name : set.names)
        if (is_wanted(arguments.only, name)) chosen.push_back(name);
    if (chosen.empty()) {
        std::string patterns;
        for (const std::string& pattern : arguments.only)
            patterns += " " + pattern;
        return Error{"", arguments.only.empty() ? "there are no snapshots: no scenes.json, no editor/*.script"
                                                : "no snapshot matches" + patterns};
    }
    Chosen mine{
        .names = {}, .shard = cli::shard_of(arguments.shard), .suite = suite_fingerprint(chosen, set.files)};
    for (std::size_t i = 0; i < chosen.size(); ++i)
        if (mine.shard.has(i)) mine.names.push_back(chosen[i]);
    return mine;
}

void print_line(const std::string& word, const std::string& text) {
    fmt::print("{:<17} {}\n", word, text);
    std::fflush(stdout);
}

// While it runs: one line for what passes and, for what does not, the name alone; the acts come at the end.
void print_progress(const CheckArguments& arguments, const GoldenResult& entry) {
    const bool same = entry.state == GoldenState::same;
    if (same && !entry.matched.empty())
        print_line("same", entry.name + "  " + entry.message);
    else if (!arguments.quiet)
        print_line(golden_state_name(entry.state), entry.name);
}

// One row per act.
void print_acts(const Report& report) {
    for (const ActRow& row : act_rows(report)) {
        print_line(row.word, row.text);
        print_line("", entries_text(report, row));
    }
}

void add_orphans(const CheckArguments& arguments, const SuiteSet& set, Report& report) {
    const bool all = arguments.only.empty() && arguments.work.suite.levels.empty() &&
                     arguments.work.suite.suites.empty() && report.shard.number == 1;
    if (!all) return;
    for (const std::string& name : orphan_goldens(arguments.work.suite.goldens, set.names)) {
        GoldenResult orphan;
        orphan.name = name;
        orphan.state = GoldenState::orphan;
        orphan.message = "no snapshot makes this golden; `slipface snapshot approve --prune` removes it";
        report.entries.push_back(std::move(orphan));
    }
}

void print_timing(const Report& report, int jobs) {
    double drawing = 0.0, all = 0.0;
    for (const GoldenResult& entry : report.entries) {
        drawing += entry.drawing_s;
        all += entry.seconds;
    }
    fmt::print(
        "{} images in {:.2f} s with {} process{}; {:.2f} s in total, of which {:.2f} s rasterising (factor "
        "{:.2f})\n",
        report.entries.size(), report.seconds, jobs, jobs == 1 ? "" : "es", all, drawing,
        drawing > 0.0 ? all / drawing : 0.0);
}

// GitHub shows this file's text on the page of the run.
void write_step_summary(const Report& report) {
    const char* const path = std::getenv("GITHUB_STEP_SUMMARY");
    if (path == nullptr || report.failed() == 0) return;
    std::ofstream file(path, std::ios::app);
    file << "| cause | act | what it changed |\n|---|---|---|\n";
    for (const ActRow& row : act_rows(report))
        file << "| " << row.word << " | " << row.text << " | " << entries_text(report, row) << " |\n";
}

int finish(const CheckArguments& arguments, Report& report) {
    sort_by_severity(report);
    add_history(report);
    const fs::path out = arguments.work.out;
    if (Status status = write_report(report, out); !status) return bad_input(status.error());
    print_acts(report);
    if (!report_to_annotations(report).empty() && std::getenv("GITHUB_ACTIONS") != nullptr)
        fmt::print("{}", report_to_annotations(report));
    write_step_summary(report);
    const std::string uncovered = not_reached_text(not_reached(report));
    if (!arguments.quiet && arguments.only.empty() && report.shard.whole() && !uncovered.empty())
        print_line("not reached", uncovered);
    fmt::print("{} same, {} failed\n", report.count(GoldenState::same), report.failed());
    if (arguments.timing) print_timing(report, arguments.work.jobs);
    if (report.failed() > 0) {
        fmt::print("Look at {}\n", (out / "report.html").generic_string());
        if (const std::string command = approve_command(report, out); !command.empty())
            fmt::print("To approve the new images: {}\n", command);
    }
    return exit_code_of(report.entries, arguments.detailed);
}

Rendering rendering_of(const fs::path& numbers, Image image) {
    const Result<std::string> text = read_file(numbers, std::uint64_t{64} << 20U);
    return {std::move(image), text ? *text : std::string()};
}

}  // namespace

bool in_ci() {
    for (const char* name : {"CI", "GITHUB_ACTIONS", "GITLAB_CI", "TF_BUILD", "BUILDKITE", "CIRCLECI",
                             "JENKINS_URL", "TEAMCITY_VERSION"}) {
        const char* value = std::getenv(name);
        if (value != nullptr && *value != '\0' && std::string_view(value) != "false" &&
            std::string_view(value) != "0")
            return true;
    }
    return false;
}

int exit_code_of(const std::vector<GoldenResult>& entries, bool detailed) {
    const auto any = [&](GoldenState state) {
        return std::any_of(entries.begin(), entries.end(),
                           [&](const GoldenResult& entry) { return entry.state == state; });
    };
    const bool fine = std::all_of(entries.begin(), entries.end(),
                                  [](const GoldenResult& entry) { return entry.state == GoldenState::same; });
    if (fine) return cli::exit_fine;
    if (!detailed) return cli::exit_check_failed;
    if (any(GoldenState::unreadable)) return exit_unreadable;
    if (any(GoldenState::failed)) return exit_not_rendered;
    if (any(GoldenState::different) || any(GoldenState::nondeterministic)) return cli::exit_check_failed;
    return exit_missing;
}

int snapshot_check(const CheckArguments& arguments) {
    const auto start = std::chrono::steady_clock::now();
    const Result<SuiteSet> set = load_suite_set(arguments.work.suite);
    if (!set) return bad_input(set.error());
    const auto chosen = chosen_names(arguments, *set);
    if (!chosen) return bad_input(chosen.error());
    Report report;
    report.goldens = arguments.work.suite.goldens;
    report.shard = chosen->shard;
    report.suite = chosen->suite;
    const Result<std::string> renderer =
        do_all_work(arguments.work, *set, chosen->names, [&](const GoldenResult& entry) {
            print_progress(arguments, entry);
            report.entries.push_back(entry);
        });
    if (!renderer) return bad_input(renderer.error());
    report.renderer = *renderer;
    add_orphans(arguments, *set, report);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return finish(arguments, report);
}

int snapshot_compare(const CheckArguments& arguments) {
    Result<SuiteSet> set = load_suite_set(arguments.work.suite);
    if (!set) return bad_input(set.error());
    const auto chosen = chosen_names(arguments, *set);
    if (!chosen) return bad_input(chosen.error());
    Studio studio(*std::move(set));
    Report report;
    report.goldens = arguments.work.suite.goldens;
    report.shard = chosen->shard;
    report.suite = chosen->suite;
    for (const std::string& name : chosen->names) {
        const Result<Snapshot> snapshot = studio.find(name);
        const Result<Image> image =
            is_input(name) ? Image() : load_image(fs::path(arguments.actual) / (name + ".png"));
        GoldenResult entry;
        entry.name = name;
        entry.state = GoldenState::failed;
        entry.message = !snapshot ? snapshot.error().text() : !image ? image.error().text() : "";
        if (snapshot && image)
            entry = check_golden(report.goldens, *snapshot,
                                 rendering_of(fs::path(arguments.actual) / (name + ".json"), *image),
                                 arguments.work.out);
        print_progress(arguments, entry);
        report.entries.push_back(std::move(entry));
    }
    report.renderer = studio.renderer();
    return finish(arguments, report);
}

int snapshot_render(const CheckArguments& arguments) {
    const Result<SuiteSet> set = load_suite_set(arguments.work.suite);
    if (!set) return bad_input(set.error());
    const auto chosen = chosen_names(arguments, *set);
    if (!chosen) return bad_input(chosen.error());
    bool fine = true;
    const auto start = std::chrono::steady_clock::now();
    Report report;
    const Result<std::string> renderer =
        do_all_work(arguments.work, *set, chosen->names, [&](const GoldenResult& entry) {
            fine = fine && entry.state == GoldenState::same;
            if (entry.state != GoldenState::same)
                print_line("FAILED", entry.name + "  " + entry.message);
            else if (!arguments.quiet)
                fmt::print("{}\n", entry.message);
            report.entries.push_back(entry);
        });
    if (!renderer) return bad_input(renderer.error());
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (arguments.timing) print_timing(report, arguments.work.jobs);
    if (arguments.sheet) {
        std::vector<std::pair<std::string, fs::path>> images;
        for (const std::string& name : chosen->names)
            if (!is_input(name)) images.emplace_back(name, fs::path(arguments.work.out) / (name + ".png"));
        const auto sheets = write_sheets(images, arguments.work.out);
        if (!sheets) return bad_input(sheets.error());
        for (const fs::path& sheet : *sheets)
            fmt::print("{}\n", sheet.string());
    }
    return fine ? cli::exit_fine : exit_not_rendered;
}

int snapshot_merge(const std::vector<std::string>& reports, const CheckArguments& arguments) {
    const std::vector<fs::path> files(reports.begin(), reports.end());
    Result<Report> merged = merge_reports(files, arguments.work.out);
    if (!merged) return bad_input(merged.error());
    return finish(arguments, *merged);
}

int snapshot_merge_driver(const std::array<std::string, 3>& files, const std::string& name) {
    std::array<std::string, 3> texts;  // base, ours, theirs
    for (std::size_t i = 0; i < files.size(); ++i) {
        const Result<std::string> text = read_file(files[i], std::uint64_t{256} << 20U);
        if (!text) return bad_input(text.error());
        texts[i] = *text;
    }
    const Result<std::string> merged = merge_facts(texts[0], texts[1], texts[2]);
    if (!merged) {
        fmt::print(stderr,
                   "slipface: {}:{}: {}; `slipface snapshot approve` after the merge writes it again\n", name,
                   merged.error().location, merged.error().message);
        return cli::exit_check_failed;  // git leaves ours, and names the conflict
    }
    if (Status status = write_file_atomic(files[1], *merged); !status) return bad_input(status.error());
    return cli::exit_fine;
}

int snapshot_list(const CheckArguments& arguments) {
    const Result<SuiteSet> set = load_suite_set(arguments.work.suite);
    if (!set) return bad_input(set.error());
    const fs::path goldens = arguments.work.suite.goldens;
    nlohmann::json rows = nlohmann::json::array();
    std::error_code error;
    if (arguments.fingerprint) {
        std::vector<fs::path> files;
        for (fs::recursive_directory_iterator entry(goldens, error), end; !error && entry != end;
             entry.increment(error))
            if (entry->is_regular_file(error)) files.push_back(entry->path());
        std::sort(files.begin(), files.end());
        files.insert(files.end(), set->files.begin(), set->files.end());
        std::vector<std::string> names;
        std::copy_if(set->names.begin(), set->names.end(), std::back_inserter(names),
                     [&](const std::string& name) { return is_wanted(arguments.only, name); });
        fmt::print("{}\n", suite_fingerprint(names, files));
        return cli::exit_fine;
    }
    if (!arguments.orphans_only) {
        for (const std::string& name : set->names) {
            if (!is_wanted(arguments.only, name)) continue;
            const fs::path file = goldens / (name + ".png");
            int alternates = 0;
            while (fs::exists(goldens / fmt::format("{}.alt{}.png", name, alternates + 1), error))
                ++alternates;
            const bool there = fs::exists(file, error);
            rows.push_back({{"name", name},
                            {"golden", there},
                            {"bytes", there ? fs::file_size(file, error) : 0},
                            {"alternates", alternates}});
        }
    }
    const std::vector<std::string> orphans = orphan_goldens(goldens, set->names);
    for (const std::string& name : orphans)
        rows.push_back({{"name", name}, {"orphan", true}});
    if (arguments.json) {
        fmt::print("{}\n", rows.dump(1));
        return orphans.empty() || !arguments.orphans_only ? cli::exit_fine : exit_missing;
    }
    for (const nlohmann::json& row : rows) {
        std::string state = row.value("orphan", false) ? "orphan"
                            : row.value("golden", false)
                                ? fmt::format("{} KiB", (row.value("bytes", 0) + 1023) / 1024)
                                : "missing";
        if (row.value("alternates", 0) > 0)
            state += fmt::format(", {} alternates", row.value("alternates", 0));
        fmt::print("{:<10} {}\n", state, row.value("name", ""));
    }
    return orphans.empty() || !arguments.orphans_only ? cli::exit_fine : exit_missing;
}

int snapshot_diff(const std::string& expected, const std::string& actual, const std::string& profile,
                  const std::string& image, bool json) {
    const Result<Image> a = load_image(expected), b = load_image(actual);
    if (!a) return bad_input(a.error());
    if (!b) return bad_input(b.error());
    const CompareTolerance& tolerance = profile == "ui" ? ui_tolerance : scene_tolerance;
    const Comparison comparison = compare_images(*a, *b, tolerance);
    const auto sweep = threshold_sweep(*a, *b);
    if (!image.empty())
        if (Status status = save_png(image, difference_image(*a, *b)); !status)
            return bad_input(status.error());
    if (json) {
        nlohmann::json out{{"same", comparison.same},
                           {"verdict", comparison.verdict},
                           {"largest", comparison.max_delta},
                           {"differing", comparison.differing},
                           {"allowed", comparison.allowed},
                           {"densest", comparison.densest_window},
                           {"size_differs", comparison.size_differs}};
        for (const SweepRow& row : sweep)
            out["sweep"].push_back({row.pixel_delta, row.differing});
        fmt::print("{}\n", out.dump());
    } else {
        fmt::print("{}: {}\n", comparison.same ? "same" : "different", comparison.verdict);
        if (!comparison.size_differs && comparison.max_delta > 0)
            for (const SweepRow& row : sweep)
                fmt::print("  by more than {:>2}: {} pixels\n", row.pixel_delta, row.differing);
    }
    return comparison.same ? cli::exit_fine : cli::exit_check_failed;
}

}  // namespace slipface
