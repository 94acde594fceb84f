// slipface demo: writes the hacks' demos as files to open, play and change. slipface preset: writes sets of
// movement settings as files.
#include "slipface/scenes/demo.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "cli/format.h"
#include "cli/options.h"
#include "cli/verbs.h"
#include "slipface/level/preset.h"

namespace slipface::cli {
namespace {

struct DemoOptions {
    std::string name;
    std::filesystem::path out;
};

int list_demos() {
    for (const DemoInfo& info : demo_table())
        print_row(std::cout, info.name, sentences_of(info));
    return exit_fine;
}

int write_demos(const DemoOptions& options) {
    const DemoInfo* const wanted = find_demo(options.name);
    if (wanted == nullptr && options.name != "all")
        return bad_input(std::cerr,
                         {"demo", "found no demo \"" + options.name + "\"; 'slipface demo' lists them"});
    for (const DemoInfo& info : demo_table()) {
        if (wanted != nullptr && &info != wanted) continue;
        const Result<std::filesystem::path> written = save_demo(info, options.out);
        if (!written) return bad_input(std::cerr, written.error());
        std::cout << written->string() << "\n";
    }
    return exit_fine;
}

struct PresetOptions {
    std::string name;
    std::filesystem::path out;
};

int list_presets() {
    for (const ShippedPreset& shipped : shipped_presets())
        print_row(std::cout, shipped.id, shipped.preset.about);
    return exit_fine;
}

int write_preset(const PresetOptions& options) {
    const Result<Preset> preset = find_preset(options.name);
    if (!preset) return bad_input(std::cerr, preset.error());
    if (options.out.empty()) {
        std::cout << preset_to_json(*preset);
        return exit_fine;
    }
    if (const Status status = save_preset(options.out, *preset); !status)
        return bad_input(std::cerr, status.error());
    return exit_fine;
}

}  // namespace

void add_demo_verbs(CLI::App& app, int& exit_code) {
    CLI::App* demo =
        app.add_subcommand("demo", "List the demos of the hacks, or write one as a level with its tape");
    auto demo_options = std::make_shared<DemoOptions>();
    demo_options->out = ".";
    demo->add_option("NAME", demo_options->name, "A demo, or all; none lists them");
    add_path(*demo, "--out", demo_options->out, "Folder to write into")->type_name("FOLDER");
    demo->callback([demo_options, &exit_code] {
        exit_code = demo_options->name.empty() ? list_demos() : write_demos(*demo_options);
    });

    CLI::App* preset = app.add_subcommand("preset", "List the presets of movement settings, or write one");
    auto preset_options = std::make_shared<PresetOptions>();
    preset->add_option("NAME", preset_options->name, "A preset or a preset file; none lists them");
    add_path(*preset, "--out", preset_options->out, "File to write instead of printing it")
        ->type_name("FILE");
    preset->callback([preset_options, &exit_code] {
        exit_code = preset_options->name.empty() ? list_presets() : write_preset(*preset_options);
    });
}

}  // namespace slipface::cli
