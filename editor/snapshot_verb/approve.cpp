// Making images the goldens: rendered again, or as a check has left them.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/exit_codes.h"
#include "goldens/numbers_json.h"
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
    const nlohmann::json inputs =
        nlohmann::json::parse(seen.numbers, nullptr, false).value("inputs", nlohmann::json());
    for (const std::string& input : snapshot->inputs) {
        const Result<Input> now = snapshot->input(input);
        if (now && inputs.is_object() && inputs.value(input, "") == input_mark(now->facts, now->bytes))
            continue;
        result.message =
            fmt::format("{} has changed since that check; run it again", input.substr(input_folder.size()));
        return result;
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

bool made_by(const GoldenResult& entry, const std::string& act) {
    return std::any_of(entry.findings.begin(), entry.findings.end(), [&](const Finding& finding) {
        return finding.act && (finding.text == act || glob_match(act, finding.text));
    });
}

using Names = std::set<std::string>;

// The snapshots to approve, and of those of a report that must not be looked at again, as they were the same.
Status choose(const CheckArguments& arguments, const SuiteSet& set, Names& chosen, Names& same) {
    if (arguments.from.empty()) {
        for (const std::string& name : set.names)
            if (is_wanted(arguments.only, name)) chosen.insert(name);
        return chosen.empty() ? Status(Error{"", "no snapshot has such a name"}) : Status();
    }
    const Result<std::string> text = read_file(arguments.from, std::uint64_t{256} << 20U);
    if (!text) return text.error();
    const Result<Report> report = report_from_json(*text, arguments.from);
    if (!report) return report.error();
    for (const GoldenResult& entry : report->entries) {
        if (entry.state == GoldenState::same) same.insert(entry.name);
        if (can_be_approved(entry) && is_wanted(arguments.only, entry.name) &&
            (arguments.act.empty() || made_by(entry, arguments.act)))
            chosen.insert(entry.name);
    }
    if (chosen.empty()) return Error{arguments.from, "this report has nothing to approve under these names"};
    return {};
}

// Images first. An input follows once no image that shows it is left red: until then the approved one says
// what was done to those.
int approve_chosen(const CheckArguments& arguments, const SuiteSet& set, const Names& chosen,
                   const Names& same, Tally& tally) {
    Names images, inputs, failed;
    const Names known(set.names.begin(), set.names.end());
    for (const std::string& name : chosen) {
        if (is_input(name))
            inputs.insert(name);
        else
            images.insert(name);
        if (const auto of = set.inputs.find(name); of != set.inputs.end())
            inputs.insert(of->second.begin(), of->second.end());
    }
    Studio studio(set);
    const auto done = [&](const GoldenResult& result) {
        if (result.state != GoldenState::same) failed.insert(result.name);
        count(result, tally);
    };
    const auto in_order = [&](const Names& names) {  // grouped by level, as the suite has them
        std::vector<std::string> list;
        std::copy_if(set.names.begin(), set.names.end(), std::back_inserter(list),
                     [&](const std::string& name) { return names.contains(name); });
        return list;
    };
    if (arguments.from.empty()) {
        const Result<std::string> renderer = do_all_work(arguments.work, set, in_order(images), done);
        if (!renderer) return complain(renderer.error());
    } else {
        for (const std::string& name : images)
            done(approve_seen(studio, arguments, fs::path(arguments.from).parent_path(), name));
    }
    WorkArguments check = arguments.work;
    check.kind = WorkKind::check;
    check.out = (fs::path(arguments.work.out) / "approve").string();
    Names red = failed, seen = same;
    seen.insert(images.begin(), images.end());
    for (const std::string& input : inputs) {
        if (!known.contains(input)) continue;
        const bool differs = arguments.work.force || do_work(studio, check, input).state != GoldenState::same;
        const bool was_approved = fs::exists(fs::path(arguments.work.suite.goldens) / (input + ".json"));
        Names open, users;
        for (const auto& [name, of] : set.inputs) {
            if (std::find(of.begin(), of.end(), input) == of.end()) continue;
            users.insert(name);
            if (!seen.contains(name)) open.insert(name);
        }
        if (!open.empty() && !differs) continue;
        if (!open.empty() && was_approved) {
            const Result<std::string> renderer =
                do_all_work(check, set, in_order(open), [&](const GoldenResult& result) {
                    if (result.state != GoldenState::same) red.insert(result.name);
                });
            if (!renderer) return complain(renderer.error());
            seen.insert(open.begin(), open.end());
        }
        Names left;
        std::set_intersection(users.begin(), users.end(), red.begin(), red.end(),
                              std::inserter(left, left.end()));
        if (was_approved && !left.empty()) {
            fmt::print("{:<17} {}  stays as it was approved: {} of its images {} still red, such as {}\n",
                       "kept", input, left.size(), left.size() == 1 ? "is" : "are", *left.begin());
            continue;
        }
        done(do_work(studio, arguments.work, input));
    }
    std::error_code error;
    fs::remove_all(check.out, error);
    return cli::exit_fine;
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
    Names chosen, same;
    if (Status status = choose(arguments, *set, chosen, same); !status) return complain(status.error());
    const int code = approve_chosen(arguments, *set, chosen, same, tally);
    if (code != cli::exit_fine) return code;
    for (const std::string& name : orphans)
        remove_golden(goldens, name);
    fmt::print("{} approved, {} unchanged, {} failed\n", tally.written, tally.unchanged, tally.failed);
    if (!arguments.reason.empty()) fmt::print("Reason, for the commit: {}\n", arguments.reason);
    return tally.failed == 0 ? cli::exit_fine : cli::exit_check_failed;
}

}  // namespace slipface
