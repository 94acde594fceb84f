// slipface_level.h: the part of the C library that needs levels and files.
#include "calls.h"
#include "slipface/base/system.h"
#include "slipface/level/find_start.h"
#include "slipface/level/level_file.h"
#include "slipface/level/level_scene.h"
#include "slipface/level/preset.h"
#include "slipface_level.h"

using namespace slipface;
using namespace slipface::c;

namespace {

struct LevelWorld final : World {
    Level level;
    std::optional<LevelScene> scene;
    double time = 0.0, dt = 0.0;

    void see() { now.emplace(scene->at(time, dt)); }
    std::vector<SurfaceType>& types() override { return level.surfaces; }
    void types_changed() override {
        scene->apply_surfaces();
        see();
    }
    std::size_t face_count() const override { return level.mesh.face_count(); }
    void set_face_type(FaceId face, SurfaceId type) override {
        level.overrides.resize(std::max<std::size_t>(level.overrides.size(), face + 1));
        level.overrides[face] = type;
        types_changed();
    }
};

template <class Of>
auto& of_level(Of& world, const char* what) {
    using Made = std::conditional_t<std::is_const_v<Of>, const LevelWorld, LevelWorld>;
    auto* const made = dynamic_cast<Made*>(&world);
    if (made == nullptr)
        refuse(SLIPFACE_WRONG_ARGUMENT, "{}: found a world of triangles, expected that of a level", what);
    return *made;
}

}  // namespace

slipface_status slipface_settings_from_file(const char* path, slipface_settings* settings,
                                            slipface_error* error) {
    return run(error, [&] {
        need("path and settings", path, settings);
        const Result<Preset> found = load_preset(path_of(path));
        if (!found) refuse(SLIPFACE_CANNOT_READ, found.error());
        auto made = std::make_unique<Settings>();
        made->values = found->settings;
        settings->id = handle_of(Kind::settings, std::move(made));
    });
}

slipface_status slipface_world_from_level(const char* path, slipface_world* world, slipface_error* error) {
    return run(error, [&] {
        need("path and world", path, world);
        Result<LoadedLevel> loaded = load_level(path_of(path));
        if (!loaded) refuse(SLIPFACE_CANNOT_READ, loaded.error());
        auto made = std::make_unique<LevelWorld>();
        made->level = std::move(loaded->level);
        Result<LevelScene> scene = LevelScene::build(made->level);
        if (!scene) refuse(SLIPFACE_CANNOT_READ, scene.error());
        made->scene.emplace(std::move(*scene));
        made->see();
        world->id = handle_of(Kind::world, std::move(made));
    });
}

slipface_status slipface_world_settings(slipface_world world, slipface_settings* settings,
                                        slipface_error* error) {
    return run(error, [&] {
        need("settings", settings);
        auto made = std::make_unique<Settings>();
        {
            const SharedWorld in(world.id);
            made->values = of_level(*in, "slipface_world_settings").level.movement;
        }
        settings->id = handle_of(Kind::settings, std::move(made));
    });
}

slipface_status slipface_world_spawn(slipface_world world, slipface_settings settings, const char* name,
                                     slipface_vec3* position, double* yaw, slipface_error* error) {
    return run(error, [&] {
        need("position and yaw", position, yaw);
        const SharedWorld shared(world.id);
        const LevelWorld& in = of_level(*shared, "slipface_world_spawn");
        const SharedSettings with(settings.id);
        const Vec3 offset = in.scene->offset();
        const Result<Start> start =
            find_start(in.level, *in.now, offset, with->values, name == nullptr ? "" : name);
        if (!start) refuse(SLIPFACE_WRONG_ARGUMENT, start.error());
        *position = vec(Vec3(start->position + offset));
        *yaw = start->yaw;
    });
}

slipface_status slipface_world_set_time(slipface_world world, double time, double dt, slipface_error* error) {
    return run(error, [&] {
        if (!std::isfinite(time) || !(dt >= 0.0) || !std::isfinite(dt))
            refuse(SLIPFACE_WRONG_ARGUMENT,
                   "found the time {} and dt {}, expected finite numbers, dt 0 or more", time, dt);
        const ChangedWorld changed(world.id);
        LevelWorld& in = of_level(*changed, "slipface_world_set_time");
        in.time = time;
        in.dt = dt;
        in.see();
    });
}
