#include "snapshots/staged_level.h"

#include <algorithm>

#include "slipface/base/text.h"
#include "slipface/level/level_file.h"
#include "slipface/scenes/demo.h"

namespace slipface {

namespace {

bool all_solid(const Level& level) {
    return std::all_of(level.surfaces.begin(), level.surfaces.end(),
                       [](const SurfaceType& surface) { return surface.solid; });
}

}  // namespace

Result<std::unique_ptr<StagedLevel>> stage_level(Level level, Warnings warnings) {
    if (!level.mesh) return Error{level.mesh_path.string(), "has no geometry"};
    auto staged = std::make_unique<StagedLevel>();
    staged->level = std::move(level);
    Result<CollisionWorld> world = build_collision_world(staged->level);
    if (!world) return world.error();
    staged->collision = *std::move(world);
    if (!all_solid(staged->level)) {
        const Mesh& mesh = *staged->level.mesh;
        std::vector<std::array<std::uint32_t, 3>> triangles = mesh.triangles;
        for (auto& triangle : triangles)
            for (std::uint32_t& corner : triangle)
                corner = mesh.corner_vertex[corner];
        Result<CollisionWorld> geometry =
            CollisionWorld::build({mesh.positions, triangles, mesh.triangle_face});
        if (!geometry) return geometry.error();
        staged->geometry = *std::move(geometry);
    }
    staged->warnings = std::move(warnings);
    return staged;
}

namespace {

Result<std::unique_ptr<StagedLevel>> stage_demo(std::string_view text) {
    const std::vector<std::string_view> words = split(text, ':');
    const DemoInfo* info = words.size() == 3 ? find_demo(words[1]) : nullptr;
    if (info == nullptr || (words[2] != "on" && words[2] != "off")) {
        std::string names;
        for (const DemoInfo& demo : demo_table())
            names += (names.empty() ? "" : ", ") + std::string(demo.name);
        return Error{std::string(text),
                     "is no demo; expected demo:NAME:on or demo:NAME:off, with NAME one of " + names};
    }
    Demo demo = make_demo(*info);
    demo.level.movement = words[2] == "on" ? demo.on : demo.off;
    Result<std::unique_ptr<StagedLevel>> staged = stage_level(std::move(demo.level));
    if (staged) (*staged)->tape = words[2] == "on" ? std::move(demo.tape) : std::move(demo.off_tape);
    return staged;
}

}  // namespace

Result<std::unique_ptr<StagedLevel>> load_staged_level(const std::filesystem::path& path) {
    if (const std::string text = path.string(); text.starts_with(demo_prefix)) return stage_demo(text);
    Result<LoadedLevel> loaded = load_level(path);
    if (!loaded) return loaded.error();
    return stage_level(std::move(loaded->level), std::move(loaded->warnings));
}

}  // namespace slipface
