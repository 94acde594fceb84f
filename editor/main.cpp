// The program: the editor, and every verb of the command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "app/glfw_host.h"
#include "app/screens.h"
#include "app/script.h"
#include "cli/manual.h"
#include "cli/program.h"
#include "cli/verbs.h"
#include "document/folders.h"
#include "nightly/nightly_verb.h"
#include "slipface/base/counted.h"
#include "slipface/base/files.h"
#include "slipface/base/system.h"
#include "slipface/mesh/scene_child.h"
#include "snapshot_verb/snapshot_verb.h"
#include "tools/commands/docs.h"
#include "tools/lab/link.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

int complain(const Error& error, int code) {
    fmt::print(stderr, "slipface: {}\n", error.text());
    return code;
}

// Without a display the same editor runs off-screen and writes images.
int show_images(const fs::path& level, const Error& reason) {
    fmt::print("No window ({}). Drawing the editor off-screen instead.\n", reason.message);
    const fs::path editor_png = fs::path("out") / "editor.png", level_png = fs::path("out") / "level.png";
    std::error_code error;
    fs::create_directories("out", error);
    if (const Status status = write_images(level, editor_png, level_png); !status)
        return complain(status.error(), cli::exit_bad_input);
    fmt::print("{}\n", fs::absolute(editor_png, error).string());
    if (!level.empty()) fmt::print("{}\n", fs::absolute(level_png, error).string());
    return cli::exit_fine;
}

// `what`: a level or a link; empty: none.
int open_editor(const std::string& what, float scale) {
    WindowOptions options{.config = config_folder(), .state = state_folder(), .scale = scale};
    std::error_code error;
    if (is_link(what))
        options.link = what;
    else
        options.level = what;
    if (!options.level.empty() && !fs::exists(options.level, error))
        return complain({what, "no such file; expected a level"}, cli::exit_bad_input);
    const Status status = run_window(options);
    return status.ok() ? cli::exit_fine : show_images(options.level, status.error());
}

void print_warnings(const Warnings& warnings) {
    for (const Diagnostic& warning : warnings)
        fmt::print(stderr, "slipface: warning: {}\n", warning.text());
}

// Prints the warnings of every opened level, once per opening.
class WarningPrinter {
  public:
    explicit WarningPrinter(const Editor& editor) : editor_(editor) {}
    void print_new() {
        print_changed(editor_.document ? editor_.document->warnings() : Warnings{}, of_level_);
        print_changed(editor_.texture_warnings, of_textures_);
    }

  private:
    static void print_changed(const Warnings& now, Warnings& before) {
        if (now == before) return;
        print_warnings(now);
        before = now;
    }
    const Editor& editor_;
    Warnings of_level_;
    Warnings of_textures_;
};

std::string level_or_link_help() {
    return cli::level_help() + "; or a link (docs/web.md), or a file *.link with one";
}

struct EditArguments {
    std::string level, script, screenshot, state, size = "1280x720";
    double scale = 0.0;
    bool headless = false;
};

int edit_headless(const EditArguments& arguments) {
    const auto size = parse_size(arguments.size);
    if (!size)
        return complain({"--size", "found \"" + arguments.size + "\", expected a size such as 1280x720"},
                        cli::exit_bad_usage);
    OffscreenOptions options;
    options.width = size->first;
    options.height = size->second;
    options.scale = arguments.scale > 0.0 ? static_cast<float>(arguments.scale) : 1.0f;
    options.state = arguments.state;
    Result<std::unique_ptr<OffscreenHost>> host = OffscreenHost::make(options);
    if (!host) return complain(host.error(), cli::exit_bad_input);
    Editor& editor = (*host)->editor();
    WarningPrinter warnings(editor);
    if (is_link(arguments.level)) {
        if (const Status opened = open_link(editor, arguments.level); !opened)
            return complain(opened.error(), cli::exit_bad_input);
    } else if (!arguments.level.empty()) {
        open_level(editor, arguments.level);
        if (editor.message) return complain({"", editor.message->text}, cli::exit_bad_input);
        (*host)->frame();
        warnings.print_new();
    }
    if (!arguments.script.empty()) {
        const ScriptResult result = run_script_file(**host, arguments.script, [&] { warnings.print_new(); });
        if (!result)
            return complain(result.error, result.failure == ScriptFailure::expectation
                                              ? cli::exit_check_failed
                                              : cli::exit_bad_input);
        fmt::print("{}: {} done\n", arguments.script, counted(result.lines_done, "line"));
    }
    if (!arguments.screenshot.empty()) {
        (*host)->settle();
        if (const Status status = save_png(arguments.screenshot, (*host)->screenshot()); !status)
            return complain(status.error(), cli::exit_bad_input);
        fmt::print("{}\n", arguments.screenshot);
    }
    return cli::exit_fine;
}

