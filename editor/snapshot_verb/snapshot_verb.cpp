#include "snapshot_verb/snapshot_verb.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "cli/exit_codes.h"
#include "cli/options.h"
#include "snapshot_verb/check.h"
#include "snapshot_verb/history.h"
#include "snapshot_verb/opengl_check.h"
#include "snapshot_verb/review.h"

namespace slipface {
namespace {

using Shared = std::shared_ptr<CheckArguments>;

int usual_jobs() {
    const unsigned processors = std::thread::hardware_concurrency();
    return static_cast<int>(processors == 0 ? 1 : std::min(processors, 16U));
}

// All contexts of this process and of its workers are then made by that library.
void choose_gl(const Shared& arguments) {
    if (arguments->work.suite.gl != "auto") ::setenv("SLIPFACE_GL", arguments->work.suite.gl.c_str(), 1);
}

void add_gl(CLI::App& verb, const Shared& arguments) {
    verb.add_option("--gl", arguments->work.suite.gl, "OpenGL library: auto, osmesa or egl")
        ->capture_default_str()
        ->check(CLI::IsMember({"auto", "osmesa", "egl"}));
}

// The options that name snapshots.
void add_suite(CLI::App& verb, const Shared& arguments) {
    SuiteArguments& suite = arguments->work.suite;
    verb.add_option("--goldens", suite.goldens, "Folder of the goldens")->capture_default_str();
    verb.add_option("--suite", suite.suites,
                    "Suite files, instead of GOLDENS/scenes.json and GOLDENS/editor");
    add_gl(verb, arguments);
}

void add_levels(CLI::App& verb, const Shared& arguments, const char* name) {
    SuiteArguments& suite = arguments->work.suite;
    verb.add_option(name, suite.levels, "Levels to render, instead of the suites");
    verb.add_option("--cameras", suite.cameras, "For levels: cameras, as in a suite");
    verb.add_option("--size", suite.size, "For levels: size of the images")->capture_default_str();
    verb.add_option("--style", suite.style, "For levels: style, as in a suite")->capture_default_str();
    verb.add_option("--tape", suite.tape, "For levels: a tape to draw");
}

// The options that choose among them and divide the work.
void add_choice(CLI::App& verb, const Shared& arguments) {
    verb.add_option("--only", arguments->only, "Names, with * and ?");
    verb.add_option("--out", arguments->work.out, "Folder for images and reports")->capture_default_str();
    verb.add_option("--jobs", arguments->work.jobs, "Processes at a time")
        ->capture_default_str()
        ->check(CLI::Range(1, 256));
    cli::add_shard_option(verb, arguments->shard, "snapshots");
    verb.add_flag("--quiet", arguments->quiet, "Only what differs");
    verb.add_flag("--timing", arguments->timing, "Report how much of the time was rasterising");
}

Shared new_arguments(WorkKind kind) {
    auto arguments = std::make_shared<CheckArguments>();
    arguments->work.kind = kind;
    arguments->work.jobs = usual_jobs();
    return arguments;
}

void add_check_verbs(CLI::App& group, int& exit_code) {
    const Shared check = new_arguments(WorkKind::check);
    CLI::App* const verb =
        group.add_subcommand("check", "Render every snapshot and compare it with its golden");
    add_suite(*verb, check);
    add_choice(*verb, check);
    verb->add_flag("--twice", check->work.twice, "Render twice and fail where the two differ");
    verb->add_flag("--detailed-exit", check->detailed,
                   "1 differences, 2 only missing or orphans, 3 not rendered, 4 golden unreadable");
    verb->callback([check, &exit_code] {
        choose_gl(check);
        exit_code = snapshot_check(*check);
    });

    const Shared compare = new_arguments(WorkKind::check);
    compare->actual = "out/rendered";
    compare->detailed = true;
    CLI::App* const compare_verb =
        group.add_subcommand("compare", "Compare images from an earlier `render` with the goldens");
    add_suite(*compare_verb, compare);
    add_choice(*compare_verb, compare);
    compare_verb->add_option("--actual", compare->actual, "Folder of the images")->capture_default_str();
    compare_verb->callback([compare, &exit_code] {
        choose_gl(compare);
        exit_code = snapshot_compare(*compare);
    });
}

void add_render_verb(CLI::App& group, int& exit_code) {
    const Shared render = new_arguments(WorkKind::render);
    render->work.out = "out/rendered";
    CLI::App* const verb = group.add_subcommand("render", "Render images of the suites or of levels");
    add_suite(*verb, render);
    add_levels(*verb, render, "level");
    add_choice(*verb, render);
    verb->add_flag("--sheet", render->sheet,
                   "Also write contact sheets: many images with their names on a few pages");
    verb->callback([render, &exit_code] {
        choose_gl(render);
        exit_code = snapshot_render(*render);
    });
}

void add_approve_verb(CLI::App& group, int& exit_code) {
    const Shared approve = new_arguments(WorkKind::approve);
    CLI::App* const verb = group.add_subcommand(
        "approve", "Approve: make the new image the golden where it differs or is missing");
    add_suite(*verb, approve);
    verb->add_option("name", approve->only, "Names, with * and ?; none: all");
    verb->add_option("--from", approve->from, "A report.json: approve that check's images without rendering");
    verb->add_option("--act", approve->act, "With --from: only what this act changed, with * and ?");
    verb->add_option("--jobs", approve->work.jobs, "Processes at a time")
        ->capture_default_str()
        ->check(CLI::Range(1, 256));
    verb->add_option("--reason", approve->reason, "Reason, printed at the end for the commit message");
    verb->add_flag("--force", approve->work.force, "Rewrite what passes, too");
    verb->add_flag("--quick", approve->work.quick, "Compress images fast instead of small");
    verb->add_flag("--prune", approve->prune, "Remove goldens that no snapshot makes");
    verb->add_flag(
        "--here", approve->work.here,
        "Where other releases of the drawing libraries drew the golden, keep it, and add images for these");
    verb->add_flag("--any-renderer", approve->work.any_renderer,
                   "Also from a renderer other than Mesa's software one");
    verb->add_flag("--in-ci", approve->in_ci, "Also inside a CI");
    verb->callback([approve, &exit_code] {
        choose_gl(approve);
        exit_code = snapshot_approve(*approve);
    });
}

void add_report_verbs(CLI::App& group, int& exit_code) {
    const Shared review = new_arguments(WorkKind::check);
    review->from = "out/snapshots/report.json";
    CLI::App* const review_verb =
        group.add_subcommand("review", "Review the findings of a check in the editor");
    review_verb->add_option("report", review->from, "The check's report.json")->capture_default_str();
    review_verb->callback([review, &exit_code] { exit_code = snapshot_review(review->from); });

    const Shared list = new_arguments(WorkKind::check);
    CLI::App* const list_verb = group.add_subcommand("list", "Name every snapshot and its golden");
    add_suite(*list_verb, list);
    list_verb->add_option("--only", list->only, "Names, with * and ?");
    list_verb->add_flag("--orphans", list->orphans_only,
                        "Only goldens that no snapshot makes; 2 if there are any");
    list_verb->add_flag("--json", list->json, "As JSON");
    list_verb->add_flag("--fingerprint", list->fingerprint,
                        "Only a hash of all that a check depends on: files, goldens, program");
    list_verb->callback([list, &exit_code] { exit_code = snapshot_list(*list); });

    const Shared merge = new_arguments(WorkKind::check);
    const auto reports = std::make_shared<std::vector<std::string>>();
    CLI::App* const merge_verb = group.add_subcommand("merge", "Merge the reports of shards");
    merge_verb->add_option("report", *reports, "report.json of each shard")->required();
    merge_verb->add_option("--out", merge->work.out, "Folder of the merged report")->capture_default_str();
    merge_verb->add_flag("--detailed-exit", merge->detailed, "As for check");
    merge_verb->callback([merge, reports, &exit_code] { exit_code = snapshot_merge(*reports, *merge); });
}

void add_git_verbs(CLI::App& group, int& exit_code) {
    const Shared history = new_arguments(WorkKind::check);
    CLI::App* const history_verb = group.add_subcommand("history", "What changed a golden, commit by commit");
    const auto name = std::make_shared<std::string>();
    history_verb->add_option("name", *name, "A snapshot, or one of its inputs")->required();
    history_verb->add_option("--goldens", history->work.suite.goldens, "Folder of the goldens")
        ->capture_default_str();
    history_verb->callback(
        [history, name, &exit_code] { exit_code = snapshot_history(history->work.suite.goldens, *name); });

    const auto files = std::make_shared<std::array<std::string, 3>>();
    const auto path = std::make_shared<std::string>();
    CLI::App* const merge_verb =
        group.add_subcommand("merge-driver", "Merge numbers and facts of two branches: a driver for git");
    merge_verb->add_option("base", (*files)[0], "%O")->required();
    merge_verb->add_option("ours", (*files)[1], "%A, which is written")->required();
    merge_verb->add_option("theirs", (*files)[2], "%B")->required();
    merge_verb->add_option("path", *path, "%P, for messages")->required();
    merge_verb->callback([files, path, &exit_code] { exit_code = snapshot_merge_driver(*files, *path); });
}

void add_diff_verb(CLI::App& group, int& exit_code) {
    struct Files {
        std::string expected, actual, profile = "scene", image;
        bool json = false;
    };
    const auto files = std::make_shared<Files>();
    CLI::App* const verb = group.add_subcommand("diff", "Compare two images with the gate");
    verb->add_option("expected", files->expected, "PNG")->required();
    verb->add_option("actual", files->actual, "PNG")->required();
    verb->add_option("--profile", files->profile, "scene or ui")
        ->capture_default_str()
        ->check(CLI::IsMember({"scene", "ui"}));
    verb->add_option("--out", files->image, "PNG to write: where they differ");
    verb->add_flag("--json", files->json, "As JSON");
    verb->callback([files, &exit_code] {
        exit_code = snapshot_diff(files->expected, files->actual, files->profile, files->image, files->json);
    });
}

void add_opengl_verb(CLI::App& group, int& exit_code) {
    const Shared arguments = new_arguments(WorkKind::check);
    const auto part = std::make_shared<std::string>();
    const auto images = std::make_shared<std::vector<std::string>>();
    CLI::App* const verb =
        group.add_subcommand("opengl", "Test whether images can be trusted on this machine");
    verb->add_option("picture", *images, "More images for the gate's self-test");
    verb->add_option("--part", *part)->group("");
    verb->add_option("--gl", arguments->work.suite.gl)->group("");
    verb->callback([arguments, part, images, &exit_code] {
        choose_gl(arguments);
        exit_code = part->empty() ? check_opengl(*images) : check_opengl_part(*part);
    });
}

// Internal: one of the processes of --jobs.
void add_worker_verb(CLI::App& group, int& exit_code) {
    const Shared worker = new_arguments(WorkKind::check);
    CLI::App* const verb = group.add_subcommand("worker", "")->group("");
    add_suite(*verb, worker);
    add_levels(*verb, worker, "--level");
    verb->add_option("--out", worker->work.out);
    verb->add_option_function<std::string>("--kind", [worker](const std::string& kind) {
        worker->work.kind = kind == "render"    ? WorkKind::render
                            : kind == "approve" ? WorkKind::approve
                                                : WorkKind::check;
    });
    verb->add_flag("--twice", worker->work.twice);
    verb->add_flag("--force", worker->work.force);
    verb->add_flag("--quick", worker->work.quick);
    verb->add_flag("--here", worker->work.here);
    verb->add_flag("--any-renderer", worker->work.any_renderer);
    verb->callback([worker, &exit_code] {
        choose_gl(worker);
        exit_code = run_worker(worker->work);
    });
}

}  // namespace

void add_snapshot_verb(CLI::App& app, int& exit_code) {
    CLI::App* const group =
        app.add_subcommand("snapshot", "Compare images of scenes and of the editor with the approved ones");
    group->require_subcommand(1);
    add_check_verbs(*group, exit_code);
    add_render_verb(*group, exit_code);
    add_approve_verb(*group, exit_code);
    add_report_verbs(*group, exit_code);
    add_git_verbs(*group, exit_code);
    add_diff_verb(*group, exit_code);
    add_opengl_verb(*group, exit_code);
    add_worker_verb(*group, exit_code);
}

}  // namespace slipface
