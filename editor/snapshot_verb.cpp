#include "snapshot_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/screens.h"
#include "slipface/base/text.h"
#include "slipface/snapshot/golden.h"

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

void check_one(const CheckArguments& arguments, const Snapshot& snapshot, Totals& totals) {
    const auto report = [&](const char* what, const std::string& message) {
        fmt::print("{:<12} {}{}{}\n", what, snapshot.name, message.empty() ? "" : "  ", message);
        std::fflush(stdout);
    };
    const Result<Image> picture = snapshot.render();
    if (!picture) {
        ++totals.failed;
        return report("FAILED", picture.error().text());
    }
    if (arguments.twice) {
        const Result<Image> again = snapshot.render();
        if (!again || !(*again == *picture)) {
            ++totals.failed;
            return report("UNSTABLE", "two runs gave different pictures");
        }
    }
    const GoldenResult result =
        check_golden(arguments.goldens, snapshot.name, *picture, snapshot.tolerance, arguments.out);
    if (result.state == GoldenState::same) {
        ++totals.same;
        return report("same", "");
    }
    if (arguments.approve) {
        const Status status = approve_golden(arguments.goldens, snapshot.name, *picture, snapshot.tolerance);
        if (status.ok())
            ++totals.approved;
        else
            ++totals.failed;
        return report(status.ok() ? "approved" : "FAILED",
                      status.ok() ? result.message : status.error().text());
    }
    ++totals.failed;
    report(result.state == GoldenState::missing ? "MISSING" : "DIFFERENT", result.message);
}

int check(const CheckArguments& arguments) {
    std::error_code error;
    const fs::path goldens = arguments.goldens;
    if (!fs::is_directory(goldens, error)) {
        fmt::print(
            stderr,
            "slipface: {}: no such folder; expected the goldens (run from the project, or give --goldens)\n",
            arguments.goldens);
        return 2;
    }
    std::vector<Snapshot> snapshots = scene_snapshots(fs::weakly_canonical(goldens, error).parent_path());
    for (Snapshot& screen : screen_snapshots(goldens / "editor"))
        snapshots.push_back(std::move(screen));
    Totals totals;
    int matched = 0;
    for (const Snapshot& snapshot : snapshots) {
        if (!glob_match(arguments.only, snapshot.name)) continue;
        ++matched;
        check_one(arguments, snapshot, totals);
    }
    if (matched == 0) {
        fmt::print(stderr, "slipface: no snapshot is named like \"{}\"\n", arguments.only);
        return 2;
    }
    fmt::print("{} same, {} approved, {} failed\n", totals.same, totals.approved, totals.failed);
    if (totals.failed > 0 && !arguments.approve)
        fmt::print("Pictures: {}. To make them the goldens: slipface snapshot check --only '{}' --approve\n",
                   arguments.out, arguments.only);
    return totals.failed == 0 ? 0 : 1;
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
