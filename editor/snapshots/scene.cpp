#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include "goldens/camera_names.h"
#include "slipface/scenes/demo.h"
#include "slipface/view/camera.h"
#include "snapshots/other_programs.h"
#include "snapshots/scene_camera.h"
#include "snapshots/scene_movement.h"
#include "snapshots/scene_stage.h"

namespace slipface {

namespace {

Error at_scene(const Scene& scene, const char* key, const Error& error) {
    return {scene.location + key, error.text()};
}

Numbers camera_json(const Scene& scene, const Camera& camera) {
    Numbers json;
    const auto* name = std::get_if<std::string>(&scene.camera);
    json["name"] = name != nullptr ? *name : "given";
    json["eye"] = json_of(camera.eye);
    json["target"] = json_of(camera.target);
    if (camera.orthographic) {
        json["ortho_height"] = camera.ortho_height;
    } else {
        json["fov_y"] = camera.fov_y;
    }
    return json;
}

std::string style_text(const Scene& scene) {
    std::string text;
    const auto word = [&](bool said, const char* w) {
        if (said) text += (text.empty() ? "" : " ") + std::string(w);
    };
    word(scene.style.textured, "textured");
    word(!scene.style.baked_light, "unlit");
    word(scene.style.overlay > 0.0f, "overlay");
    word(scene.style.wireframe, "wireframe");
    word(!scene.style.back_faces, "cutaway");
    word(scene.grid, "grid");
    return text.empty() ? "plain" : text;
}

// "auto:iso:2" as "iso-2", for file names.
std::string camera_suffix(std::string_view camera) {
    if (camera.starts_with("auto:")) camera.remove_prefix(5);
    std::string suffix;
    for (const char c : camera.substr(0, camera.find('/'))) {
        const bool kept =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
        suffix += kept ? c : '-';
    }
    return suffix;
}

bool wants_grid(const Scene& scene) {
    const auto* name = std::get_if<std::string>(&scene.camera);
    return scene.grid || (name != nullptr && *name == "auto:map");
}

// The row of the suite by meaning, whatever order and words it was written in.
Numbers row_json(const Scene& scene) {
    Numbers row = {
        {"kind", "row"}, {"size", Numbers::array({scene.width, scene.height})}, {"style", style_text(scene)}};
    if (const auto* camera = std::get_if<Camera>(&scene.camera))
        row["camera"] = {
            {"eye", json_of(camera->eye)}, {"target", json_of(camera->target)}, {"fov_y", camera->fov_y}};
    else
        row["camera"] = std::get<std::string>(scene.camera);
    if (scene.probe) {
        row["probe"] = {{"from", scene.probe->from ? json_of(*scene.probe->from) : Numbers("spawn")},
                        {"move", json_of(scene.probe->move)}};
        if (scene.probe->radii) row["probe"]["radii"] = json_of(*scene.probe->radii);
        if (!scene.probe->settings.empty()) row["probe"]["settings"] = scene.probe->settings;
    }
    if (!scene.settings.empty()) row["settings"] = scene.settings;
    add_comparison(row, scene);
    return row;
}

}  // namespace

void add_comparison(Numbers& row, const Scene& scene) {
    row["profile"] = scene.tolerance.pixel_delta == ui_tolerance.pixel_delta ? "ui" : "scene";
    row["masks"] = Numbers::array();
    for (const MaskRect& mask : scene.masks)
        row["masks"].push_back(Numbers::array({mask.x, mask.y, mask.width, mask.height}));
}

struct SceneStage::Impl {
    Impl(OffscreenContext& of, InputBook& inputs) : context(of), book(inputs) {}

    struct OnStage {
        std::unique_ptr<StagedLevel> staged;
        std::unique_ptr<LevelPainter> painter;
    };

    OffscreenContext& context;
    InputBook& book;
    std::map<std::filesystem::path, OnStage> levels;
    double finished_drawing_s = 0.0;

    Result<OnStage*> find(const Scene& scene) {
        OnStage& on_stage = levels[scene.level];
        if (!on_stage.staged) {
            Result<std::unique_ptr<StagedLevel>> staged = load_staged_level(scene.level);
            if (!staged) return at_scene(scene, "/level", staged.error());
            on_stage.staged = *std::move(staged);
        }
        if (!on_stage.painter) {
            Result<std::unique_ptr<LevelPainter>> painter =
                LevelPainter::make(context, on_stage.staged->level);
            if (!painter) return painter.error();
            on_stage.painter = *std::move(painter);
        }
        return &on_stage;
    }

