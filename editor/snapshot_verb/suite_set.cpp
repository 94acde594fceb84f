#include "snapshot_verb/suite_set.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "app/screens.h"
#include "slipface/base/text.h"
#include "slipface/level/appearance_files.h"
#include "slipface/level/level_file.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

// Levels from the command line as a suite.
Result<std::vector<Scene>> scenes_of_levels(const SuiteArguments& arguments) {
    const auto size = parse_size(arguments.size);
    if (!size) return Error{"--size", "found \"" + arguments.size + "\", expected a size such as 960x540"};
    nlohmann::json suite{{"version", 1}, {"scenes", nlohmann::json::array()}};
    for (const std::string& level : arguments.levels) {
        std::string name;
        for (const char c : fs::path(level).stem().stem().string())
            name += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ? c : '-';
        nlohmann::json scene{{"name", name.empty() ? "level" : name},
                             {"level", fs::absolute(level).string()},
                             {"cameras", arguments.cameras},
                             {"size", {size->first, size->second}},
                             {"style", arguments.style}};
        if (!arguments.tape.empty()) scene["tape"] = fs::absolute(arguments.tape).string();
        suite["scenes"].push_back(std::move(scene));
    }
    const std::string text = suite.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return parse_scene_suite(text, fs::path("command line"));
}

Result<std::vector<Scene>> scenes_of_suites(const SuiteArguments& arguments) {
    std::vector<Scene> scenes;
    std::vector<std::string> files = arguments.suites;
    const fs::path usual = fs::path(arguments.goldens) / "scenes.json";
    std::error_code error;
    if (files.empty() && fs::exists(usual, error)) files.push_back(usual.string());
    for (const std::string& file : files) {
        const Result<std::vector<Scene>> suite = load_scene_suite(file);
        if (!suite) return suite.error();
        scenes.insert(scenes.end(), suite->begin(), suite->end());
    }
    return scenes;
}

}  // namespace

bool is_wanted(const std::vector<std::string>& patterns, const std::string& name) {
    return patterns.empty() || std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
               return glob_match(pattern, name);
           });
}

std::vector<std::string> SuiteArguments::as_command_line() const {
    std::vector<std::string> line{"--goldens", goldens, "--gl", gl, "--size", size, "--style", style};
    const auto add = [&](const char* option, const std::vector<std::string>& values) {
        for (const std::string& value : values)
            line.insert(line.end(), {option, value});
    };
    add("--suite", suites);
    add("--level", levels);
    if (!levels.empty()) add("--cameras", cameras);
    if (!tape.empty()) add("--tape", {tape});
    return line;
}

Result<SuiteSet> load_suite_set(const SuiteArguments& arguments) {
    std::error_code error;
    if (arguments.levels.empty() && arguments.suites.empty() && !fs::is_directory(arguments.goldens, error))
        return Error{arguments.goldens,
                     "no such folder; expected the goldens (run in the project, or give --goldens)"};
    const Result<std::vector<Scene>> scenes =
        arguments.levels.empty() ? scenes_of_suites(arguments) : scenes_of_levels(arguments);
    if (!scenes) return scenes.error();
    Result<std::vector<Scene>> expanded = expand_suite(*scenes);
    if (!expanded) return expanded.error();
    SuiteSet set;
    set.scenes = *std::move(expanded);
    set.book = std::make_shared<InputBook>(fs::weakly_canonical(arguments.goldens, error).parent_path());
    if (arguments.levels.empty() && arguments.suites.empty())
        set.screens = screen_snapshots(fs::path(arguments.goldens) / "editor", *set.book);
    std::set<fs::path> files(arguments.suites.begin(), arguments.suites.end()), levels;
    for (const Scene& scene : set.scenes) {
        set.names.push_back(scene.name);
        set.inputs[scene.name] = scene_inputs(scene, *set.book);
        if (scene.program) {
            files.merge(program_inputs(scene, *set.book).files);
            continue;
        }
        levels.insert(scene.level);
        if (scene.tape) files.insert(*scene.tape);
    }
    for (const Snapshot& screen : set.screens) {
        set.names.push_back(screen.name);
        set.inputs[screen.name] = screen.inputs;
        files.insert(fs::path(arguments.goldens) / (screen.name + ".script"));
    }
    if (arguments.levels.empty() && arguments.suites.empty())
        files.insert(fs::path(arguments.goldens) / "scenes.json");
    // Images of levels that the command line names have no goldens, so their inputs have none.
    if (arguments.levels.empty())
        for (std::string& name : set.book->names())
            set.names.push_back(std::move(name));
    std::set<fs::path> folders;
    for (const fs::path& level : levels) {
        for (const fs::path& file : files_of_level(level).files)
            files.insert(file);
        if (!folders.insert(level.parent_path()).second) continue;
        for (const fs::path& file : appearance_files(level))
            files.insert(file);
    }
    set.files.assign(files.begin(), files.end());
    return set;
}

Result<Snapshot> Studio::find(const std::string& name) {
    for (const Snapshot& screen : set_.screens)
        if (screen.name == name) return screen;
    if (is_input(name)) return set_.book->snapshot(name);
    const auto found = std::find_if(set_.scenes.begin(), set_.scenes.end(),
                                    [&](const Scene& scene) { return scene.name == name; });
    if (found == set_.scenes.end()) return Error{name, "no snapshot has this name"};
    const Scene& scene = *found;
    if (scene.program)
        return scene_snapshot(
            scene, [&] { return runs_.render(scene, *set_.book); }, *set_.book);
    if (!stage_) {
        Result<std::unique_ptr<OffscreenContext>> context = make_offscreen_context();
        if (!context) return context.error();
        context_ = *std::move(context);
        renderer_ = renderer_line(*context_);
        stage_ = std::make_unique<SceneStage>(*context_, *set_.book);
    }
    return scene_snapshot(
        scene, [&] { return stage_->render(scene); }, *set_.book);
}

Coverage Studio::new_coverage() {
    Coverage news = stage_ ? stage_->coverage() : Coverage();
    std::erase_if(news.reached, [&](const std::string& word) { return told_.reached.contains(word); });
    std::erase_if(news.there, [&](const std::string& word) { return told_.there.contains(word); });
    told_.add(news);
    return news;
}

std::string renderer_line(const OffscreenContext& context) {
    return context.backend_name() + ", " + context.renderer() + ", " + context.version();
}

}  // namespace slipface
