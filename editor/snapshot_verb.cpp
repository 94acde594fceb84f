#include "snapshot_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/screens.h"
#include "cli/exit_codes.h"
#include "slipface/base/text.h"
#include "slipface/snapshot/golden.h"
#include "slipface/snapshot/suite.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

struct CheckArguments {
    std::string goldens = "screenshots", out = "out/snapshots", only = "*";
    bool approve = false, twice = false;
};

struct Totals {
    int same = 0, failed = 0, approved = 0;
};

void report(const char* what, const std::string& name, const std::string& message) {
    fmt::print("{:<17} {}{}{}\n", what, name, message.empty() ? "" : "  ", message);
    std::fflush(stdout);
}

void approve_one(const CheckArguments& arguments, const Snapshot& snapshot, const std::string& why,
                 Totals& totals) {
    const Result<Image> picture = snapshot.render();
    const Status status = picture
                              ? approve_golden(arguments.goldens, snapshot.name, *picture, snapshot.tolerance)
                              : Status(picture.error());
    ++(status.ok() ? totals.approved : totals.failed);
    report(status.ok() ? "approved" : "FAILED", snapshot.name, status.ok() ? why : status.error().text());
}

void check_one(const CheckArguments& arguments, const Snapshot& snapshot, Totals& totals) {
    const Result<GoldenResult> result =
        check_snapshot(snapshot, arguments.goldens, arguments.out, arguments.twice);
    if (!result) {
        ++totals.failed;
        return report("FAILED", snapshot.name, result.error().text());
    }
    if (result->state == GoldenState::same) {
        ++totals.same;
        return report("same", snapshot.name, "");
    }
    if (arguments.approve && result->state != GoldenState::nondeterministic)
        return approve_one(arguments, snapshot, result->message, totals);
    ++totals.failed;
    report(golden_state_name(result->state), snapshot.name, result->message);
}

// Those of `snapshots` that are asked for. Returns how many.
int check_all(const CheckArguments& arguments, const std::vector<Snapshot>& snapshots, Totals& totals) {
    int matched = 0;
    for (const Snapshot& snapshot : snapshots) {
        if (!glob_match(arguments.only, snapshot.name)) continue;
        ++matched;
        check_one(arguments, snapshot, totals);
    }
    return matched;
}

int bad_input(const std::string& message) {
    fmt::print(stderr, "slipface: {}\n", message);
    return cli::exit_bad_input;
}

int check(const CheckArguments& arguments) {
    std::error_code error;
    const fs::path goldens = arguments.goldens;
    if (!fs::is_directory(goldens, error))
        return bad_input(arguments.goldens +
                         ": no such folder; expected the goldens (run in the project, or give --goldens)");
    const std::vector<Snapshot> screens = screen_snapshots(goldens / "editor");
    std::vector<Snapshot> all = screens;
    Totals totals;
    int matched = 0;
    if (fs::exists(goldens / "scenes.json", error)) {
        const Result<std::vector<Scene>> suite = load_scene_suite(goldens / "scenes.json");
        if (!suite) return bad_input(suite.error().text());
        // Scenes share one context; the screens, which make their own, come when it is gone.
        Result<std::unique_ptr<OffscreenContext>> context = make_offscreen_context();
        if (!context) return bad_input(context.error().text());
        const std::vector<Snapshot> scenes = scene_snapshots(*suite, **context);
        matched += check_all(arguments, scenes, totals);
        all.insert(all.end(), scenes.begin(), scenes.end());
    }
    matched += check_all(arguments, screens, totals);
    if (matched == 0) return bad_input("no snapshot is named like \"" + arguments.only + "\"");
    if (arguments.only == "*")
        for (const std::string& orphan : orphan_goldens(goldens, all)) {
            ++totals.failed;
            report("orphan", orphan, "no snapshot makes this golden");
        }
    fmt::print("{} same, {} approved, {} failed\n", totals.same, totals.approved, totals.failed);
    if (totals.failed > 0 && !arguments.approve)
        fmt::print("Pictures: {}. To make them the goldens: slipface snapshot check --only '{}' --approve\n",
                   arguments.out, arguments.only);
    return totals.failed == 0 ? cli::exit_fine : cli::exit_check_failed;
}

}  // namespace

void add_snapshot_verb(CLI::App& app, int& exit_code) {
    CLI::App* const verb =
        app.add_subcommand("snapshot", "Compare pictures of scenes and of the editor with the approved ones");
    verb->require_subcommand(1);
    auto arguments = std::make_shared<CheckArguments>();
    CLI::App* const check_verb =
        verb->add_subcommand("check", "Render every snapshot and compare it with its golden");
    check_verb->add_option("--goldens", arguments->goldens, "Folder of the goldens")->capture_default_str();
    check_verb->add_option("--out", arguments->out, "Folder for pictures of what differs")
        ->capture_default_str();
    check_verb->add_option("--only", arguments->only, "Names to check, with * and ?")->capture_default_str();
    check_verb->add_flag("--approve", arguments->approve, "Make what differs or is missing the golden");
    check_verb->add_flag("--twice", arguments->twice, "Render twice and fail where the two differ");
    check_verb->callback([arguments, &exit_code] { exit_code = check(*arguments); });
}

}  // namespace slipface
