// Making images the goldens: rendered again, or as a check has left them.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "cli/exit_codes.h"
#include "goldens/report.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "snapshot_verb/check.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

struct Tally {
    int written = 0, unchanged = 0, failed = 0;
};

int complain(const Error& error, int code = cli::exit_bad_input) {
    fmt::print(stderr, "slipface: {}\n", error.text());
    return code;
}

void count(const GoldenResult& result, Tally& tally) {
    const bool worked = result.state == GoldenState::same;
    const char* word = !worked ? "FAILED" : result.message.empty() ? "unchanged" : "approved";
    ++(!worked ? tally.failed : result.message.empty() ? tally.unchanged : tally.written);
    if (!worked || !result.message.empty()) fmt::print("{:<17} {}  {}\n", word, result.name, result.message);
    std::fflush(stdout);
}

// The image that the check wrote becomes the golden, so that the approved image is the reviewed one.
GoldenResult approve_seen(Studio& studio, const CheckArguments& arguments, const fs::path& folder,
                          const std::string& name) {
    GoldenResult result;
    result.name = name;
    result.state = GoldenState::failed;
    const Result<Snapshot> snapshot = studio.find(name);
    const Result<Image> image = load_image(folder / (name + ".actual.png"));
    if (!snapshot || !image) {
        result.message = (!snapshot ? snapshot.error() : image.error()).text();
        return result;
    }
    const fs::path numbers_file = folder / (name + ".actual.json");
    std::error_code error;
    Rendering seen{*image, ""};
    if (fs::exists(numbers_file, error)) {
        const Result<std::string> numbers = read_file(numbers_file);
        if (!numbers) {
            result.message = numbers.error().text();
            return result;
        }
        seen.numbers = *numbers;
    }
    if (snapshot->attachment) {
        const Result<Attachment> attachment = snapshot->attachment();
        const std::string digest = attachment ? fs::path(attachment->path).stem().string() : "";
        if (!digest.empty() && seen.numbers.find(digest) == std::string::npos) {
            result.message = "the level has changed since that check; run it again";
            return result;
        }
    }
    const auto written = approve_golden(arguments.work.suite.goldens, *snapshot, seen,
                                        {.force = arguments.work.force, .here = arguments.work.here});
    if (!written) {
        result.message = written.error().text();
        return result;
    }
    result.state = GoldenState::same;
    for (const std::string& file : *written)
        result.message += (result.message.empty() ? "wrote " : ", ") + file;
    return result;
}

int approve_from(const CheckArguments& arguments, SuiteSet set, Tally& tally) {
    const Result<std::string> text = read_file(arguments.from);
    if (!text) return complain(text.error());
    const Result<Report> report = report_from_json(*text, arguments.from);
    if (!report) return complain(report.error());
    Studio studio(std::move(set));
    int chosen = 0;
    for (const GoldenResult& entry : report->entries) {
        const bool possible = entry.state == GoldenState::different || entry.state == GoldenState::missing ||
                              entry.state == GoldenState::unreadable;
        if (!possible || !is_wanted(arguments.only, entry.name)) continue;
        ++chosen;
        count(approve_seen(studio, arguments, fs::path(arguments.from).parent_path(), entry.name), tally);
    }
    if (chosen == 0)
        return complain({arguments.from, "this report has nothing to approve under these names"});
    return cli::exit_fine;
}

int approve_rendered(const CheckArguments& arguments, const SuiteSet& set, Tally& tally) {
    std::vector<std::string> names;
    for (const std::string& name : set.names)
        if (is_wanted(arguments.only, name)) names.push_back(name);
    if (names.empty()) return complain({"", "no snapshot has such a name"});
    const Result<std::string> renderer =
        do_all_work(arguments.work, set, names, [&](const GoldenResult& result) { count(result, tally); });
    return renderer ? cli::exit_fine : complain(renderer.error());
}

void remove_golden(const fs::path& goldens, const std::string& name) {
    std::error_code error;
    fs::remove(goldens / (name + ".png"), error);
    fs::remove(goldens / (name + ".json"), error);
    fmt::print("{:<17} {}\n", "removed", name);
}

}  // namespace

int snapshot_approve(const CheckArguments& arguments) {
    if (in_ci() && !arguments.in_ci)
        return complain(
            {"approve",
             "refused inside a CI: it would approve what it should check (use --in-ci to allow it)"},
            cli::exit_bad_usage);
    Result<SuiteSet> set = load_suite_set(arguments.work.suite);
    if (!set) return complain(set.error());
    const fs::path goldens = arguments.work.suite.goldens;
    const std::vector<std::string> orphans =
        arguments.prune ? orphan_goldens(goldens, set->names) : std::vector<std::string>();
    Tally tally;
    const int code = arguments.from.empty() ? approve_rendered(arguments, *set, tally)
                                            : approve_from(arguments, *std::move(set), tally);
    if (code != cli::exit_fine) return code;
    for (const std::string& name : orphans)
        remove_golden(goldens, name);
    for (const std::string& file : unused_attachments(goldens)) {
        std::error_code error;
        fs::remove(goldens / file, error);
        fmt::print("{:<17} {}\n", "removed", file);
    }
    fmt::print("{} approved, {} unchanged, {} failed\n", tally.written, tally.unchanged, tally.failed);
    if (!arguments.reason.empty()) fmt::print("Reason, for the commit: {}\n", arguments.reason);
    return tally.failed == 0 ? cli::exit_fine : cli::exit_check_failed;
}

}  // namespace slipface
