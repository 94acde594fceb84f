// Verbs that exchange files with other programs: import, name-materials, export.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/format.h"
#include "cli/verbs.h"
#include "slipface/base/counted.h"
#include "slipface/base/system.h"
#include "slipface/exchange/export.h"
#include "slipface/exchange/name_materials.h"
#include "slipface/exchange/rules.h"

namespace slipface::cli {
namespace {

std::optional<std::filesystem::path> given(const std::string& word) {
    return word.empty() ? std::nullopt : std::optional(path_of(word));
}

void add_name_materials(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("name-materials",
                                        "Write painted types into the material names of a level's OBJ file");
    auto level = std::make_shared<std::string>();
    verb->add_option("LEVEL", *level, level_help())->required();
    verb->callback(
        [level, &exit_code] { exit_code = run_name_materials(path_of(*level), std::cout, std::cerr); });

    CLI::App* former = app.add_subcommand("bake", "Former name of name-materials")->group("")->allow_extras();
    former->callback([&exit_code] {
        print_error(std::cerr, {"bake", "is called name-materials now; bake-light bakes light"});
        exit_code = exit_bad_usage;
    });
}

void add_export(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("export", "Write a level with its types for other programs");
    struct Words {
        std::string level, obj, gltf, flat;
    };
    auto words = std::make_shared<Words>();
    verb->add_option("LEVEL", words->level, level_help())->required();
    auto* targets = verb->add_option_group("targets", "At least one of");
    targets->add_option("--obj", words->obj, "OBJ and MTL, types in material names")->type_name("OUT.obj");
    targets->add_option("--gltf", words->gltf, "glTF 2.0, types in extras")->type_name("OUT.gltf|OUT.glb");
    targets->add_option("--flat", words->flat, "Triangles, each with its type, for games")->type_name("OUT");
    targets->require_option(1, 3);
    verb->callback([words, &exit_code] {
        const ExportOptions options{path_of(words->level),
                                    {given(words->obj), given(words->gltf), given(words->flat)}};
        exit_code = run_export(options, std::cout, std::cerr);
    });
}

void add_import(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand(
        "import",
        "Import material rules from other programs, and set scale, up axis and facing of a level's geometry");
    struct Words {
        std::string level, up, flip;
        std::vector<std::string> rules;
        double scale = 1.0;
    };
    auto words = std::make_shared<Words>();
    verb->add_option("LEVEL", words->level, level_help())->required();
    verb->add_option("--rules", words->rules,
                     "Quake 3 shaders or map, another level file, or lines PATTERN TYPE; may be repeated")
        ->type_name("FILE.shader|.bsp|.json|.txt")
        ->allow_extra_args(false);
    CLI::Option* scale = verb->add_option("--scale", words->scale, "Metres per unit of the geometry file")
                             ->check(CLI::Range(smallest_import_scale, largest_import_scale));
    verb->add_option("--up", words->up, "Upward axis of the geometry's file")
        ->check(CLI::IsMember(std::vector<std::string>(std::begin(up_axis_names), std::end(up_axis_names))));
    verb->add_option("--flip", words->flip, "Whether all faces look the other way than in the file")
        ->check(CLI::IsMember(std::vector<std::string>{"yes", "no"}));
    verb->callback([words, scale, &exit_code] {
        ImportVerbOptions options;
        options.level = path_of(words->level);
        for (const std::string& file : words->rules)
            options.rules.push_back(path_of(file));
        if (scale->count() > 0) options.scale = words->scale;
        if (!words->flip.empty()) options.flip = words->flip == "yes";
        const auto* const up = std::find(std::begin(up_axis_names), std::end(up_axis_names), words->up);
        if (up != std::end(up_axis_names)) options.up = static_cast<UpAxis>(up - std::begin(up_axis_names));
        exit_code = run_import(options, std::cout, std::cerr);
    });
}

}  // namespace

int run_name_materials(const std::filesystem::path& path, std::ostream& out, std::ostream& err) {
    const Result<LoadedLevel> loaded = load_level(path);
    if (!loaded) return bad_input(err, loaded.error());
    print_warnings(err, loaded->warnings);
    const Result<NamedMaterials> named = name_materials(loaded->level);
    if (!named) return bad_input(err, named.error());
    out << named->text() << '\n';
    return exit_fine;
}

int run_export(const ExportOptions& options, std::ostream& out, std::ostream& err) {
    const Result<LoadedLevel> loaded = load_level(options.level);
    if (!loaded) return bad_input(err, loaded.error());
    print_warnings(err, loaded->warnings);
    const auto& [obj, gltf, flat] = options.targets;
    if (const Status status = export_level(loaded->level, options.targets); !status)
        return bad_input(err, status.error());
    for (const auto& target : {obj, gltf, flat})
        if (target) out << target->string() << '\n';
    return exit_fine;
}

int run_import(const ImportVerbOptions& options, std::ostream& out, std::ostream& err) {
    Result<LoadedLevel> loaded = load_level(options.level);
    if (!loaded) return bad_input(err, loaded.error());
    print_warnings(err, loaded->warnings);
    ImportTransform transform = loaded->level.import_transform;
    if (options.scale) transform.scale = options.scale;
    if (options.up) transform.up = options.up;
    if (options.flip) transform.flip = *options.flip;
    if (transform != loaded->level.import_transform) {
        loaded = reload_mesh(loaded->level, transform);
        if (!loaded) return bad_input(err, loaded.error());
    }
    Level& level = loaded->level;
    AddedRules total;
    for (const std::filesystem::path& file : options.rules) {
        const Result<ImportedRules> rules = read_rules(file);
        if (!rules) return bad_input(err, rules.error());
        print_warnings(err, rules->warnings);
        const Result<AddedRules> added = add_rules(level, *rules);
        if (!added) return bad_input(err, added.error());
        total.types += added->types;
        total.rules += added->rules;
    }
    if (const Status status = save_level(level); !status) return bad_input(err, status.error());
    const ResolvedSurfaces resolved = resolve_surfaces(level);
    const auto by_rule = static_cast<std::size_t>(
        std::count(resolved.source.begin(), resolved.source.end(), SurfaceSource::rule));
    out << fmt::format("{} and {} added; {} now get their type from a rule\n{}\n",
                       counted(total.rules, "rule"), counted(total.types, "type"), counted(by_rule, "face"),
                       level.file_path.string());
    return exit_fine;
}

void add_exchange_verbs(CLI::App& app, int& exit_code) {
    add_import(app, exit_code);
    add_name_materials(app, exit_code);
    add_export(app, exit_code);
}

}  // namespace slipface::cli
