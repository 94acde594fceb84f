#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "cli/options.h"
#include "cli/verbs.h"
#include "slipface/base/system.h"
#include "slipface/level/level_file.h"
#include "slipface/light/bake.h"

namespace slipface::cli {
namespace {

struct BakeLightOptions {
    std::filesystem::path level;
    int rays = LightQuality{}.sky_rays;
    double texel_m = 0.0;  // 0: the level's value
};

Result<std::filesystem::path> bake(const BakeLightOptions& options, Warnings& warnings) {
    Result<LoadedLevel> loaded = load_level(options.level);
    if (!loaded) return loaded.error();
    warnings = loaded->warnings;
    Level& level = loaded->level;
    if (!level.light) level.light = LevelLight{.sun_color = {1.0, 0.95, 0.85}};
    if (options.texel_m > 0.0) level.light->texel_m = options.texel_m;
    if (Status status = bake_level_light(level, {.sky_rays = options.rays}); !status) return status.error();
    return level.file_path.parent_path() / path_of(level.light->image);
}

}  // namespace

void add_bake_light_verb(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("bake-light", "Bake a level's light and shadow into an image");
    auto options = std::make_shared<BakeLightOptions>();
    add_path(*verb, "LEVEL", options->level, level_help())->required();
    verb->add_option("--rays", options->rays, "Rays a texel")
        ->capture_default_str()
        ->check(CLI::Range(1, 4096));
    verb->add_option("--texel", options->texel_m, "Texel size in metres; default: the level's")
        ->check(CLI::Range(0.01, 100.0));
    verb->callback([options, &exit_code] {
        Warnings warnings;
        const Result<std::filesystem::path> image = bake(*options, warnings);
        print_warnings(std::cerr, warnings);
        if (image) {
            std::cout << image->string() << '\n';
        } else {
            print_error(std::cerr, image.error());
            exit_code = exit_bad_input;
        }
    });
}

}  // namespace slipface::cli
