#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include "goldens/camera_names.h"
#include "goldens/level_digest.h"
#include "slipface/base/files.h"
#include "slipface/level/level_file.h"
#include "slipface/scenes/demo.h"
#include "slipface/view/camera.h"
#include "snapshots/explain.h"
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

// The settings that the golden's numbers name, the others as in basic_settings(), and its tape.
std::optional<RecordedMovement> movement_of(const Numbers& numbers) {
    const auto movement = numbers.find("movement");
    if (movement == numbers.end() || !movement->is_object() || !movement->contains("settings"))
        return std::nullopt;
    RecordedMovement recorded{basic_settings(), std::nullopt};
    for (const auto& [name, value] : (*movement)["settings"].items())
        if (value.is_string())
            (void)set_setting(recorded.settings, fmt::format("{}={}", name, value.get<std::string>())).ok();
    recorded.tape = recorded_tape(numbers);
    return recorded;
}

std::optional<Vec3> vec3_of(const Numbers& object, const char* key) {
    const auto list = object.find(key);
    if (list == object.end() || !list->is_array() || list->size() != 3) return std::nullopt;
    Vec3 v;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(*list)[i].is_number()) return std::nullopt;
        v[static_cast<Eigen::Index>(i)] = (*list)[i].get<double>();
    }
    return v.allFinite() ? std::optional(v) : std::nullopt;
}

// The golden's camera; members that its numbers lack are those of today's camera.
Camera camera_of(const Numbers& numbers, Camera camera) {
    const auto json = numbers.find("camera");
    if (json == numbers.end() || !json->is_object()) return camera;
    camera.eye = vec3_of(*json, "eye").value_or(camera.eye);
    camera.target = vec3_of(*json, "target").value_or(camera.target);
    const auto number = [&](const char* key, double& to) {
        if (json->contains(key) && (*json)[key].is_number()) to = (*json)[key].get<double>();
        return json->contains(key);
    };
    camera.orthographic = number("ortho_height", camera.ortho_height);
    number("fov_y", camera.fov_y);
    return camera;
}

}  // namespace

struct SceneStage::Impl {
    explicit Impl(OffscreenContext& of) : context(of) {}

    struct OnStage {
        std::unique_ptr<StagedLevel> staged;
        std::unique_ptr<LevelPainter> painter;
    };

    OffscreenContext& context;
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

    // The level as it was approved.
    OnStage stage_before(const StagedLevel& now, const Numbers& golden,
                         const std::filesystem::path& goldens) {
        OnStage before;
        const auto level = golden.find("level");
        if (level == golden.end() || !level->is_object()) return before;
        const std::string name = level->value("digest", std::string());
        if (!valid_snapshot_name(name)) return before;
        const std::filesystem::path path = goldens / "levels" / (name + ".digest");
        const Result<std::string> bytes = read_file(path, std::uint64_t{64} << 20U);
        if (!bytes) return before;
        Result<Level> old = decode_digest(*bytes, path.string());
        if (!old) return before;
        old->mesh_path = now.level.mesh_path;
        old->file_path = now.level.file_path;
        (void)load_terrain(*old).ok();  // on an error there is no terrain, and the path differs
        Result<std::unique_ptr<StagedLevel>> staged = stage_level(*std::move(old));
        if (staged) before.staged = *std::move(staged);
        if (before.staged) before.staged->tape = now.tape;
        return before;
    }
};

SceneStage::SceneStage(OffscreenContext& context) : impl_(std::make_unique<Impl>(context)) {}
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
    Numbers numbers;
    numbers["version"] = 1;
    numbers["image"] = {{"width", scene.width}, {"height", scene.height}, {"style", style_text(scene)}};
    numbers["camera"] = camera_json(scene, *camera);
    numbers["level"] = on_stage.staged->numbers;
    if (!story->numbers.is_null()) numbers["movement"] = story->numbers;
    numbers["renderer"] = Numbers::parse(renderer_fingerprint(impl_->context));
    return Rendering{*std::move(image), numbers_text(numbers)};
}

std::vector<Finding> SceneStage::explain(const Scene& scene, const ExplainRequest& request) {
    const Result<Impl::OnStage*> found = impl_->find(scene);
    const Numbers golden = Numbers::parse(request.expected_numbers, nullptr, false);
    if (!found || !golden.is_object()) return explain_numbers(request, 0);
    const Impl::OnStage& now = **found;
    const Result<SceneMovement> story = run_movement(scene, *now.staged);
    const Result<Camera> camera = story ? scene_camera(scene, *now.staged, *story) : story.error();
    if (!camera) return explain_numbers(request, 0);

    Impl::OnStage old = impl_->stage_before(*now.staged, golden, request.goldens);
    Result<SceneMovement> old_story = SceneMovement{};
    if (old.staged) old_story = run_movement(scene, *old.staged, movement_of(golden));
    const SceneSide before{old.staged.get(), old_story ? &*old_story : nullptr, camera_of(golden, *camera)};
    const SceneSide after{now.staged.get(), &*story, *camera};
    const auto draw = [&](const SceneSide& side, bool with_overlay, bool lit) -> Image {
        const bool is_old = side.staged == old.staged.get();
        if (is_old && !old.painter) {
            Result<std::unique_ptr<LevelPainter>> painter =
                LevelPainter::make(impl_->context, old.staged->level);
            if (!painter) return {};
            old.painter = *std::move(painter);
        }
        const Impl::OnStage& on_stage = is_old ? old : now;
        Camera fitted = side.camera;
        const double aspect = static_cast<double>(scene.width) / scene.height;
        fit_depth_range(fitted, *on_stage.staged, side.story->overlay, aspect);
        LevelStyle style = scene.style;
        style.baked_light = style.baked_light && lit;
        const Result<Image> image = on_stage.painter->image(fitted, scene.width, scene.height, style,
                                                            with_overlay ? &side.story->overlay : nullptr);
        return image ? *image : Image{};
    };
    return explain_scene({scene, request, before, after, draw});
}

Result<Attachment> SceneStage::digest(const Scene& scene) {
    const Result<Impl::OnStage*> found = impl_->find(scene);
    if (!found) return found.error();
    const StagedLevel& staged = *(*found)->staged;
    if (staged.digest.empty()) return Attachment{};
    Result<std::string> bytes = encode_digest(staged.level);
    if (!bytes) return bytes.error();
    return Attachment{"levels/" + staged.digest + ".digest", *std::move(bytes)};
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

std::vector<Snapshot> scene_snapshots(const std::vector<Scene>& scenes,
                                      const std::shared_ptr<SceneStage>& stage) {
    std::vector<Snapshot> snapshots;
    for (const Scene& scene : scenes) {
        Snapshot snapshot{scene.name, scene.tolerance, [scene, stage] { return stage->render(scene); }};
        snapshot.masks = scene.masks;
        snapshot.explain = [scene, stage](const ExplainRequest& request) {
            return stage->explain(scene, request);
        };
        snapshot.attachment = [scene, stage] { return stage->digest(scene); };
        snapshots.push_back(std::move(snapshot));
    }
    return snapshots;
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