    Result<Image> draw(const Scene& scene, const OnStage& on_stage, Camera camera, Overlay overlay) {
        const double aspect = static_cast<double>(scene.width) / scene.height;
        fit_depth_range(camera, *on_stage.staged, overlay, aspect);
        if (wants_grid(scene)) draw_grid(overlay, on_stage.staged->level.mesh.bounds());
        return on_stage.painter->image(camera, scene.width, scene.height, scene.style, &overlay);
    }
};

SceneStage::SceneStage(OffscreenContext& context, InputBook& book)
    : impl_(std::make_unique<Impl>(context, book)) {}
SceneStage::~SceneStage() = default;

double SceneStage::drawing_s() const {
    double sum = 0.0;
    for (const auto& [path, on_stage] : impl_->levels)
        if (on_stage.painter) sum += on_stage.painter->drawing_s();
    return sum;
}

Result<Rendering> SceneStage::render(const Scene& scene) {
    const Result<Impl::OnStage*> found = impl_->find(scene);
    if (!found) return found.error();
    const Impl::OnStage& on_stage = **found;
    const Result<SceneMovement> story = run_movement(scene, *on_stage.staged);
    if (!story) return story.error();
    const Result<Camera> camera = scene_camera(scene, *on_stage.staged, *story);
    if (!camera) return camera.error();
    Result<Image> image = impl_->draw(scene, on_stage, *camera, story->overlay);
    if (!image) return at_scene(scene, "", image.error());
    const std::vector<std::string> inputs = scene_inputs(scene, impl_->book);
    const Level& level = on_stage.staged->level;
    coverage_.add_objects(level);
    if (!story->numbers.is_null())
        coverage_.add_run(level, inputs.front().substr(input_folder.size()), story->settings, story->acted,
                          story->touched);
    Numbers numbers;
    numbers["version"] = numbers_version;
    numbers["row"] = row_json(scene);
    numbers["camera"] = camera_json(scene, *camera);
    if (!story->numbers.is_null()) numbers["movement"] = story->numbers;
    numbers["inputs"] = Numbers::parse(inputs_json(inputs, impl_->book));
    numbers["renderer"] = Numbers::parse(renderer_fingerprint(impl_->context));
    return Rendering{*std::move(image), numbers_text(numbers)};
}

namespace {

// With every demo, off and on, instead of "demo:*".
std::vector<Scene> with_demos(const std::vector<Scene>& scenes) {
    std::vector<Scene> expanded;
    for (const Scene& scene : scenes) {
        if (scene.level != "demo:*") {
            expanded.push_back(scene);
            continue;
        }
        for (const DemoInfo& demo : demo_table()) {
            for (const char* state : {"off", "on"}) {
                Scene one = scene;
                one.name += fmt::format("/{}-{}", demo.name, state);
                one.level = fmt::format("demo:{}:{}", demo.name, state);
                one.camera = demo.title;
                expanded.push_back(std::move(one));
            }
        }
    }
    return expanded;
}

}  // namespace

Result<std::vector<Scene>> expand_suite(const std::vector<Scene>& scenes) {
    std::vector<Scene> expanded;
    for (const Scene& scene : with_demos(scenes)) {
        if (scene.program) {
            const Result<std::vector<std::string>> frames = frames_of(scene);
            if (!frames) return frames.error();
            for (const std::string& frame : *frames) {
                Scene& one = expanded.emplace_back(scene);
                one.program->frame = frame;
                if (!frame.empty()) one.name += "/" + frame;
            }
            continue;
        }
        if (scene.cameras.empty()) {
            expanded.push_back(scene);
            continue;
        }
        std::vector<std::string> names;
        for (const std::string& camera : scene.cameras) {
            const std::vector<std::string> known = cameras_of(camera);
            names.insert(names.end(), known.begin(), known.end());
            if (!known.empty()) continue;
            const auto staged = load_staged_level(scene.level);
            if (!staged) return at_scene(scene, "/level", staged.error());
            if (camera == "bookmarks") {
                for (const CameraBookmark& bookmark : (*staged)->level.cameras)
                    names.push_back(bookmark.name);
                continue;
            }
            const Result<SceneMovement> story = run_movement(scene, **staged);
            if (!story) return story.error();
            for (std::size_t i = 1; i <= movement_contacts(*story).size(); ++i)
                names.push_back(fmt::format("contact:{}", i));
        }
        for (const std::string& name : names) {
            Scene one = scene;
            one.cameras.clear();
            one.camera = name;
            one.name = scene.name + "@" + camera_suffix(name);
            expanded.push_back(std::move(one));
        }
    }
    std::vector<std::string> names;
    for (const Scene& scene : expanded)
        names.push_back(scene.name);
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end()) return Error{"suite", fmt::format("two scenes are named \"{}\"", *twice)};
    return expanded;
}

std::vector<std::string> scene_inputs(const Scene& scene, InputBook& book) {
    if (scene.program) return program_inputs(scene, book).inputs;
    std::vector<std::string> inputs{book.add(scene.level)};
    if (scene.tape) inputs.push_back(book.add(*scene.tape));
    return inputs;
}

std::string inputs_json(const std::vector<std::string>& inputs, InputBook& book) {
    Numbers json = Numbers::object();
    for (const std::string& name : inputs) {
        const Result<Input> input = book.read(name);
        json[name] = input ? input_mark(input->facts, input->bytes) : "";
    }
    return json.dump();
}

Snapshot scene_snapshot(const Scene& scene, std::function<Result<Rendering>()> render, InputBook& book) {
    Snapshot snapshot{scene.name, scene.tolerance, std::move(render)};
    snapshot.masks = scene.masks;
    snapshot.inputs = scene_inputs(scene, book);
    snapshot.input = [&book](const std::string& name) { return book.read(name); };
    return snapshot;
}

std::string renderer_fingerprint(const OffscreenContext& context) {
    Numbers json;
    json["backend"] = context.backend_name();
    json["renderer"] = context.renderer();
    json["version"] = context.version();
    std::string features;
#if defined(__x86_64__)
    const std::array<std::pair<const char*, bool>, 5> known{
        {{"sse4.1", __builtin_cpu_supports("sse4.1") != 0},
         {"avx", __builtin_cpu_supports("avx") != 0},
         {"avx2", __builtin_cpu_supports("avx2") != 0},
         {"fma", __builtin_cpu_supports("fma") != 0},
         {"avx512f", __builtin_cpu_supports("avx512f") != 0}}};
    for (const auto& [name, there] : known)
        if (there) features += (features.empty() ? "" : " ") + std::string(name);
#endif
    json["processor"] = features;
    return json.dump();
}

}  // namespace slipface
