#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "slipface/level/level_file.h"
#include "slipface/render/trace_overlay.h"
#include "slipface/sim/simulate.h"
#include "slipface/snapshot/suite.h"

namespace slipface {

namespace {

constexpr Color path_color{1.0f, 0.80f, 0.30f, 1.0f};
constexpr Color end_color{1.0f, 0.66f, 0.22f, 0.9f};

Error at_scene(const Scene& scene, const char* key, const Error& error) {
    return {scene.place + key, error.text()};
}

Result<Camera> scene_camera(const Scene& scene, const Level& level) {
    if (const auto* camera = std::get_if<Camera>(&scene.camera)) return *camera;
    const auto& name = std::get<std::string>(scene.camera);
    const double aspect = static_cast<double>(scene.width) / scene.height;
    if (name.starts_with("auto:")) {
        const Aabb bounds = level.mesh ? level.mesh->bounds : Aabb{};
        if (const auto view = named_view(name.substr(5), bounds, aspect)) return *view;
    }
    for (const CameraBookmark& bookmark : level.cameras) {
        if (bookmark.name != name) continue;
        Camera camera;
        camera.eye = bookmark.eye;
        camera.target = bookmark.target;
        camera.fov_y = bookmark.fov_y;
        return camera;
    }
    std::string names;
    for (const CameraBookmark& bookmark : level.cameras)
        names += (names.empty() ? "" : ", ") + bookmark.name;
    return Error{scene.place + "/camera", fmt::format("the level has no camera \"{}\"; it has: {}", name,
                                                      names.empty() ? "none" : names)};
}

Status draw_probe(const Scene& scene, const Level& level, const CollisionWorld& collision, Overlay& overlay) {
    MovementSettings settings = level.movement;
    for (std::size_t i = 0; i < scene.probe->settings.size(); ++i) {
        if (Status status = set_setting(settings, scene.probe->settings[i]); !status) {
            return at_scene(scene, fmt::format("/probe/settings/{}", i).c_str(), status.error());
        }
    }
    if (scene.probe->radii) settings.radii = *scene.probe->radii;
    const Vec3 from = scene.probe->from.value_or(level.spawn);
    TraceRecorder trace;
    slide_move({collision, level.surfaces}, settings, from, scene.probe->move, &trace);
    draw_trace(overlay, trace.records, settings.radii);
    return {};
}

Status draw_tape(const Scene& scene, const Level& level, const CollisionWorld& collision, Overlay& overlay) {
    const Result<Tape> tape = load_tape(*scene.tape);
    if (!tape) return at_scene(scene, "/tape", tape.error());
    MovementSettings settings = level.movement;
    if (Status status = apply_tape_settings(settings, *tape, scene.tape->string()); !status) {
        return at_scene(scene, "/tape", status.error());
    }
    const Vec3 start = tape->start.value_or(level.spawn);
    const SimulationReport report = simulate({collision, level.surfaces}, settings, start, *tape,
                                             {.keep_states = true, .trace = nullptr});
    Vec3 previous = start;
    for (const PlayerState& state : report.states) {
        if (state.position != previous) overlay.line(previous, state.position, path_color, 2.5f);
        previous = state.position;
    }
    Color start_fill = trace_colors::start, end_fill = end_color;
    start_fill.alpha = 0.06f;
    end_fill.alpha = 0.20f;
    overlay.ellipsoid(start, settings.radii, start_fill, trace_colors::start);
    overlay.ellipsoid(previous, settings.radii, end_fill, end_color);
    return {};
}

Result<Image> render_loaded(const Scene& scene, const Level& level, OffscreenContext& context) {
    const Result<Camera> camera = scene_camera(scene, level);
    if (!camera) return camera.error();
    Overlay overlay;
    if (scene.probe || scene.tape) {
        const Result<CollisionWorld> collision = build_collision_world(level);
        if (!collision) return at_scene(scene, "/level", collision.error());
        if (scene.probe) {
            if (Status status = draw_probe(scene, level, *collision, overlay); !status) return status.error();
        }
        if (scene.tape) {
            if (Status status = draw_tape(scene, level, *collision, overlay); !status) return status.error();
        }
    }
    return render_level_picture(context, level, *camera, scene.width, scene.height, scene.style, &overlay);
}

}  // namespace

Result<Image> render_scene(const Scene& scene, OffscreenContext& context) {
    const Result<LoadedLevel> loaded = load_level(scene.level);
    if (!loaded) return at_scene(scene, "/level", loaded.error());
    return render_loaded(scene, loaded->level, context);
}

std::vector<Snapshot> scene_snapshots(const std::vector<Scene>& scenes, OffscreenContext& context) {
    using Levels = std::map<std::filesystem::path, std::shared_ptr<const Level>>;
    const auto levels = std::make_shared<Levels>();
    std::vector<Snapshot> snapshots;
    for (const Scene& scene : scenes) {
        const auto render = [scene, levels, &context]() -> Result<Image> {
            std::shared_ptr<const Level>& level = (*levels)[scene.level];
            if (!level) {
                Result<LoadedLevel> loaded = load_level(scene.level);
                if (!loaded) return at_scene(scene, "/level", loaded.error());
                level = std::make_shared<const Level>(std::move(loaded->level));
            }
            return render_loaded(scene, *level, context);
        };
        snapshots.push_back({scene.name, scene_tolerance, render});
    }
    return snapshots;
}

}  // namespace slipface