void add_edit_verb(CLI::App& app, int& exit_code) {
    auto arguments = std::make_shared<EditArguments>();
    CLI::App* const verb = app.add_subcommand("edit", "Open the editor, or run it off-screen with a script");
    verb->add_option("level", arguments->level, level_or_link_help());
    verb->add_flag("--headless", arguments->headless, "Draw off-screen, without a window");
    verb->add_option("--script", arguments->script, "Script to run (docs/scripting.md); implies --headless");
    verb->add_option("--screenshot", arguments->screenshot, "PNG to write at the end; implies --headless");
    verb->add_option("--state", arguments->state,
                     "Folder for autosaves of an off-screen run; default: no autosaves")
        ->type_name("DIR");
    verb->add_option("--size", arguments->size, "Size of the off-screen window, WxH")->capture_default_str();
    verb->add_option("--scale", arguments->scale, "Pixels per design pixel; the screen's own by default")
        ->check(CLI::Range(0.5, 4.0));
    verb->callback([arguments, &exit_code] {
        const bool off_screen =
            arguments->headless || !arguments->script.empty() || !arguments->screenshot.empty();
        exit_code = off_screen ? edit_headless(*arguments)
                               : open_editor(arguments->level, static_cast<float>(arguments->scale));
    });
}

struct DocsArguments {
    std::string folder = "docs", man, completion;
};

Status write_docs(const DocsArguments& arguments, const CLI::App& app) {
    std::vector<std::pair<fs::path, std::string>> files;
    if (!arguments.man.empty())
        for (const cli::ManualPage& page : cli::manual_pages(app, SLIPFACE_VERSION))
            files.emplace_back(fs::path(arguments.man) / page.file, page.text);
    if (!arguments.completion.empty()) files.emplace_back(arguments.completion, cli::bash_completion(app));
    if (files.empty()) {
        const fs::path folder = arguments.folder;
        files = {{folder / "command-line.md", cli::command_line_markdown(app)},
                 {folder / "commands.md", commands_markdown()},
                 {folder / "settings.md", settings_markdown()},
                 {folder / "scripting.md", script_verbs_markdown()}};
    }
    for (const auto& [file, text] : files)
        if (Status status = write_file_atomic(file, text); !status) return status;
    return {};
}

// Output made from tables: the pages of docs/, which a test compares with them, and files for an
// installation.
void add_docs_verb(CLI::App& app, int& exit_code) {
    auto arguments = std::make_shared<DocsArguments>();
    CLI::App* const verb =
        app.add_subcommand("docs", "Write command-line.md, commands.md, settings.md and scripting.md");
    verb->add_option("folder", arguments->folder, "Where to")->capture_default_str();
    verb->add_option("--man", arguments->man, "Write manual pages to this folder instead")->type_name("DIR");
    verb->add_option("--completion", arguments->completion,
                     "Write the completion for bash to this file instead")
        ->type_name("FILE");
    verb->callback([arguments, &app, &exit_code] {
        if (const Status status = write_docs(*arguments, app); !status)
            exit_code = complain(status.error(), cli::exit_bad_input);
    });
}

void add_samples_verb(CLI::App& app, int& exit_code) {
    CLI::App* const verb = app.add_subcommand("samples", "List the levels that come with the program");
    verb->callback([&exit_code] {
        const std::vector<fs::path> levels = sample_levels();
        for (const fs::path& level : levels)
            fmt::print("{}\n", level.string());
        if (levels.empty())
            exit_code = complain(
                {"samples",
                 "found neither share/slipface/levels next to the program's bin folder nor a source tree"},
                cli::exit_bad_input);
    });
}

// The argument by which the program runs itself to read a file of another program (scene_child.h).
constexpr const char* read_scene_word = "read-scene";

cli::VerbProgram program(std::string& level) {
    return {.name = "slipface",
            .description = "Slipface: level editor and movement lab for 3D platformers",
            .footer = std::string(cli::exit_codes_help) +
                      "\nTo open a level with the name of a verb, write ./NAME.",
            .add =
                [&level](CLI::App& app, int& exit_code) {
                    app.add_option("level", level, level_or_link_help());
                    add_edit_verb(app, exit_code);
                    add_snapshot_verb(app, exit_code);
                    add_nightly_verb(app, exit_code);
                    add_samples_verb(app, exit_code);
                    add_docs_verb(app, exit_code);
                    cli::add_data_verbs(app, exit_code);
                },
            .without_verb = [&level] { return open_editor(level, 0.0f); }};
}

}  // namespace
}  // namespace slipface

int main(int argument_count, char** arguments) {
    using namespace slipface;
    const std::vector<std::string> words = begin_program(argument_count, arguments);
    if (words.size() > 1 && words[1] == read_scene_word)
        return read_scene_as_child({words.begin() + 2, words.end()});
    std::error_code no_proc;
    if (fs::exists("/proc/self/exe", no_proc)) read_scenes_in_child({"/proc/self/exe", read_scene_word});
    std::string level;
    return cli::run_program(program(level), words);
}
