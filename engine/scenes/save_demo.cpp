// Writes a demo as files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "slipface/base/files.h"
#include "slipface/base/system.h"
#include "slipface/level/level_file.h"
#include "slipface/scenes/demo.h"
#include "slipface/sim/simulate.h"

namespace slipface {

namespace {

std::string obj_text(const Mesh& mesh, const std::string& library) {
    std::string text = fmt::format("mtllib {}\n", library);
    for (const Vec3f& p : mesh.positions)
        text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
    std::uint32_t group = no_id, material = no_id;
    for (std::size_t face = 0; face < mesh.face_count(); ++face) {
        if (mesh.face_group[face] != group)
            text += fmt::format("o {}\n", mesh.groups[group = mesh.face_group[face]]);
        if (mesh.face_material[face] != material) {
            material = mesh.face_material[face];
            text += fmt::format("usemtl {}\n", mesh.materials[material].name);
        }
        text += "f";
        for (std::uint32_t c = mesh.face_first_corner[face]; c < mesh.face_first_corner[face + 1]; ++c)
            text += fmt::format(" {}", mesh.corner_vertex[c] + 1);
        text += "\n";
    }
    return text;
}

std::string mtl_text(const Mesh& mesh) {
    std::string text;
    for (const Material& m : mesh.materials)
        text += fmt::format("newmtl {}\nKd {} {} {}\n", m.name, m.diffuse.x(), m.diffuse.y(), m.diffuse.z());
    return text;
}

GreyImage terrain_image(const Heightfield& field, const HeightfieldSource& source) {
    GreyImage image{.width = field.columns, .height = field.rows, .values = {}};
    for (const double height : field.heights) {
        const double fraction = (height - source.origin.y() - source.low) / (source.high - source.low);
        image.values.push_back(static_cast<std::uint16_t>(std::lround(fraction * 65535.0)));
    }
    return image;
}

std::vector<Vec3> path_of_run(const Demo& demo, bool on) {
    const Tape& tape = on ? demo.tape : demo.off_tape;
    const MovementSettings& settings = on ? demo.on : demo.off;
    // The levels of the demos can be built; a test builds all.
    LevelScene scene = std::move(LevelScene::build(demo.level, settings).value());
    const TickScene ticks(scene);
    std::vector<Vec3> path{*tape.start};
    for (const PlayerState& state :
         simulate(ticks, settings, *tape.start, tape, {.keep_states = true}).states)
        path.push_back(ticks.to_level(state));
    return path;
}

struct Apart {
    Vec3 at = Vec3::Zero();
    double metres = 0.0;
};
// The position of `path` that is furthest from all of `other`.
Apart furthest(const std::vector<Vec3>& path, const std::vector<Vec3>& other) {
    Apart best;
    for (const Vec3& at : path) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vec3& there : other)
            nearest = std::min(nearest, (at - there).norm());
        if (nearest > best.metres) best = {at, nearest};
    }
    return best;
}

// What the run with the cure does and the one with the problem does not: to be where the other never comes,
// or, where it only stays behind, never to be where that goes.
Goal goal_of(const Demo& demo) {
    const std::vector<Vec3> on = path_of_run(demo, true), off = path_of_run(demo, false);
    const Apart gained = furthest(on, off), lost = furthest(off, on);
    constexpr double clear = 0.1;  // m
    const bool reaches = gained.metres > clear || gained.metres >= lost.metres;
    const Apart& goal = reaches ? gained : lost;
    return {.name = reaches ? "cured" : "not cured",
            .kind = reaches ? GoalKind::reach : GoalKind::never,
            .position = goal.at,
            .radius = std::clamp(0.5 * goal.metres, smallest_goal_radius, 1.0),
            .within_s = std::nullopt,
            .from = {}};
}

}  // namespace

Result<std::filesystem::path> save_demo(const DemoInfo& info, const std::filesystem::path& folder) {
    Demo demo = make_demo(info);
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder))
        return Error{folder.string(), error ? error.message() : "is no folder"};
    const std::string name = info.name;
    demo.level.mesh_path = folder / (name + ".obj");
    demo.level.file_path = folder / (name + ".slipface.json");
    demo.level.goals = {goal_of(demo)};
    const Mesh& mesh = *demo.level.mesh;
    const auto write = [&](const std::string& ending, const std::string& text) {
        return write_file_atomic(folder / (name + ending), text);
    };
    if (const Status status = write(".mtl", mtl_text(mesh)); !status) return status.error();
    if (const Status status = write(".obj", obj_text(mesh, name + ".mtl")); !status) return status.error();
    if (demo.level.terrain && demo.level.heightfield) {
        const auto path = folder / path_of(demo.level.heightfield->file);
        const Status status =
            save_grey_png(path, terrain_image(*demo.level.terrain, *demo.level.heightfield));
        if (!status) return status.error();
    }
    if (const Status status = save_level(demo.level); !status) return status.error();
    // The tape records the fingerprint of the geometry as read, whose coordinates may differ in the last
    // digit.
    const Result<LoadedLevel> loaded = load_level(demo.level.mesh_path);
    if (!loaded) return loaded.error();
    demo.tape.level_fingerprint = loaded->level.mesh.fingerprint();
    if (const Status status = write(".tape", tape_to_text(demo.tape)); !status) return status.error();
    demo.off_tape.level_fingerprint = demo.tape.level_fingerprint;
    demo.off_tape.settings = setting_changes(demo.on, demo.off);
    if (const Status status = write("-off.tape", tape_to_text(demo.off_tape)); !status) return status.error();
    return demo.level.mesh_path;
}

}  // namespace slipface
